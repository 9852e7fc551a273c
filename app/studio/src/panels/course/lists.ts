/** Lists of numbers as they are typed: `0, 2π, π/2`, or rows in brackets, `(0, 1) (2, 3)`. */

import { exact, parse, SI } from "../../ui/quantity.ts";

type Item = number | number[];

const BETWEEN = /\s*;\s*|,\s+|\s+/;
const ROW = /\(([^()]*)\)/g;

/** The numbers; null where something is none. A comma within a number is a decimal one. */
export function parsedList(text: string): Item[] | null {
  const rows = [...text.matchAll(ROW)];
  if (!rows.length) return numbers(text);
  const found = rows.map(([, row]) => numbers(row!));
  const isRest = text.replace(ROW, "").replace(/[\s,;]/g, "") !== "";
  return isRest || found.includes(null) ? null : (found as number[][]);
}

export function writtenList(value: unknown): string {
  if (!Array.isArray(value)) return typeof value === "number" ? written(value) : "";
  return value.map((item) => (Array.isArray(item) ? `(${item.map(written).join(", ")})` : written(item))).join(", ");
}

function numbers(text: string): number[] | null {
  const parts = text.trim().split(BETWEEN).filter(Boolean);
  const found = parts.map((part) => parse(part.replace(/,$/, ""), "number", SI));
  return found.length === 0 || found.includes(null) ? null : (found as number[]);
}

function written(value: unknown): string {
  return typeof value === "number" ? exact(value, "angle", SI) : String(value);
}
