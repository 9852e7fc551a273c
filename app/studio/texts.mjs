/**
 * The texts of the page. `node texts.mjs` wraps those that the sources have in `t(…)`, lists new ones in
 * `src/texts/de.json` with no German yet, and takes out those that no source has; `--check` only looks, `--glued` lists
 * sentences that are put together of parts.
 */

import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import prettier from "prettier";

import { found } from "./texts/find.mjs";
import { wrapped } from "./texts/wrap.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const sources = join(here, "src");
const catalogue = join(sources, "texts", "de.json");
const isCheck = process.argv.includes("--check");
const faults = [];

const keys = new Map();
const seen = (key, place) => keys.has(key) || keys.set(key, place);
for (const key of textsOfPage()) seen(key, "page/index.html");
const files = readdirSync(sources, { recursive: true }).filter((name) => name.endsWith(".ts"));
for (const file of files.map((name) => name.replaceAll("\\", "/")).sort()) await look(file);
compare(JSON.parse(readFileSync(catalogue, "utf8")));
console.error(faults.join("\n") || `${keys.size} texts, all of them in German`);
process.exitCode = faults.length ? 1 : 0;

/** Wrap what is to be wrapped in a module, or say so, and take its keys. */
async function look(file) {
  const path = join(sources, file);
  let source = readFileSync(path, "utf8");
  if (!isCheck) {
    const made = await wrapped(file, source);
    if (made !== source) {
      source = await prettier.format(made, { ...(await prettier.resolveConfig(path)), filepath: path });
      writeFileSync(path, source);
      console.log(`wrapped: ${file}`);
    }
  }
  const { unmarked, marked, glued } = await found(file, source);
  faults.push(...unmarked.map(({ key, line }) => `${file}:${line}: not in t(): ${JSON.stringify(key)}`));
  for (const { key, line } of marked) seen(key, `${file}:${line}`);
  if (process.argv.includes("--glued"))
    for (const { key, line } of glued) console.log(`${file}:${line}: ${JSON.stringify(key)}`);
}

/** What the page has before its script runs: names for screen readers, and what is marked `data-text`. */
function textsOfPage() {
  const page = readFileSync(join(here, "page", "index.html"), "utf8");
  return [...page.matchAll(/aria-label="([^"]+)"|data-text>([^<]+)</g)].map(([, label, text]) => label ?? text);
}

/** The German texts against the keys of the sources, and both by their placeholders. */
function compare(texts) {
  const dead = Object.keys(texts).filter((key) => !keys.has(key));
  if (isCheck) faults.push(...dead.map((key) => `de.json: no source has it: ${JSON.stringify(key)}`));
  else {
    const kept = [...keys.keys()].sort().map((key) => [key, texts[key] ?? ""]);
    writeFileSync(catalogue, `${JSON.stringify(Object.fromEntries(kept), null, 2)}\n`);
    for (const key of dead) console.log(`taken out: ${JSON.stringify(key)}: ${JSON.stringify(texts[key])}`);
  }
  for (const [key, place] of keys) {
    if (!texts[key]) faults.push(`${place}: no German in de.json: ${JSON.stringify(key)}`);
    else if (fields(key) !== fields(texts[key])) faults.push(`de.json: other placeholders: ${JSON.stringify(key)}`);
  }
}

function fields(text) {
  return [...new Set(text.match(/\{\w+\}/g))].sort().join();
}
