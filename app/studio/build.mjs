/** Bundles the studio into the package, to the same bytes from the same lock file. */

import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "..", "gelenk", "studio");
const FONTS_THAT_EVERY_BROWSER_READS = /,url\([^)]*\.(?:woff|ttf)\) format\("[a-z]+"\)/g;

const katexStyle = {
  name: "katex-fonts",
  setup(bundler) {
    bundler.onLoad({ filter: /katex\.min\.css$/ }, ({ path }) => ({
      contents: readFileSync(path, "utf8").replace(FONTS_THAT_EVERY_BROWSER_READS, ""),
      loader: "css",
    }));
  },
};

/** urdf-loader brings readers of meshes that the page never calls: its own come when they are needed. */
const withoutReaders = {
  name: "without-readers",
  setup(bundler) {
    bundler.onResolve({ filter: /\/(?:STL|Collada)Loader\.js$/ }, ({ importer, path }) =>
      importer.includes("/urdf-loader/") ? { path, namespace: "unused" } : undefined,
    );
    bundler.onLoad({ filter: /.*/, namespace: "unused" }, () => ({
      contents: "export class STLLoader {}\nexport class ColladaLoader {}",
    }));
  },
};

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const { metafile } = await build({
  absWorkingDir: here,
  entryPoints: { studio: "src/main.ts" },
  outdir: out,
  bundle: true,
  format: "esm",
  splitting: true,
  chunkNames: "chunks/[name]-[hash]",
  target: "es2022",
  minify: true,
  charset: "utf8",
  legalComments: "none",
  loader: { ".woff2": "file" },
  assetNames: "fonts/[name]-[hash]",
  plugins: [katexStyle, withoutReaders],
  metafile: true,
  logLevel: "warning",
});
cpSync(join(here, "page", "icon.svg"), join(out, "icon.svg"));
writeFileSync(join(out, "index.html"), preloading(readFileSync(join(here, "page", "index.html"), "utf8"), metafile));
writeFileSync(join(out, "LICENSES.txt"), licences(metafile));

/** The page, which asks for what its script imports together with the script itself. */
function preloading(page, { outputs }) {
  const [, { imports }] = Object.entries(outputs).find(([path]) => path.endsWith("/studio.js"));
  const chunks = imports
    .filter(({ kind }) => kind === "import-statement")
    .map(({ path }) => `chunks/${basename(path)}`);
  const links = chunks.map((path) => `<link rel="modulepreload" href="studio/${path}">\n`);
  return page.replace("<script", `${links.join("")}<script`);
}

/** The licence of every package of which something is in the bundle. */
function licences({ inputs }) {
  const names = Object.keys(inputs).map((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1]);
  const packages = [...new Set(names.filter(Boolean))].sort();
  const texts = packages.map((name) => {
    const folder = join(here, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    // A package that leaves its licence out has it beside this script.
    const text = readFileSync(file ? join(folder, file) : join(here, "licences", `${name}.txt`), "utf8");
    return `${name} ${version} (${license})\n\n${text.trim()}\n`;
  });
  return `The studio's bundle contains parts of these packages.\n\n${texts.join(`\n${"-".repeat(72)}\n\n`)}`;
}
