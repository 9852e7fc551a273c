/** Answers as they are typed, as they travel, and as they are read. */

import type { ExerciseField } from "../../types.ts";
import { kindOfUnit, parse, SI } from "../../ui/quantity.ts";

/** What is typed, cell by cell: a row for each row of a matrix or table, and for each solution of a set. */
export type Grid = string[][];

/** The columns of a DH table. */
export const DH_COLUMNS = ["a", "α", "d", "ϑ"];
const DH_UNITS = ["m", "rad", "m", "rad"];

const DIGITS = 5;
/** Part of the largest number of an answer that is only rounding. */
const DUST = 1e-12;

export function emptyGrid({ shape }: ExerciseField): Grid {
  const [rows, columns] = hasRows(shape) ? shape : [1, shape[0] ?? 1];
  return Array.from({ length: rows! }, () => Array<string>(columns!).fill(""));
}

/** The unit of a column; empty without one. */
export function unitAt(field: ExerciseField, column: number): string {
  return field.kind === "dh_table" ? DH_UNITS[column]! : (field.unit ?? "");
}

/** What the service is sent; undefined where nothing is typed. What is no number goes as it is: the grade says so. */
export function answerOf(field: ExerciseField, grid: Grid): unknown {
  const typed = grid.filter((row) => row.some((text) => text.trim() !== ""));
  if (typed.length === 0) return undefined;
  if (field.kind === "choice") return grid[0]![0];
  const read = (text: string, column: number) => numberOf(text, unitAt(field, column));
  const items = (isSet(field) ? typed : grid).map((row) => (field.shape.length ? row.map(read) : read(row[0]!, 0)));
  return isSet(field) || hasRows(field.shape) ? items : items[0];
}

/** A right answer as rows of numbers. */
export function rowsOf(field: ExerciseField, answer: unknown): number[][] {
  const items = (isSet(field) || hasRows(field.shape) ? answer : [answer]) as (number | number[])[];
  return items.map((item) => (Array.isArray(item) ? item : [item]));
}

/** The numbers of a right answer to read; what is only rounding is 0. `point`: the decimal one, or a comma. */
export function written(rows: readonly number[][], point: string): string[][] {
  const largest = Math.max(...rows.flat().map(Math.abs));
  const digits = (value: number) => (Math.abs(value) < DUST * largest ? 0 : Number(value.toPrecision(DIGITS)));
  return rows.map((row) => row.map((value) => String(digits(value)).replace("-", "−").replace(".", point)));
}

export function isSet({ kind }: ExerciseField): boolean {
  return kind === "set";
}

export function hasRows(shape: readonly number[]): boolean {
  return shape.length === 2;
}

function numberOf(text: string, unit: string): number | string {
  const bare = unit === "°" ? text.replace(/°\s*$/, "") : text;
  return parse(bare, kindOfUnit(unit), SI) ?? text.trim();
}
