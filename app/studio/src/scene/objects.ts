/** What stands around the robot or hangs on it: the objects as the service takes them. */

import type { Matrix4 } from "three";

import type { ShownChain } from "../robot/chain.ts";
import { asMatrix, asPose, isPose } from "../robot/pose.ts";
import { t } from "../texts/index.ts";
import type { Scene as ApiScene, SceneObject } from "../types.ts";

export type Shape = SceneObject["shape"];
export type Kind = Shape["type"];

export interface Scene {
  /** Under which the service keeps it as it is; null for one that has been changed, or that it does not keep. */
  name: string | null;
  objects: readonly SceneObject[];
  /** The stored scene that it comes from, which has the files of its objects. */
  origin: string | null;
}

export const EMPTY: Scene = { name: null, objects: [], origin: null };

/** Shapes that can be added, and their sizes for a robot whose marks are so long, [m]. */
export const ADDED: readonly { kind: Kind; text: string; shape: (unit: number) => Shape }[] = [
  { kind: "box", text: t("Box"), shape: (u) => ({ type: "box", size: [2 * u, 2 * u, 2 * u].map(round) }) },
  { kind: "sphere", text: t("Sphere"), shape: (u) => ({ type: "sphere", radius: round(u) }) },
  {
    kind: "cylinder",
    text: t("Cylinder"),
    shape: (u) => ({ type: "cylinder", radius: round(u / 2), length: round(4 * u) }),
  },
  { kind: "half_space", text: t("Floor"), shape: () => ({ type: "half_space", normal: [0, 0, 1], offset: 0 }) },
];

/** The field `scene` of a call; nothing where there is no object. Files are read of a stored scene alone, so that for a
 * changed one with files it is that which it comes from, until it is stored itself. */
export function sceneField(scene: Scene): { scene?: string | ApiScene } {
  const { name, objects, origin } = scene;
  if (objects.length === 0) return {};
  return { scene: name ?? (filesOf(scene).length ? origin : null) ?? { objects: [...objects] } };
}

/** The fields of a call for what the arm must not touch: objects, and links that move with joints off its chain;
 * nothing where there is no object. */
export function surroundings(
  scene: Scene,
  others: ShownChain["others"],
): ReturnType<typeof sceneField> & typeof others {
  return scene.objects.length ? { ...sceneField(scene), ...others } : {};
}

/** Names of the files that the objects are read from. */
export function filesOf({ objects }: Pick<Scene, "objects">): string[] {
  const files = objects.flatMap(({ shape }) => ("file" in shape && shape.file ? [shape.file] : []));
  return [...new Set(files)];
}

/** The scene with other objects. */
export function changed({ origin }: Scene, objects: readonly SceneObject[]): Scene {
  return { name: null, objects, origin };
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
export function replaced(scene: Scene, name: string, by: SceneObject | null): Scene {
  return changed(
    scene,
    scene.objects.flatMap((one) => (one.name === name ? (by ?? []) : one)),
  );
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
