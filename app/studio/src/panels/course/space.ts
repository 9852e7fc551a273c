/** Vectors and frames in space, and how they are seen in a drawing: from in front, from the right and above. */

import type { Point } from "./calculator.ts";

export type Vector = readonly [number, number, number];
export type Rotation = readonly (readonly number[])[];

const YAW = 0.5;
const PITCH = 0.42;

export const IDENTITY: Rotation = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

export function seen([x, y, z]: Vector): Point {
  const right = -Math.sin(YAW) * x + Math.cos(YAW) * y;
  const near = Math.cos(YAW) * x + Math.sin(YAW) * y;
  return [right, -(z * Math.cos(PITCH) - near * Math.sin(PITCH))];
}

export function column(R: Rotation, j: number): Vector {
  return R.map((row) => row[j]!) as unknown as Vector;
}

export function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** A vector turned about a unit axis. */
export function turned(v: Vector, axis: Vector, angle: number): Vector {
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const [x, y, z] = axis;
  const along = dot(axis, v) * (1 - cosine);
  const cross: Vector = [y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]];
  return v.map((value, i) => value * cosine + cross[i]! * sine + axis[i]! * along) as unknown as Vector;
}
