/** How a table's frames come about: four motions a row, each about or along one axis of the frame so far. */

import { Matrix4 } from "three";

import { type Parameter, valuesOf } from "../robot/dh.ts";
import { asMatrix } from "../robot/pose.ts";
import type { Positions } from "../state.ts";
import type { Convention, DhTable } from "../types.ts";

/** In this order a row's motions are multiplied. */
export const ORDER: Record<Convention, readonly Parameter[]> = {
  standard: ["theta", "d", "a", "alpha"],
  modified: ["alpha", "a", "theta", "d"],
};

/** One motion: what the frame is before it, in the base. */
export interface Screw {
  row: number;
  part: Parameter;
  value: number;
  before: Matrix4;
}

export interface Course {
  screws: readonly Screw[];
  /** Frames 0 to n, and the tool. */
  frames: readonly Matrix4[];
  tool: Matrix4;
}

export function courseOf(table: DhTable, positions: Positions): Course {
  const T = asMatrix(table.base);
  const frames = [T.clone()];
  const screws = table.joints.flatMap((joint, row) => {
    const values = valuesOf(joint, row, positions);
    const made = ORDER[table.convention].map((part): Screw => {
      const before = T.clone();
      T.multiply(motion(part, values[part]));
      return { row, part, value: values[part], before };
    });
    frames.push(T.clone());
    return made;
  });
  return { screws, frames, tool: T.clone().multiply(asMatrix(table.tool)) };
}

/** Where the frame is within a step; 0 is frame 0, and 4n the last. */
export function frameAt({ screws, frames }: Course, step: number): Matrix4 {
  const screw = screws[Math.floor(step)];
  if (!screw) return frames.at(-1)!.clone();
  return screw.before.clone().multiply(motion(screw.part, screw.value * (step % 1)));
}

export function motion(part: Parameter, value: number): Matrix4 {
  const T = new Matrix4();
  if (part === "theta") return T.makeRotationZ(value);
  if (part === "alpha") return T.makeRotationX(value);
  return part === "d" ? T.makeTranslation(0, 0, value) : T.makeTranslation(value, 0, 0);
}
