/** Poses of a tool from a table: a row each, in metres and radians. */

import type { Pose } from "../../types.ts";
import { parse, SI } from "../../ui/quantity.ts";

const POSITION = ["x", "y", "z"] as const;
/** As the command line names the columns. */
const ORIENTATIONS = {
  rpy: ["roll", "pitch", "yaw"],
  quaternion_xyzw: ["qx", "qy", "qz", "qw"],
  zyz: ["phi", "theta", "psi"],
  rotation_vector: ["rx", "ry", "rz"],
} as const;
type Notation = keyof typeof ORIENTATIONS;

/** The notation of the orientation, and in which columns the numbers are, the position first. */
interface Layout {
  notation: Notation;
  columns: number[];
}

/** Throws an error that names the line, where it holds no pose. */
export function posesFrom(text: string): Pose[] {
  const lines = text
    .split("\n")
    .map((line, i) => ({ number: i + 1, cells: cellsOf(line) }))
    .filter(({ cells }) => cells.length > 0);
  const named = lines[0] && headed(lines[0].cells);
  const rows = named ? lines.slice(1) : lines;
  if (rows.length === 0) throw new Error("there are no poses in it");
  return rows.map(({ number, cells }) => poseOf(cells, named ?? counted(cells, number), number));
}

/** Between semicolons, else commas, else blanks or tabs; beside semicolons a comma is one of decimals. */
function cellsOf(line: string): string[] {
  const text = line.replace(/#.*/, "").trim();
  const between = [";", ","].find((mark) => text.includes(mark)) ?? /\s+/;
  return text === "" ? [] : text.split(between).map((cell) => cell.trim());
}

/** Where a first line names columns; null where it holds numbers. */
function headed(cells: readonly string[]): Layout | null {
  if (cells.every((cell) => parse(cell, "angle", SI) !== null)) return null;
  const names = cells.map((cell) => cell.toLowerCase().replace(/\W.*/, "")); // `x [m]`
  for (const [notation, orientation] of Object.entries(ORIENTATIONS)) {
    const columns = [...POSITION, ...orientation].map((name) => names.indexOf(name));
    if (columns.every((column) => column >= 0)) return { notation: notation as Notation, columns };
  }
  throw new Error("its first line names no columns x y z with roll pitch yaw, qx qy qz qw, rx ry rz or phi theta psi");
}

function counted(cells: readonly string[], line: number): Layout {
  const notation = { 6: "rpy", 7: "quaternion_xyzw" }[cells.length] as Notation | undefined;
  if (notation) return { notation, columns: cells.map((_, i) => i) };
  throw new Error(
    `line ${line} has ${cells.length} numbers; allowed are 6 (x y z roll pitch yaw) and 7 (x y z qx qy qz qw)`,
  );
}

function poseOf(cells: readonly string[], { notation, columns }: Layout, line: number): Pose {
  const numbers = columns.map((column, i) => {
    const turned = notation === "quaternion_xyzw" ? "number" : "angle";
    const value = parse(cells[column] ?? "", i < 3 ? "length" : turned, SI);
    if (value === null) throw new Error(`line ${line}: “${cells[column] ?? ""}” is no number`);
    return value;
  });
  return { position: numbers.slice(0, 3), [notation]: numbers.slice(3) };
}
