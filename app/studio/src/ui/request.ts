/** A call as a script: the next step after the page. */

import type { Api, Call } from "../api.ts";
import { t } from "../texts/index.ts";
import { copyButton } from "./copy.ts";
import { Choice, element } from "./dom.ts";

type Language = "curl" | "python" | "json";

const LANGUAGES: readonly { value: Language; text: string }[] = [
  { value: "curl", text: "curl" },
  { value: "python", text: "Python" },
  { value: "json", text: "JSON" },
];

/** The part "as request" at the foot of a panel; `api` is the API whose last call it shows. */
export class RequestView {
  readonly host: HTMLElement;
  readonly api: Api;
  #call: Call | null = null;
  #language: Language = "curl";
  #code = element("code");
  #choice: Choice<Language>;

  /** @param what which of a panel's calls it shows, where there are several. */
  constructor(
    private readonly service: Api,
    what = "",
  ) {
    this.api = service.recorded((call) => this.show(call));
    this.#choice = new Choice(t("Language"), LANGUAGES, (language) => {
      this.#language = language;
      this.#write();
    });
    const bar = element(
      "div",
      { class: "bar" },
      this.#choice.host,
      copyButton(() => this.#code.textContent ?? "", t("the request")),
    );
    const code = element(
      "pre",
      { tabindex: "0", role: "region", "aria-label": what ? t("The request: {what}", { what }) : t("The request") },
      this.#code,
    );
    this.host = element(
      "details",
      { class: "request", hidden: true },
      element("summary", {}, what ? t("As request: {what}", { what }) : t("As request")),
      element("div", { class: "request-body" }, bar, code),
    );
  }

  show(call: Call): void {
    this.#call = call;
    this.#write();
  }

  #write(): void {
    this.host.hidden = this.#call === null;
    this.#choice.show(this.#language);
    if (this.#call)
      this.#code.textContent = WRITERS[this.#language](
        this.service.url(this.#call.path),
        this.#call,
        this.service.key.isSet,
      );
  }
}

const WRITERS: Record<Language, (url: string, call: Call, hasKey: boolean) => string> = { curl, python, json };

function curl(url: string, call: Call, hasKey: boolean): string {
  const method =
    call.method === "GET" || (call.method === "POST" && (call.body || call.form)) ? "" : ` -X ${call.method}`;
  const parts = [`curl -s${method} ${quoted(url)}`];
  if (hasKey) parts.push(`-H "Authorization: Bearer $GELENK_KEY"`);
  if (call.form) {
    for (const [name, value] of Object.entries(call.form.fields)) parts.push(`-F ${quoted(`${name}=${value}`)}`);
    for (const file of call.form.files) parts.push(`-F ${quoted(`${call.form.part}=@${file.name}`)}`);
  } else if (call.body !== undefined) {
    parts.push(`-H 'Content-Type: application/json'`);
    if (call.accept) parts.push(`-H ${quoted(`Accept: ${call.accept}`)}`);
    parts.push(`-d ${quoted(flat(call.body, JSON.stringify))}`);
  }
  return parts.join(" \\\n  ");
}

/** The key itself is never shown. */
const KEY = `"Authorization": "Bearer " + os.environ["GELENK_KEY"]`;

/** The standard library is enough for JSON; for a form there is `requests`. */
function python(url: string, call: Call, hasKey: boolean): string {
  if (call.form) {
    return [
      ...(hasKey ? ["import os", ""] : []),
      "import requests",
      "",
      `answer = requests.${call.method.toLowerCase()}(`,
      `    ${literal(url)},`,
      `    data=${literal(call.form.fields)},`,
      `    files=[${call.form.files.map(({ name }) => `("${call.form!.part}", open(${literal(name)}, "rb"))`).join(", ")}],`,
      ...(hasKey ? [`    headers={${KEY}},`] : []),
      ")",
      "print(answer.json())",
    ].join("\n");
  }
  const isPlain = call.body === undefined && call.method === "GET" && !hasKey;
  const open = isPlain ? `urlopen(${literal(url)})` : "urlopen(request)";
  const lines = [
    "import json",
    ...(hasKey ? ["import os"] : []),
    `from urllib.request import ${open.includes("request)") ? "Request, " : ""}urlopen`,
    "",
  ];
  if (call.body !== undefined) lines.push(`call = ${literal(call.body, 0)}`);
  if (open.includes("request)")) {
    lines.push("request = Request(", `    ${literal(url)},`);
    if (call.body !== undefined) {
      const headers = { "Content-Type": "application/json", ...(call.accept ? { Accept: call.accept } : {}) };
      const all = hasKey ? `{**${literal(headers)}, ${KEY}}` : literal(headers);
      lines.push("    data=json.dumps(call).encode(),", `    headers=${all},`);
    } else if (hasKey) lines.push(`    headers={${KEY}},`);
    if (call.method !== "POST" || call.body === undefined) lines.push(`    method=${literal(call.method)},`);
    lines.push(")");
  }
  const shown =
    call.accept || call.path.endsWith("/urdf") ? "answer.read().decode()" : "json.dumps(json.load(answer), indent=2)";
  return [...lines, `with ${open} as answer:`, `    print(${shown})`].join("\n");
}

function json(_: string, call: Call): string {
  const head = `${call.method} /${call.path}`;
  if (call.form) {
    const { fields, part, files } = call.form;
    return `${head}\n\n${indented(fields)}\n+ ${part}: ${files.map(({ name }) => name).join(", ")}`;
  }
  return call.body === undefined ? head : indented(call.body);
}

/** For a shell: in single quotes. */
function quoted(text: string): string {
  return `'${text.replaceAll("'", `'\\''`)}'`;
}

/** JSON with a field a line, short lists on one. */
function indented(body: unknown): string {
  return write(body, 0, (value) => JSON.stringify(value));
}

function literal(value: unknown, depth?: number): string {
  const scalar = (item: unknown) => {
    if (item === null) return "None";
    if (item === true) return "True";
    if (item === false) return "False";
    return JSON.stringify(item);
  };
  return depth === undefined ? flat(value, scalar) : write(value, depth, scalar);
}

function write(value: unknown, depth: number, scalar: (value: unknown) => string): string {
  const short = flat(value, scalar);
  if (short.length + 4 * depth < 72 || value === null || typeof value !== "object") return short;
  const inner = "    ".repeat(depth + 1);
  const outer = "    ".repeat(depth);
  const isList = Array.isArray(value);
  const parts = isList
    ? value.map((item) => write(item, depth + 1, scalar))
    : Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${write(item, depth + 1, scalar)}`);
  return `${isList ? "[" : "{"}\n${parts.map((part) => inner + part).join(",\n")}\n${outer}${isList ? "]" : "}"}`;
}

function flat(value: unknown, scalar: (value: unknown) => string): string {
  if (Array.isArray(value)) return `[${value.map((item) => flat(item, scalar)).join(", ")}]`;
  if (value === null || typeof value !== "object") return scalar(value);
  return `{${Object.entries(value)
    .map(([key, item]) => `${JSON.stringify(key)}: ${flat(item, scalar)}`)
    .join(", ")}}`;
}
