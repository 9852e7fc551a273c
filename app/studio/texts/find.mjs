/** Finds in a module's syntax tree the strings that people read, those that are marked already, and glued ones. */

import { parsers } from "prettier/plugins/typescript";

import {
  EXCEPTIONS,
  FILES_WITHOUT,
  MAKERS,
  READ,
  SAME,
  SILENT,
  SILENT_METHODS,
  UNREAD,
  WIRE,
  WORDS,
  WRITERS,
} from "./rules.mjs";

const COMPARES = new Set(["===", "!==", "==", "!=", "in"]);
/** What stands around a value without being its context. */
const TRANSPARENT = new Set(["ConditionalExpression", "LogicalExpression", "TSAsExpression", "TSNonNullExpression"]);
/** What may be assigned a text. */
const TEXT_OF_ELEMENT = new Set(["textContent", "innerText", "title", "placeholder", "ariaLabel", "alt"]);
const NOT_ASSIGNED = /^(?:name|className|id|href|src|type|value|cursor|transform|font|\w+Style)$/;

/**
 * The strings of a module.
 *
 * @param file below `src/`, with slashes.
 * @returns `unmarked`: nodes to wrap, each with its `key`; `marked`: keys that `t` is called with; `glued`: remarks on
 *   sentences that do not translate; `tree`.
 */
export async function found(file, source) {
  const result = { unmarked: [], marked: [], glued: [], tree: null };
  if (FILES_WITHOUT.test(file)) return result;
  result.tree = await parsers.typescript.parse(source, { filepath: file });
  const [exceptions, also] = [new Set(EXCEPTIONS[file]), new Set(WORDS[file])];
  const writers = new Set(WRITERS[file]);
  walk(result.tree, [], (node, above) => {
    if (writers.has(node.id?.name)) return false;
    const line = node.loc?.start.line;
    if (isMark(node)) {
      const keys = keysOf(node.arguments[0]);
      if (keys.length === 0) result.glued.push({ line, key: "t() of something else than a constant text" });
      result.marked.push(...keys.map((key) => ({ key, line })));
      return true;
    }
    const key = keyOf(node);
    if (key === null) return true;
    if (exceptions.has(key) || !isRead(node, above, key, also.has(key))) return node.type !== "BinaryExpression";
    result.unmarked.push({ node, key, line });
    return false;
  });
  result.unmarked.sort((a, b) => a.node.range[0] - b.node.range[0]);
  for (const { key, line } of [...result.marked, ...result.unmarked])
    if (isGlued(key)) result.glued.push({ line, key });
  return result;
}

/** The constant part of a string, with `{}` where values stand in it; null for what is no string. */
export function keyOf(node) {
  if (node.type === "Literal" && typeof node.value === "string") return node.value;
  if (node.type === "BinaryExpression" && node.operator === "+") {
    const [left, right] = [keyOf(node.left), keyOf(node.right)];
    return left === null || right === null ? null : left + right;
  }
  if (node.type !== "TemplateLiteral") return null;
  return node.quasis.map(({ value }) => value.cooked).join("{}");
}

/** Strings that are added to each other, and templates, as one: constant parts and the values between them. */
export function piecesOf(node) {
  if (node.type === "Literal") return { texts: [node.value], values: [] };
  if (node.type === "TemplateLiteral")
    return { texts: node.quasis.map(({ value }) => value.cooked), values: node.expressions };
  const [left, right] = [piecesOf(node.left), piecesOf(node.right)];
  const middle = left.texts.at(-1) + right.texts[0];
  return {
    texts: [...left.texts.slice(0, -1), middle, ...right.texts.slice(1)],
    values: [...left.values, ...right.values],
  };
}

/** Whether a text is a part of a sentence, or a value is a part of a word in it. */
function isGlued(key) {
  return /^[\s,;:]|\s$|[A-Za-z]\{\w*\}|\{\w*\}[A-Za-z]/.test(key);
}

function isMark(node) {
  return node.type === "CallExpression" && node.callee.type === "Identifier" && node.callee.name === "t";
}

/** The keys of a mark's first argument: one, or those of both branches. */
function keysOf(argument) {
  if (argument?.type === "ConditionalExpression") return [argument.consequent, argument.alternate].flatMap(keysOf);
  return argument?.type === "Literal" ? [String(argument.value)] : [];
}

