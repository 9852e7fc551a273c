/** A Denavit-Hartenberg table in the browser: its transforms and frames at a configuration. */

import { Matrix4, Vector3 } from "three";

import type { Positions } from "../state.ts";
import type { Convention, DhRow, DhTable } from "../types.ts";
import { asMatrix } from "./pose.ts";

/** The four parameters of a row, in the order of the standard convention. */
export const PARAMETERS = ["theta", "d", "a", "alpha"] as const;
export type Parameter = (typeof PARAMETERS)[number];

/** Four parameters that a row has at a configuration, [m and rad]. */
export type Values = Record<Parameter, number>;

/** A row at a configuration, in the frame that the table starts from. */
export interface DhFrame {
  /** T_base_i. */
  T: Matrix4;
  values: Values;
  /** Ends of the dimension `a`, along x. */
  a: [Vector3, Vector3];
  /** Ends of the dimension `d`, along z. */
  d: [Vector3, Vector3];
  /** Where θ is measured: about z, from x. */
  theta: Matrix4;
  /** Where α is measured: about x, from z. */
  alpha: Matrix4;
}

/** A frame a row, each after the one before; `first` is frame 0. */
export function frames(table: DhTable, positions: Positions): { first: Matrix4; rows: DhFrame[]; tool: Matrix4 } {
  const first = asMatrix(table.base);
  const found: DhFrame[] = [];
  let T = first.clone();
  for (const [index, row] of table.joints.entries()) {
    const start = T.clone();
    const values = valuesOf(row, index, positions);
    const [first, second] = screws(table.convention, values);
    const middle = start.clone().multiply(first);
    T = middle.clone().multiply(second);
    const [from, foot, to] = [start, middle, T].map((M) => new Vector3().setFromMatrixPosition(M)) as Three;
    // Each angle is measured where one of its two axes is drawn: at the frame before or at the row's own.
    const after = middle.clone().setPosition(to);
    found.push({
      T,
      values,
      ...(table.convention === "standard"
        ? { d: [from, foot], a: [foot, to], theta: start, alpha: after }
        : { a: [from, foot], d: [foot, to], alpha: start, theta: after }),
    });
  }
  return { first, rows: found, tool: T.clone().multiply(asMatrix(table.tool)) };
}

/** A_i of every row. */
export function transforms(table: DhTable, positions: Positions): Matrix4[] {
  return table.joints.map((row, index) => {
    const [first, second] = screws(table.convention, valuesOf(row, index, positions));
    return first.multiply(second);
  });
}

/** The two screws of a row, in the order of its convention: A_i is their product. */
function screws(convention: Convention, { theta, d, a, alpha }: Values): [Matrix4, Matrix4] {
  const alongX = new Matrix4().makeRotationX(alpha).setPosition(a, 0, 0);
  const alongZ = new Matrix4().makeRotationZ(theta).setPosition(0, 0, d);
  return convention === "standard" ? [alongZ, alongX] : [alongX, alongZ];
}

type Three = [Vector3, Vector3, Vector3];

/** The parameter that a row's joint changes. */
export function variableOf(row: DhRow): "theta" | "d" {
  return row.type === "revolute" ? "theta" : "d";
}

/** A row's parameters with the position of its joint. */
export function valuesOf(row: DhRow, index: number, positions: Positions): Values {
  const { theta, d, a, alpha } = row;
  const values = { theta, d, a, alpha };
  values[variableOf(row)] += position(row, index, positions);
  return values;
}

function position(row: DhRow, index: number, positions: Positions): number {
  if (row.mimic) return (row.mimic.multiplier ?? 1) * (positions[row.mimic.joint] ?? 0) + (row.mimic.offset ?? 0);
  return positions[jointName(row, index)] ?? 0;
}

/** Which of the joints with a position of their own moves each row: its place in a configuration. */
export function places(rows: readonly DhRow[]): number[] {
  const leaders = rows.map((row, index) => row.mimic?.joint ?? jointName(row, index));
  const order = [...new Set(leaders)];
  return leaders.map((name) => order.indexOf(name));
}

/** The name of a row's joint: the service gives one to a row that has none. */
export function jointName(row: DhRow, index: number): string {
  return row.name ?? `joint_${index + 1}`;
}
