/** The few shapes that explain a robot: coordinate frames, arrows, lines with a thickness, labels. */

import {
  type Color,
  ConeGeometry,
  CylinderGeometry,
  Group,
  Line,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Points,
  Quaternion,
  Vector3,
} from "three";
import { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import { element } from "../ui/dom.ts";
import { colour } from "./colours.ts";

const ROD = new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0);
const TIP = new ConeGeometry(1, 1, 16).translate(0, 0.5, 0);
const Y = new Vector3(0, 1, 0);
const DIRECTIONS = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };

/** Drawn over the robot, so that a link never hides the frame inside of it. */
export function overlay(tone: Color, opacity = 1): MeshBasicMaterial {
  return new MeshBasicMaterial({ color: tone, depthTest: false, transparent: true, opacity });
}

/** The head of an arrow, to be aimed. */
export function head(tone: Color): Mesh {
  const cone = new Mesh(TIP, overlay(tone));
  cone.renderOrder = 11;
  return cone;
}

/** Have a head end at a point and show in a direction of length 1. */
export function aim(cone: Mesh, at: Vector3, direction: Vector3, length: number): void {
  cone.quaternion.setFromUnitVectors(Y, direction);
  cone.position.copy(at).addScaledVector(direction, -length);
  cone.scale.set(length * 0.3, length, length * 0.3);
}

/** A straight rod between two points. */
export function rod(from: Vector3, to: Vector3, radius: number, tone: Color, opacity = 1): Mesh {
  const mesh = new Mesh(ROD, overlay(tone, opacity));
  stretch(mesh, from, to, radius);
  mesh.renderOrder = 10;
  return mesh;
}

/** Put a rod between two other points. */
export function stretch(mesh: Object3D, from: Vector3, to: Vector3, radius: number): void {
  const along = to.clone().sub(from);
  const length = along.length();
  mesh.visible = length > 1e-9;
  mesh.position.copy(from);
  if (mesh.visible) mesh.quaternion.setFromUnitVectors(Y, along.divideScalar(length));
  mesh.scale.set(radius, length, radius);
}

/** An arrow from the origin along a direction. */
export function arrow(direction: Vector3, length: number, radius: number, tone: Color): Group {
  const group = new Group();
  const pointed = Math.min(length * 0.3, radius * 7);
  const cone = head(tone);
  aim(cone, direction.clone().setLength(length), direction.clone().normalize(), pointed);
  cone.scale.set(radius * 2.6, pointed, radius * 2.6);
  group.add(rod(new Vector3(), direction.clone().setLength(length - pointed), radius, tone), cone);
  return group;
}

/** A coordinate frame: x, y, z as arrows in red, green, blue. */
export function triad(length: number, axes: readonly ("x" | "y" | "z")[] = ["x", "y", "z"]): Group {
  const group = new Group();
  for (const axis of axes) group.add(arrow(DIRECTIONS[axis], length, length * 0.03, colour(axis)));
  return group;
}

export function label(text: string, kind: string): CSS2DObject {
  return new CSS2DObject(element("span", { class: `label ${kind}` }, text));
}

/** Place an object at a transform. */
export function put(object: Object3D, T: Matrix4): void {
  T.decompose(object.position, object.quaternion as Quaternion, new Vector3());
}

/** Remove what is in a group, with what it holds on the graphics card. */
export function clear(group: Object3D): void {
  group.traverse((node) => {
    if (node instanceof CSS2DObject) node.element.remove();
    if (node instanceof Mesh && node.material instanceof MeshBasicMaterial) node.material.dispose();
    if (node instanceof Line || node instanceof Points) (node.material as Material).dispose();
  });
  group.clear();
}
