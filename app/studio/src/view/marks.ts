/** What is drawn on the robot: frames, joint axes, link names, the ends of the chain, and the frames of a DH table. */

import { Group, type Matrix4, type Object3D, Vector3 } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import { shownChain } from "../robot/chain.ts";
import { frames } from "../robot/dh.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { subscript } from "../ui/quantity.ts";
import { colour } from "./colours.ts";
import { arrow, clear, label, put, rod, stretch, triad } from "./shapes.ts";
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
  layer(["dh", "table"], (group, { dh, table, model }) => (dh && table && model ? tableMarks(group, store) : () => {}));
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

/** The frames of a table, `x_i` and `z_i`, with the dimensions `a` and `d` between them. */
function tableMarks(group: Group, store: Store<State>): Follow {
  const { model, table, unit: length } = store.value;
  const thickness = length * 0.028;
  const { dh, base } = table!;
  const places = Array.from({ length: dh.joints.length + 1 }, () => triad(length, ["x", "z"]));
  for (const [i, place] of places.entries()) place.name = `DH frame ${i}`;
  const tips = places.flatMap((_, i) => [named("x", i), named("z", i)]);
  group.add(...places, ...tips.map((tip) => tip.object));
  const lines = dh.joints.map((_, i) => ({
    a: rod(new Vector3(), new Vector3(), thickness, colour("dimension-a")),
    d: rod(new Vector3(), new Vector3(), thickness, colour("dimension-d")),
    aName: label(`a${subscript(i + 1)}`, "dimension a"),
    dName: label(`d${subscript(i + 1)}`, "dimension d"),
  }));
  for (const line of lines) group.add(line.a, line.d, line.aName, line.dName);
  return () => {
    put(group, model!.link(base).matrixWorld);
    const found = frames(dh, store.value.positions);
    put(places[0]!, found.first);
    for (const [i, row] of found.rows.entries()) {
      put(places[i + 1]!, row.T);
      const line = lines[i]!;
      for (const [name, title] of [
        ["a", "aName"],
        ["d", "dName"],
      ] as const) {
        stretch(line[name], ...row[name], thickness);
        line[title].visible = line[name].visible;
        line[title].position.copy(row[name][0]).lerp(row[name][1], 0.5);
      }
    }
    const Ts = [found.first, ...found.rows.map((row) => row.T)];
    for (const tip of tips) {
      const along = length * 1.15;
      tip.object.position.set(tip.axis === "x" ? along : 0, 0, tip.axis === "z" ? along : 0).applyMatrix4(Ts[tip.i]!);
    }
    join(tips, length * 0.2);
  };
}

interface AxisName {
  axis: "x" | "z";
  i: number;
  object: CSS2DObject;
}

function named(axis: "x" | "z", i: number): AxisName {
  return { axis, i, object: label("", axis) };
}

/** Axes that point to the same place share a label: `x₂ x₃`. */
function join(tips: readonly AxisName[], near: number): void {
  const heads: AxisName[] = [];
  for (const tip of tips) {
    const text = `${tip.axis}${subscript(tip.i)}`;
    const head = heads.find(
      (other) => other.axis === tip.axis && other.object.position.distanceTo(tip.object.position) < near,
    );
    tip.object.visible = head === undefined;
    if (head) head.object.element.textContent += ` ${text}`;
    else {
      tip.object.element.textContent = text;
      heads.push(tip);
    }
  }
}
