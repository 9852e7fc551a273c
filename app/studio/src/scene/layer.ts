/** The scene in the picture: its objects, what is in contact, and the line between the nearest points. */

import {
  BoxGeometry,
  BufferGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  type Material,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  PlaneGeometry,
  Points,
  PointsMaterial,
  Quaternion,
  Sphere,
  SphereGeometry,
  Vector3,
} from "three";

import type { Api } from "../api.ts";
import { type MeshSource, meshSource } from "../robot/meshes.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import type { SceneObject } from "../types.ts";
import { column, type Units, UNITS, withUnit } from "../ui/quantity.ts";
import { colour } from "../view/colours.ts";
import { clear, label, put, rod } from "../view/shapes.ts";
import type { View } from "../view/view.ts";
import type { Contacts } from "./contacts.ts";
import { placeOf, type Shape } from "./objects.ts";

const QUARTER = Math.PI / 2;
/** Half the width of what is drawn of a half-space, in units of the picture. */
const WIDE = 20;
/** Points that the two of a pair have in common, [m]. */
const NEAR = 1e-6;

/** Keep the scene in the picture as the state has it, from now on. */
export function showScene(view: View, store: Store<State>, api: Api): void {
  const meshes = new Map<string, MeshSource>();
  const [objects, touching] = [new Group(), new Group()];
  objects.name = "scene";
  touching.name = "contacts";
  view.scene.add(objects, touching);
  store.watch(["scene", "contacts", "unit", "dark", "chosen", "model", ...UNITS], (state) => {
    dispose(objects);
    for (const object of state.scene.objects) objects.add(drawn(object, state, fetched(state.scene.origin)));
    place(objects, state);
    dispose(touching);
    for (const mark of state.contacts ? marks(state.contacts, state) : []) touching.add(mark);
    view.draw();
  });
  store.watch(["positions"], (state) => {
    place(objects, state);
    view.draw();
  });
  /** The files of a stored scene, each fetched once; one that cannot be read stays a name. */
  function fetched(scene: string | null): (file: string, into: Group, tone: Material) => void {
    if (scene === null) return () => {};
    const path = `v1/scenes/${encodeURIComponent(scene)}/files`;
    const made = () =>
      meshSource((file) => api.url(`${path}/${encodeURIComponent(file)}`), { headers: api.key.headers });
    const source = meshes.get(scene) ?? made();
    meshes.set(scene, source);
    return (file, into, tone) => {
      const show = (mesh: Object3D) => {
        mesh.traverse((node) => {
          if (!(node instanceof Mesh)) return;
          node.material = tone;
          node.userData["isShared"] = true;
        });
        into.add(mesh);
        view.draw();
      };
      source(file, tone).then(show, () => {});
    };
  }

  store.watch(["scene"], ({ scene }) => view.surround("scene", extent(scene.objects)));
}

/** An object, red while it is in contact. */
function drawn(
  object: SceneObject,
  state: Readonly<State>,
  fetch: (file: string, into: Group, tone: Material) => void,
): Object3D {
  const { shape } = object;
  const isTouched =
    state.contacts?.inCollision && state.contacts.pairs.some(({ a, b }) => [a, b].includes(object.name));
  const tone = colour(isTouched ? "bad" : object.name === state.chosen ? "accent" : "muted");
  const made = new Group();
  made.name = object.name;
  if (shape.type === "points") {
    const positions = new Float32BufferAttribute((shape.points ?? []).flat(), 3);
    const geometry = new BufferGeometry().setAttribute("position", positions);
    made.add(new Points(geometry, new PointsMaterial({ color: tone, size: 2 * shape.radius })));
  } else if (shape.type === "mesh") {
    made.add(label(object.name, "link"));
    fetch(shape.file, made, new MeshLambertMaterial({ color: tone, side: DoubleSide, flatShading: true }));
  } else {
    const isWide = shape.type === "half_space";
    const opacity = isWide ? 0.25 : isTouched ? 0.8 : 0.65;
    const material = new MeshLambertMaterial({ color: tone, transparent: true, opacity, side: DoubleSide });
    material.depthWrite = !isWide;
    const solid = new Mesh(geometry(shape, state.unit), material);
    if (isWide) {
      const normal = new Vector3().fromArray(shape.normal);
      solid.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal.clone().normalize()));
      solid.position.copy(normal.setLength(shape.offset ?? 0));
    }
    made.add(solid);
  }
  return made;
}

