/** A Denavit-Hartenberg table in the browser: its transforms and frames at a configuration. */

import { Matrix4, Vector3 } from "three";

import type { Positions } from "../state.ts";
import type { DhRow, DhTable } from "../types.ts";
import { asMatrix } from "./pose.ts";

/** A row at a configuration, in the frame that the table starts from. */
export interface DhFrame {
  /** T_base_i. */
  T: Matrix4;
  /** Ends of the dimension `a`, along x. */
  a: [Vector3, Vector3];
  /** Ends of the dimension `d`, along z. */
  d: [Vector3, Vector3];
}

/** A frame a row, each after the one before; `first` is frame 0. */
export function frames(table: DhTable, positions: Positions): { first: Matrix4; rows: DhFrame[]; tool: Matrix4 } {
  const first = asMatrix(table.base);
  const found: DhFrame[] = [];
  let T = first.clone();
  for (const [index, row] of table.joints.entries()) {
    const start = T.clone();
    const [first, second] = screws(table, row, variable(row, index, positions));
    const middle = start.clone().multiply(first);
    T = middle.clone().multiply(second);
    const [from, foot, to] = [start, middle, T].map((M) => new Vector3().setFromMatrixPosition(M)) as Three;
    const ends: { a: [Vector3, Vector3]; d: [Vector3, Vector3] } =
      table.convention === "standard" ? { d: [from, foot], a: [foot, to] } : { a: [from, foot], d: [foot, to] };
    found.push({ T, ...ends });
  }
  return { first, rows: found, tool: T.clone().multiply(asMatrix(table.tool)) };
}

/** A_i of every row. */
export function transforms(table: DhTable, positions: Positions): Matrix4[] {
  return table.joints.map((row, index) => {
    const [first, second] = screws(table, row, variable(row, index, positions));
    return first.multiply(second);
  });
}

/** The two screws of a row, in the order of its convention: A_i is their product. */
function screws(table: DhTable, row: DhRow, q: number): [Matrix4, Matrix4] {
  const theta = row.theta + (row.type === "revolute" ? q : 0);
  const d = row.d + (row.type === "prismatic" ? q : 0);
  const alongX = new Matrix4().makeRotationX(row.alpha).setPosition(row.a, 0, 0);
  const alongZ = new Matrix4().makeRotationZ(theta).setPosition(0, 0, d);
  return table.convention === "standard" ? [alongZ, alongX] : [alongX, alongZ];
}

type Three = [Vector3, Vector3, Vector3];

function variable(row: DhRow, index: number, positions: Positions): number {
  if (row.mimic) return (row.mimic.multiplier ?? 1) * (positions[row.mimic.joint] ?? 0) + (row.mimic.offset ?? 0);
  return positions[jointName(row, index)] ?? 0;
}

/** The name of a row's joint: the service gives one to a row that has none. */
export function jointName(row: DhRow, index: number): string {
  return row.name ?? `joint_${index + 1}`;
}
