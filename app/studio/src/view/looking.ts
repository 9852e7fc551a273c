/** From where the picture is looked at, as the state has it. */

import { Vector3 } from "three";

import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import type { View } from "./view.ts";

/** A point, in the world, [m]. */
type Point = readonly [number, number, number];

export interface Look {
  eye: Point;
  at: Point;
}

/** From where the usual drawings of an arm are made, and what is to the right and up in them. */
export const SIDES = [
  // A little from the front: straight from above there would be no telling what is to the right.
  { text: t("Top"), title: t("From above: x to the right, y up"), from: new Vector3(0, -1e-3, 1).normalize() },
  { text: t("Front"), title: t("From the front: x to the right, z up"), from: new Vector3(0, -1, 0) },
  { text: t("Side"), title: t("From the side: y to the right, z up"), from: new Vector3(1, 0, 0) },
  { text: t("Iso"), title: t("All three axes equally short"), from: new Vector3(1, -1, 1).normalize() },
] as const;
const FARTHEST = 1e4; // m

/** Six numbers of a link; null where they say nothing that can be looked at. */
export function asLook(numbers: readonly number[]): Look | null {
  if (numbers.length !== 6 || !numbers.every((number) => Math.abs(number) <= FARTHEST)) return null;
  const [x, y, z, u, v, w] = numbers as [number, number, number, number, number, number];
  return Math.hypot(x - u, y - v, z - w) > 1e-3 ? { eye: [x, y, z], at: [u, v, w] } : null;
}

/** Keep camera and state alike. Another robot than the one that a camera was chosen for is looked at as a whole. */
export function followCamera(view: View, store: Store<State>): void {
  let robot = store.value.robot;
  view.looked = (camera) => store.set({ camera });
  store.watch(["camera"], (state) => {
    robot = state.robot;
    view.look(state.camera);
  });
  // The table that dragging makes of a robot is still that robot to look at.
  store.watch(["robot"], ({ robot: next }) => view.isDragged && (robot = next));
  store.watch(["parallel"], ({ parallel }) => view.project(parallel));
  store.watch(["model"], (state) => {
    if (!state.model) return;
    view.show(state.model);
    if (state.robot !== robot) store.set({ camera: null });
    robot = state.robot;
  });
}