function geometry(shape: Exclude<Shape, { type: "points" | "mesh" }>, unit: number): BufferGeometry {
  switch (shape.type) {
    case "box":
      return new BoxGeometry(...(shape.size as [number, number, number]));
    case "sphere":
      return new SphereGeometry(shape.radius, 32, 20);
    case "cylinder":
      return new CylinderGeometry(shape.radius, shape.radius, shape.length, 32).rotateX(QUARTER);
    case "capsule":
      return new CapsuleGeometry(shape.radius, shape.length, 12, 32).rotateX(QUARTER);
    case "half_space":
      return new PlaneGeometry(2 * WIDE * unit, 2 * WIDE * unit);
    case "height_map":
      return terrain(shape.heights, shape.size as [number, number]);
  }
}

/** The surface of a height map, whose first row has the least y. */
function terrain(heights: readonly (readonly number[])[], size: [number, number]): BufferGeometry {
  const made = new PlaneGeometry(...size, heights[0]!.length - 1, heights.length - 1);
  const positions = made.getAttribute("position");
  // The plane begins at the largest y.
  for (const [k, height] of heights.toReversed().flat().entries()) positions.setZ(k, height);
  made.computeVertexNormals();
  return made;
}

/** Put each object to its place, or to that of the frame it hangs on. */
function place(group: Group, { scene, model }: Readonly<State>): void {
  for (const [i, object] of scene.objects.entries()) {
    const frame = object.attached_to;
    const T = model?.has(frame ?? null) ? model.link(frame!).matrixWorld.clone() : new Matrix4();
    put(group.children[i]!, T.multiply(placeOf(object)));
  }
}

/** To a tenth of a millimetre below a centimetre. */
function distanceText(distance: number, units: Units): string {
  return withUnit(column(distance, "length", units, Math.abs(distance) < 0.01 ? 4 : 3), "length", units);
}

/** The links in contact in red, and a line between the two points of each pair, with its length. */
function marks({ pairs, inCollision }: Contacts, state: Readonly<State>): Object3D[] {
  const { unit, model } = state;
  const found: Object3D[] = [];
  const tone = colour(inCollision ? "bad" : "accent");
  for (const { distance, point_a, point_b } of pairs.slice(0, 8)) {
    const [from, to] = [new Vector3().fromArray(point_a), new Vector3().fromArray(point_b)];
    const line = rod(from, to, unit * 0.03, tone);
    line.name = "nearest points";
    const length = label(distanceText(distance, state), "distance");
    length.position.copy(from).lerp(to, 0.5);
    found.push(line, length);
    for (const end of from.distanceTo(to) < NEAR ? [from] : [from, to]) {
      const ball = new Mesh(new SphereGeometry(unit * 0.06, 16, 10), line.material);
      ball.position.copy(end);
      ball.renderOrder = 12;
      found.push(ball);
    }
  }
  if (!inCollision || !model) return found;
  const links = new Set(pairs.flatMap(({ a, b }) => [a, b]).filter((name) => model.has(name)));
  const red = new MeshLambertMaterial({ color: colour("bad"), transparent: true, opacity: 0.75 });
  Object.assign(red, { polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
  for (const link of links) found.push(...model.parts(link).map((part) => copyOf(part, red)));
  return found;
}

function copyOf(part: Mesh, material: MeshLambertMaterial): Mesh {
  const copy = new Mesh(part.geometry, material);
  copy.name = "in contact";
  copy.matrixAutoUpdate = false;
  copy.matrix.copy(part.matrixWorld);
  copy.userData["isShared"] = true;
  return copy;
}

/** What the objects at rest take up; a half-space has no end. */
function extent(objects: readonly SceneObject[]): Sphere | null {
  const found = new Sphere().makeEmpty();
  for (const object of objects) {
    if (object.attached_to || object.shape.type === "half_space" || object.shape.type === "mesh") continue;
    if (object.shape.type === "points") continue;
    const own = geometry(object.shape, 0);
    own.computeBoundingSphere();
    found.union(own.boundingSphere!.applyMatrix4(placeOf(object)));
    own.dispose();
  }
  return found.isEmpty() ? null : found;
}

/** Remove what is in a group, with its geometry where that is its own. */
function dispose(group: Group): void {
  group.traverse((node) => {
    if (!(node instanceof Mesh || node instanceof Points) || node.userData["isShared"]) return;
    if (node.name !== "nearest points") (node.geometry as BufferGeometry).dispose();
    if (node.material instanceof MeshLambertMaterial) node.material.dispose();
  });
  clear(group);
}
