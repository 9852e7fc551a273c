/** What of the robot can touch anything: the pieces that contacts are computed of, over its links. */

import {
  BoxGeometry,
  type BufferGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  Group,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";

import { type Api, asProblem, Latest } from "../api.ts";
import { shownChain } from "../robot/chain.ts";
import type { RobotModel } from "../robot/model.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import type { CollisionBodies, CollisionBody } from "../types.ts";
import { colour } from "../view/colours.ts";
import { put } from "../view/shapes.ts";
import type { View } from "../view/view.ts";

/** Larger than the robot by a hair, so that a piece like its link is seen. */
const LARGER = 1.004;

/** Keep the pieces in the picture while they are wanted. */
export function showBodies(view: View, store: Store<State>, api: Api): void {
  const group = new Group();
  group.name = "collision bodies";
  view.scene.add(group);
  const latest = new Latest();
  let shown: { model: RobotModel; pieces: readonly CollisionBody[] } | null = null;
  const place = ({ model }: Readonly<State>) => {
    if (shown?.model === model)
      for (const [i, { link, T_link_body: T }] of shown!.pieces.entries())
        put(group.children[i]!, model!.link(link).matrixWorld.clone().multiply(asTransform(T)));
    view.draw();
  };
  const draw = () => {
    erase(group);
    for (const piece of shown?.pieces ?? []) group.add(solid(piece));
    place(store.value);
  };
  store.watch(["model", "bodies"], ({ model, bodies }) => {
    latest.cancel();
    shown = null;
    draw();
    const path = shownChain(store.value)?.path;
    if (!bodies || !model || !path) return;
    latest
      .run((signal) => api.get<CollisionBodies>(`${path}/collision-bodies`, signal))
      .then((answer) => {
        if (!answer) return;
        shown = { model, pieces: answer.bodies };
        draw();
      })
      .catch((error: unknown) => store.set({ refusal: asProblem(error) }));
  });
  store.watch(["dark"], draw);
  store.watch(["positions"], place);
}

function solid(piece: CollisionBody): Mesh {
  const material = new MeshLambertMaterial({ color: colour("axis"), transparent: true, opacity: 0.45 });
  const mesh = new Mesh(geometry(piece).scale(LARGER, LARGER, LARGER), material);
  mesh.name = piece.name;
  return mesh;
}

function geometry({ kind, size, points }: CollisionBody): BufferGeometry {
  const [x = 0, y = 0, z = 0] = size;
  switch (kind) {
    case "sphere":
      return new SphereGeometry(x, 32, 20);
    case "box":
      return new BoxGeometry(x, y, z);
    case "cylinder":
      return new CylinderGeometry(x, x, y, 32).rotateX(Math.PI / 2);
    case "capsule":
      return new CapsuleGeometry(x, y, 12, 32).rotateX(Math.PI / 2);
    case "convex":
      return new ConvexGeometry(points.map((point) => new Vector3().fromArray(point)));
  }
}

function asTransform(rows: readonly (readonly number[])[]): Matrix4 {
  return new Matrix4().set(...(rows.flat() as Parameters<Matrix4["set"]>));
}

function erase(group: Group): void {
  for (const mesh of group.children as Mesh[]) {
    mesh.geometry.dispose();
    (mesh.material as MeshLambertMaterial).dispose();
  }
  group.clear();
}
