/** Wraps texts of a module in `t(…)`: templates become texts with named values. */

import { dirname, posix } from "node:path";

import { found, piecesOf } from "./find.mjs";

const MODULE = "texts/index.ts";
/** Methods that write a value, which gives the name. */
const FORMATS = new Set(["toLocaleString", "toFixed", "toString", "join"]);

/** The module's source with all its texts wrapped; itself where nothing is left to wrap. */
export async function wrapped(file, source) {
  for (let now = source; ;) {
    const { unmarked, tree } = await found(file, now);
    if (unmarked.length === 0) return now === source ? source : withImport(file, now);
    if (declaresT(tree, file)) throw new Error(`${file} has another t: give it a longer name`);
    // From the end on, so that places before it stay where they are; what stands in values is wrapped the next time.
    for (const { node } of unmarked.toReversed()) {
      const [from, to] = node.range;
      now = now.slice(0, from) + call(node, now) + now.slice(to);
    }
  }
}

function call(node, source) {
  const { texts, values } = piecesOf(node);
  const names = namesOf(values);
  const text = texts.reduce((made, part, i) => `${made}{${names[i - 1]}}${part}`);
  if (values.length === 0) return `t(${JSON.stringify(text)})`;
  const listed = new Map(values.map((value, i) => [names[i], source.slice(...value.range)]));
  const fields = [...listed].map(([name, value]) => (name === value ? name : `${name}: ${value}`));
  return `t(${JSON.stringify(text)}, { ${fields.join(", ")} })`;
}

/** A name for each value, of what it is made from; two values that are the same have the same one. */
function namesOf(values) {
  const taken = new Map();
  return values.map((value) => {
    const wanted = (nameIn(value) ?? "value").replace(/^[#_]+/, "");
    const written = JSON.stringify(value, (key, part) => (["loc", "range"].includes(key) ? undefined : part));
    for (let n = 1; ; n++) {
      const name = n === 1 ? wanted : `${wanted}${n}`;
      if ((taken.get(name) ?? written) !== written) continue;
      taken.set(name, written);
      return name;
    }
  });
}

function nameIn(node) {
  switch (node?.type) {
    case "Identifier":
      return /^[A-Za-z]\w*$/.test(node.name) ? node.name : null;
    case "MemberExpression":
      return node.computed ? nameIn(node.object) : nameIn(node.property);
    case "PrivateIdentifier":
      return node.name;
    case "CallExpression":
      return FORMATS.has(node.callee.property?.name)
        ? nameIn(node.callee.object)
        : (node.arguments.map(nameIn).find(Boolean) ?? nameIn(node.callee.object ?? node.callee));
    case "BinaryExpression":
    case "LogicalExpression":
      return nameIn(node.left) ?? nameIn(node.right);
    case "ConditionalExpression":
      return nameIn(node.consequent) ?? nameIn(node.alternate) ?? nameIn(node.test);
    case "TemplateLiteral":
      return node.expressions.map(nameIn).find(Boolean) ?? null;
    case "TSNonNullExpression":
    case "TSAsExpression":
    case "UnaryExpression":
    case "SpreadElement":
    case "ChainExpression":
      return nameIn(node.expression ?? node.argument);
    default:
      return null;
  }
}

/** Whether a name of the module would hide the function, wherever it is declared. */
function declaresT(tree) {
  const isT = (node) =>
    node &&
    typeof node === "object" &&
    (Array.isArray(node)
      ? node.some(isT)
      : (/^(?:Variable|Function)Declar/.test(node.type) && names(node.id).includes("t")) ||
        (node.params ?? []).some((param) => names(param).includes("t")) ||
        Object.entries(node).some(
          ([key, value]) => !["loc", "range", "tokens", "comments"].includes(key) && isT(value),
        ));
  return isT(tree.body);
}

/** The names that a pattern declares. */
function names(pattern) {
  if (!pattern) return [];
  if (pattern.type === "Identifier") return [pattern.name];
  const inside = pattern.properties?.map(({ value, argument }) => value ?? argument) ?? pattern.elements;
  return (inside ?? [pattern.left, pattern.argument]).filter(Boolean).flatMap(names);
}

/** With the import of `t`, among the others where it belongs by its path. */
function withImport(file, source) {
  const path = posix.relative(dirname(file), MODULE);
  const from = path.startsWith(".") ? path : `./${path}`;
  const line = `import { t } from "${from}";\n`;
  const old = new RegExp(`^import \\{ (.*) \\} from "${from}";\n`, "m").exec(source);
  if (old) {
    const named = [...new Set([...old[1].split(", "), "t"])].sort();
    return source.replace(old[0], `import { ${named.join(", ")} } from "${from}";\n`);
  }
  const imports = [...source.matchAll(/^import (?:[^;]*? from )?"([^"]+)";\n/gm)];
  const relative = imports.filter(([, other]) => other.startsWith("."));
  const next = relative.find(([whole, other]) => rank(other) > rank(from) && !whole.startsWith('import "'));
  if (next) return source.slice(0, next.index) + line + source.slice(next.index);
  const last = imports.at(-1);
  if (last) return source.slice(0, last.index + last[0].length) + line + source.slice(last.index + last[0].length);
  const head = /^\/\*\*[^]*?\*\/\n\n/.exec(source)?.[0] ?? "";
  return `${head}${line}\n${source.slice(head.length)}`;
}

/** Paths upwards come first, as in the sources. */
function rank(path) {
  return path.replaceAll("../", "!").replace("./", "~");
}
