/** A textbook arm, drawn as the book draws its table: slim, with edges, each link in the colour of its joint. */

import {
  EdgesGeometry,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshLambertMaterial,
  Vector3,
} from "three";

import { shownChain } from "../robot/chain.ts";
import type { RobotModel } from "../robot/model.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import { colour, jointHue } from "./colours.ts";
import type { View } from "./view.ts";

/** Kinds of robots that the service draws as arms that are built, with a pedestal and housings; they stay as they are. */
const BUILT = new Set([t("collaborative arm"), t("industrial arm")]);
/** Radii, of those of the bodies that the service makes for a table. */
const SLIM = 0.38;
/** Length of a revolute joint's body, in its radii, as the service makes it. */
const HUB = 5 / 2.2;
/** Factors of a prismatic joint's box, across and along its axis: a revolute joint's body in it sticks out at both ends. */
const COLLAR = new Vector3(1.25, 1.25, 0.6);
/** Edges are drawn where two faces meet at more, [°]: not along the side of a cylinder. */
const SHARP = 40;
/** Shares of the ground in a link's colour, and of the ink in its edges'. */
const PALE = 0.1;
const DEEP = 0.65;

/** Keep the arm on the screen like that; one with shapes of its own stays as it is. */
export function drawFigures(view: View, store: Store<State>): void {
  store.watch(["model", "draft", "dark", "base", "tip"], (state) => {
    const { model, draft } = state;
    if (!model || !(model.info ? model.info.dh : draft) || BUILT.has(model.info?.kind ?? "")) return;
    const order = shownChain(state)!.joints.map(({ name }) => name);
    slim(model);
    for (const [joint, parts] of model.drawnBy()) tint(parts, joint === null ? -1 : order.indexOf(joint));
    view.draw();
  });
}

const SLIMMED = new WeakSet<RobotModel>();

/** Thinner rods, and smaller bodies of joints, about where they are. */
function slim(model: RobotModel): void {
  if (SLIMMED.has(model)) return;
  SLIMMED.add(model);
  for (const mesh of [...model.drawnBy().values()].flat()) {
    const { x: radius, y: length } = mesh.scale;
    const isRod = mesh.geometry.type === "CylinderGeometry" && Math.abs(length / radius - HUB) > 1e-3;
    mesh.scale.multiplyScalar(SLIM);
    if (isRod) mesh.scale.y = length;
    if (mesh.geometry.type === "BoxGeometry") mesh.scale.multiply(COLLAR);
    const edges = new LineSegments(new EdgesGeometry(mesh.geometry, SHARP), new LineBasicMaterial());
    edges.raycast = () => {}; // the faces are hit
    mesh.add(edges);
    mesh.updateMatrixWorld(true);
  }
}

/** Colour what a joint moves; −1 for what none of the chain moves. */
function tint(parts: readonly Mesh[], joint: number): void {
  const pure = joint < 0 ? colour("muted") : colour(jointHue(joint));
  const face = new MeshLambertMaterial({ color: pure.clone().lerp(colour("view"), PALE) });
  for (const mesh of parts) {
    for (const old of [mesh.material].flat()) old.dispose();
    mesh.material = face;
    for (const edges of mesh.children as LineSegments<EdgesGeometry, Material>[])
      if (edges.material instanceof LineBasicMaterial) edges.material.color = pure.clone().lerp(colour("ink"), DEEP);
  }
}
