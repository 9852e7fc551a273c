/** What is drawn on the robot: frames, joint axes, link names, the ends of the chain, and the frames of a DH table. */

import { Group, type Matrix4, Vector3 } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import { frames } from "../robot/dh.ts";
import type { RobotModel } from "../robot/model.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { colour } from "./colours.ts";
import { arrow, clear, label, put, rod, stretch, triad } from "./shapes.ts";
import type { View } from "./view.ts";

/** Keep the marks as the state wants them, from now on. */
export function mark(view: View, store: Store<State>): void {
  const onLinks = new Group();
  const ofTable = new Group();
  view.scene.add(onLinks, ofTable);
  let follow: (() => void)[] = [];
  store.watch(["model", "frames", "axes", "names", "base", "tip", "joint", "theme"], (state) => {
    clear(onLinks);
    follow = state.model ? linkMarks(onLinks, view, state.model, state) : [];
    move(follow, view);
  });
  let draw: () => void = () => {};
  store.watch(["model", "table", "dh", "theme"], (state) => {
    clear(ofTable);
    draw = state.dh && state.table && state.model ? tableMarks(ofTable, view, store) : () => {};
    move([draw], view);
  });
  store.watch(["positions"], () => move([...follow, draw], view));
}

function move(follow: (() => void)[], view: View): void {
  for (const update of follow) update();
  view.draw();
}

/** Marks that sit on links; the answer moves them to where the links are. */
function linkMarks(group: Group, view: View, model: RobotModel, state: Readonly<State>): (() => void)[] {
  const length = view.unit;
  const [base, tip] = [state.base ?? model.ends.base_frame, state.tip ?? model.ends.tip_frame];
  const updates: (() => void)[] = [];
  const on = (T: () => Matrix4, object: Group | CSS2DObject) => {
    group.add(object);
    updates.push(() => put(object, T()));
  };
  for (const link of model.links) {
    const T = () => model.link(link).matrixWorld;
    const isEnd = link === base || link === tip;
    if (state.frames || isEnd) on(T, triad(isEnd ? length : length * 0.6));
    if (state.names) on(T, label(link, "link"));
  }
  for (const joint of Object.values(model.root.joints)) {
    const isNamed = joint.name === state.joint;
    const moves = joint.jointType !== "fixed" && joint.jointType !== "floating";
    if (!moves || !(state.axes || isNamed)) continue;
    const direction = joint.axis.clone();
    const axis = new Group();
    axis.add(arrow(direction, length * 1.5, length * (isNamed ? 0.045 : 0.025), colour("accent")));
    axis.add(rod(direction.clone().multiplyScalar(-length * 0.9), new Vector3(), length * 0.015, colour("accent"), 0.6));
    on(() => joint.matrixWorld, axis);
  }
  return updates;
}

/** The frames of a table, `x_i` and `z_i`, with the dimensions `a` and `d` between them. */
function tableMarks(group: Group, view: View, store: Store<State>): () => void {
  const { model, table } = store.value;
  const length = view.unit;
  const thickness = length * 0.028;
  const { dh, base } = table!;
  const places = Array.from({ length: dh.joints.length + 1 }, () => triad(length, ["x", "z"]));
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
      for (const [name, title] of [["a", "aName"], ["d", "dName"]] as const) {
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
    const head = heads.find((other) => other.axis === tip.axis && other.object.position.distanceTo(tip.object.position) < near);
    tip.object.visible = head === undefined;
    if (head) head.object.element.textContent += ` ${text}`;
    else {
      tip.object.element.textContent = text;
      heads.push(tip);
    }
  }
}

function subscript(i: number): string {
  return [...String(i)].map((digit) => "₀₁₂₃₄₅₆₇₈₉"[Number(digit)]).join("");
}
