/** What is drawn on the robot: frames, joint axes, link names, and the ends of the chain. */

import { Group, type Matrix4, type Object3D, Vector3 } from "three";

import { shownChain } from "../robot/chain.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { colour } from "./colours.ts";
import { arrow, clear, label, put, rod, triad } from "./shapes.ts";
import type { View } from "./view.ts";

/** Moves marks to where the robot is now. */
type Follow = () => void;

/** Keep the marks as the state wants them, from now on. */
export function mark(view: View, store: Store<State>): void {
  const layer = (keys: readonly (keyof State)[], draw: (group: Group, state: Readonly<State>) => Follow) => {
    const group = new Group();
    view.scene.add(group);
    let follow: Follow = () => {};
    store.watch(["model", "unit", "dark", ...keys], (state) => {
      clear(group);
      follow = draw(group, state);
      follow();
      view.draw();
    });
    store.watch(["positions"], () => {
      follow();
      view.draw();
    });
  };
  layer(["frames", "names", "base", "tip"], linkMarks);
  layer(["axes", "joint"], axisMarks);
}

/** Frames and names of links. */
function linkMarks(group: Group, state: Readonly<State>): Follow {
  const chain = shownChain(state);
  const length = state.unit;
  const updates: (() => void)[] = [];
  if (!chain) return () => {};
  const { model, base, tip } = chain;
  for (const link of model.links) {
    const T = () => model.link(link).matrixWorld;
    const isEnd = link === base || link === tip;
    if (state.frames || isEnd) updates.push(attach(group, triad(isEnd ? length : length * 0.6), T));
    if (state.names) updates.push(attach(group, label(link, "link"), T));
  }
  return () => updates.forEach((update) => update());
}

/** The axes of all joints, or of the one that the pointer or the focus is on. */
function axisMarks(group: Group, state: Readonly<State>): Follow {
  const length = state.unit;
  const updates: (() => void)[] = [];
  for (const joint of Object.values(state.model?.root.joints ?? {})) {
    const isNamed = joint.name === state.joint;
    const moves = joint.jointType !== "fixed" && joint.jointType !== "floating";
    if (!moves || !(state.axes || isNamed)) continue;
    const direction = joint.axis.clone();
    const axis = new Group();
    axis.add(arrow(direction, length * 1.5, length * (isNamed ? 0.045 : 0.025), colour("axis")));
    axis.add(rod(direction.clone().multiplyScalar(-length * 0.9), new Vector3(), length * 0.015, colour("axis"), 0.6));
    updates.push(attach(group, axis, () => joint.matrixWorld));
  }
  return () => updates.forEach((update) => update());
}

function attach(group: Group, object: Object3D, T: () => Matrix4): Follow {
  group.add(object);
  return () => put(object, T());
}
