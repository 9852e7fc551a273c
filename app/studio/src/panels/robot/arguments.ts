/** The arguments that a xacro declares, as fields. */

import type { Problem } from "../../api.ts";
import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";

/** As many as the service takes. */
const MOST = 100;
const NAMED = /argument '([^']+)'/;

/** What a file has that only defines parts for others. */
const PARTS = new Set(["arg", "if", "include", "macro", "property", "unless"].map((part) => `xacro:${part}`));

/** Names of the arguments with their defaults, in the file's order; none if it is no xacro, or cannot be read. */
export function declared(text: string): Map<string, string> {
  if (!text.includes("xacro:arg")) return new Map();
  const found = parsed(text).getElementsByTagName("xacro:arg");
  const all = Array.from(found, (arg) => [arg.getAttribute("name") ?? "", arg.getAttribute("default") ?? ""] as const);
  return new Map(all.filter(([name]) => name !== "").slice(0, MOST));
}

/** The same of a zip's description and of what it includes, given texts by path; of the only xacro if none is named. */
export function declaredIn(texts: ReadonlyMap<string, string>, description: string): Map<string, string> {
  const files = description ? [description] : robotsAmong(texts);
  if (files.length !== 1) return new Map();
  for (const file of files) {
    files.push(...[...texts.keys()].filter((other) => !files.includes(other) && names(texts.get(file) ?? "", other)));
  }
  const found = new Map<string, string>();
  for (const [name, preset] of files.flatMap((file) => [...declared(texts.get(file) ?? "")]))
    if (!found.has(name) && found.size < MOST) found.set(name, preset);
  return found;
}

/** What the service would take: URDFs, else each xacro that describes a robot and is no part of another one. */
function robotsAmong(texts: ReadonlyMap<string, string>): string[] {
  const urdfs = [...texts.keys()].filter((file) => /\.urdf$/i.test(file));
  const robots = [...texts].filter(([, text]) =>
    Array.from(parsed(text).documentElement.children).some(({ tagName }) => !PARTS.has(tagName)),
  );
  const whole = robots.filter(([file]) => !robots.some(([other, text]) => other !== file && names(text, file)));
  return urdfs.length ? urdfs : (whole.length ? whole : robots).map(([file]) => file);
}

function names(text: string, file: string): boolean {
  const name = file.slice(file.lastIndexOf("/") + 1);
  return [`/${name}"`, `"${name}"`, `/${name}'`, `'${name}'`].some((end) => text.includes(end));
}

function parsed(text: string): Document {
  return new DOMParser().parseFromString(text, "application/xml");
}

/** Their fields, hidden where there is none; `given` are the values that differ from the defaults. */
export function argumentFields() {
  const host = element("div", { class: "keep arguments", hidden: true });
  let fields = new Map<string, { input: HTMLInputElement; fault: HTMLElement; preset: string }>();
  const offer = (presets: ReadonlyMap<string, string>) => {
    fields = new Map();
    host.hidden = presets.size === 0;
    host.replaceChildren(element("p", { class: "muted" }, t("Arguments of the xacro, then Add:")));
    [...presets].forEach(([name, preset], index) => {
      const id = `robot-argument-${index}`;
      const fault = element("p", { class: "problem", id: `${id}-fault`, role: "alert", hidden: true });
      const input = element("input", { type: "text", class: "text", id, autocomplete: "off", spellcheck: "false" });
      input.value = preset;
      input.setAttribute("aria-describedby", fault.id);
      fields.set(name, { input, fault, preset });
      host.append(element("label", { class: "field", for: id }, name), input, fault);
    });
  };
  const given = () =>
    Object.fromEntries(
      [...fields]
        .filter(([, { input, preset }]) => input.value !== preset)
        .map(([name, { input }]) => [name, input.value]),
    );
  /** Says at its field what the service has against a value; returns whether that is all it says. */
  const mark = (problem: Problem | null): boolean => {
    const told = new Map(problem?.places.map(({ pointer, detail }) => [argumentOf(pointer), detail]));
    const named = NAMED.exec(problem?.detail ?? "")?.[1];
    if (named !== undefined) told.set(named, problem?.detail ?? "");
    for (const [name, { input, fault }] of fields) {
      input.setAttribute("aria-invalid", String(told.has(name)));
      fault.hidden = !told.has(name);
      fault.textContent = told.get(name) ?? "";
    }
    return told.size > 0 && [...told.keys()].every((name) => fields.has(name));
  };
  return { host, offer, given, mark };
}

function argumentOf(pointer: string): string {
  const [, field, name] = pointer.split("/");
  return field === "arguments" && name ? name.replaceAll("~1", "/").replaceAll("~0", "~") : "";
}
