/** What stands around the robot or hangs on it: the objects as the service takes them. */

import type { Matrix4 } from "three";

import { asMatrix, asPose, isPose } from "../robot/pose.ts";
import type { Scene as ApiScene, SceneObject } from "../types.ts";

export type Shape = SceneObject["shape"];
export type Kind = Shape["type"];

export interface Scene {
  /** Under which the service keeps it as it is; null for one that has been changed, or that it does not keep. */
  name: string | null;
  objects: readonly SceneObject[];
}

export const EMPTY: Scene = { name: null, objects: [] };

/** Shapes that can be added, and their sizes for a robot whose marks are so long, [m]. */
export const ADDED: readonly { kind: Kind; text: string; shape: (unit: number) => Shape }[] = [
  { kind: "box", text: "Box", shape: (u) => ({ type: "box", size: [2 * u, 2 * u, 2 * u].map(round) }) },
  { kind: "sphere", text: "Sphere", shape: (u) => ({ type: "sphere", radius: round(u) }) },
  {
    kind: "cylinder",
    text: "Cylinder",
    shape: (u) => ({ type: "cylinder", radius: round(u / 2), length: round(4 * u) }),
  },
  { kind: "half_space", text: "Floor", shape: () => ({ type: "half_space", normal: [0, 0, 1], offset: 0 }) },
];

/** The field `scene` of a call; nothing where there is no object. */
export function sceneField({ name, objects }: Scene): { scene?: string | ApiScene } {
  if (objects.length === 0) return {};
  return { scene: name ?? { objects: [...objects] } };
}

/** T_frame_shape, the frame being the root or that which it is attached to. */
export function placeOf(object: SceneObject): Matrix4 {
  return asMatrix(object.pose);
}

/** The object elsewhere. */
export function moved(object: SceneObject, T: Matrix4): SceneObject {
  return { ...object, pose: asPose(T, "rpy") };
}

/** The scene with another object in the place of one; null takes it away. */
export function replaced({ objects }: Scene, name: string, by: SceneObject | null): Scene {
  return { name: null, objects: objects.flatMap((one) => (one.name === name ? (by ?? []) : one)) };
}

/** A name that no other object has, nor a link. */
export function freeName(base: string, taken: ReadonlySet<string>): string {
  for (let i = 1; ; i += 1) {
    const name = `${base} ${i}`;
    if (!taken.has(name)) return name;
  }
}

/** Objects of an address, as far as they can be drawn; whether they go together is for the service to say. */
export function asObjects(given: unknown): SceneObject[] {
  if (!Array.isArray(given)) return [];
  return given.filter((one: Partial<SceneObject> | null) => {
    const type = (one?.shape as { type?: unknown } | undefined)?.type;
    return typeof one?.name === "string" && typeof type === "string" && (one.pose == null || isPlace(one.pose));
  }) as SceneObject[];
}

/** A position alone turns nothing. */
function isPlace(pose: unknown): boolean {
  return isPose(pose) || isPose({ rpy: [0, 0, 0], ...(pose as object) });
}

function round(length: number): number {
  return Number(length.toPrecision(1));
}
