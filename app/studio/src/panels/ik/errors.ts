/** How far a pose is from the target, in the directions that count. */

import { type Matrix4, Vector3 } from "three";

import { orientation } from "../../robot/pose.ts";
import type { Direction, Errors } from "../../types.ts";
import { fixed, inUnit, type Kind, scientific, type Units, withUnit } from "../../ui/quantity.ts";

const ROTATIONS = ["rx", "ry", "rz"] as const;

/** Distance [m] and angle [rad] from the target to the tip, as the service has them: see `task` of the call. */
export function errorsOf(task: readonly Direction[], T_base_target: Matrix4, T_base_tip: Matrix4): Errors {
  const apart = new Vector3().setFromMatrixPosition(T_base_tip);
  apart.sub(new Vector3().setFromMatrixPosition(T_base_target));
  const distances = (["x", "y", "z"] as const).map((axis) => (task.includes(axis) ? apart[axis] : 0));
  const free = ROTATIONS.findIndex((direction) => !task.includes(direction));
  const count = ROTATIONS.filter((direction) => task.includes(direction)).length;
  if (count === 2) {
    const [wanted, found] = [T_base_target, T_base_tip].map((T) => new Vector3().setFromMatrixColumn(T, free));
    return { position_error: Math.hypot(...distances), orientation_error: between(wanted!, found!) };
  }
  const vector = orientation(T_base_target.clone().invert().multiply(T_base_tip), "rotation_vector") as number[];
  const angles = vector.map((angle, i) => (task.includes(ROTATIONS[i]!) ? angle : 0));
  return { position_error: Math.hypot(...distances), orientation_error: Math.hypot(...angles) };
}

/** Angle of two unit vectors, right to rounding at 0 and π too. */
function between(a: Vector3, b: Vector3): number {
  return 2 * Math.atan2(a.clone().sub(b).length(), a.clone().add(b).length());
}

/** Errors in words, as far as they count. */
export function errors(
  { position_error, orientation_error }: Errors,
  task: readonly Direction[],
  units: Units,
): string {
  const parts: string[] = [];
  if (hasPosition(task)) parts.push(written(position_error, "length", units));
  if (hasOrientation(task)) parts.push(written(orientation_error, "angle", units));
  return parts.join(", ");
}

export function hasPosition(task: readonly Direction[]): boolean {
  return task.some((direction) => !direction.startsWith("r"));
}

export function hasOrientation(task: readonly Direction[]): boolean {
  return task.some((direction) => direction.startsWith("r"));
}

function written(error: number, kind: Kind, units: Units): string {
  const value = inUnit(error, kind, units);
  return withUnit(value !== 0 && value < 1e-3 ? scientific(value) : fixed(value, 4), kind, units);
}