/** Visit what is in a node; what `visit` answers with false is not entered, nor the text of a mark. */
function walk(node, above, visit) {
  if (!node || typeof node.type !== "string" || !visit(node, above)) return;
  const inside = [...above, node];
  for (const [name, value] of Object.entries(node)) {
    if (["loc", "range", "tokens", "comments", "parent"].includes(name)) continue;
    const entered = isMark(node) && name === "arguments" ? value.slice(1) : Array.isArray(value) ? value : [value];
    for (const one of entered) if (one && typeof one === "object") walk(one, inside, visit);
  }
}

/** Whether people read a string: its place decides, then its content. */
function isRead(node, above, key, isWord) {
  const context = contextOf(node, above);
  if (context === "unread") return false;
  if (isWord) return true;
  if (context === "wire") return /^[A-Z][a-z]+ [a-z]/.test(key);
  const words = key.replaceAll("{}", " ").replaceAll(SAME, "");
  if (!/[A-Za-z]{2}/.test(words) || /[\\<>]|^[#./]|^https?:|_|\w\/\w/.test(words)) return false;
  if (context === "read") return true;
  const isSentence = /[A-Za-z]{2,}[^\w]* +\S|\s[a-z]{2,}|^[a-z]{2,} /.test(words);
  return isSentence || /^[A-Z][a-z]+/.test(words.trim());
}

/** "read" where single words are texts too, "wire" where only sentences are, "unread" where nothing is, else "any". */
function contextOf(node, above) {
  let inner = node;
  for (let i = above.length - 1; i >= 0; i--) {
    const outer = above[i];
    if (outer.type.startsWith("TS") && !TRANSPARENT.has(outer.type) && !/Satisfies|Instantiation/.test(outer.type))
      return "unread";
    if (/^(?:Import|Export(?:All|Named))/.test(outer.type) && outer.source === inner) return "unread";
    if (outer.type === "TaggedTemplateExpression" || (outer.type === "SwitchCase" && outer.test === inner))
      return "unread";
    if (outer.type === "BinaryExpression" && COMPARES.has(outer.operator)) return "unread";
    if (outer.type === "MemberExpression" && outer.property === inner) return "unread";
    if (outer.type === "ConditionalExpression" && outer.test === inner) return "unread";
    if (outer.type === "AssignmentExpression" && outer.right === inner) {
      const name = String(outer.left.property?.name ?? outer.left.property?.value ?? outer.left.name);
      return TEXT_OF_ELEMENT.has(name) ? "read" : NOT_ASSIGNED.test(name) || isStyle(outer.left) ? "unread" : "any";
    }
    if (outer.type === "Property" || outer.type === "PropertyDefinition") {
      if (outer.key === inner) return "unread";
      if (above[i - 2] && isMark(above[i - 2])) return "any";
      const name = String(outer.key.name ?? outer.key.value);
      if (UNREAD.test(name)) return "unread";
      if (WIRE.test(name)) return "wire";
      if (READ.has(name)) return "read";
      if (isAttribute(above, i)) return "unread";
      return "any";
    }
    if (outer.type === "CallExpression" || outer.type === "NewExpression") return ofArgument(outer, inner);
    if (!TRANSPARENT.has(outer.type)) return "any";
    inner = outer;
  }
  return "any";
}

/** `x.style.y` and `x.dataset["y"]`. */
function isStyle({ object }) {
  return ["style", "dataset"].includes(object?.property?.name);
}

/** Whether a property is an attribute of an element that is made. */
function isAttribute(above, i) {
  const [call, object] = [above[i - 2], above[i - 1]];
  return call?.type === "CallExpression" && MAKERS.has(nameOf(call)) && call.arguments[1] === object;
}

function ofArgument(call, inner) {
  const name = nameOf(call);
  const index = call.arguments.indexOf(inner);
  if (index < 0) return "any";
  if (MAKERS.has(name)) return index >= 2 ? "read" : "unread";
  if (name === "setAttribute") return index === 1 && READ.has(call.arguments[0].value) ? "read" : "unread";
  if ((call.callee.type === "MemberExpression" ? SILENT_METHODS : SILENT).has(name)) return "unread";
  if (["button", "section", "toggle", "titled", "explained"].includes(name)) return index === 0 ? "read" : "any";
  return "any";
}

export function nameOf(call) {
  return call.callee.name ?? call.callee.property?.name;
}
