/** Where things are on the screen, and what moves so that it stays under the pointer. */

import { Raycaster, Vector2, Vector3 } from "three";

import type { View } from "./view.ts";

/** A pointer on the canvas, [px] from its upper left corner. */
export function pointerOf(view: View, { clientX, clientY }: PointerEvent): Vector2 {
  const { left, top } = view.canvas.getBoundingClientRect();
  return new Vector2(clientX - left, clientY - top);
}

/** Where a point of the world is in the picture, [px]. */
export function project(view: View, point: Vector3): Vector2 {
  const { x, y } = point.clone().project(view.camera);
  const { clientWidth: width, clientHeight: height } = view.canvas;
  return new Vector2(((x + 1) / 2) * width, ((1 - y) / 2) * height);
}

/** What looks along the line of sight through a pointer. */
export function sightThrough(view: View, pointer: Vector2): Raycaster {
  const { clientWidth: width, clientHeight: height } = view.canvas;
  const caster = new Raycaster();
  caster.setFromCamera(new Vector2((pointer.x / width) * 2 - 1, 1 - (pointer.y / height) * 2), view.camera);
  return caster;
}

/** How far a pointer is from a line of points, [px]. */
export function distance(view: View, pointer: Vector2, path: readonly Vector3[]): number {
  const points = path.map((point) => project(view, point));
  return Math.min(Infinity, ...points.slice(1).map((end, i) => fromSegment(pointer, points[i]!, end)));
}

function fromSegment(point: Vector2, start: Vector2, end: Vector2): number {
  const along = end.clone().sub(start);
  const share = along.lengthSq() && point.clone().sub(start).dot(along) / along.lengthSq();
  return point.distanceTo(start.addScaledVector(along, Math.max(0, Math.min(1, share))));
}

/** A point that one number moves: along a line, or about an axis. */
export type Motion = (t: number) => Vector3;

export function sliding(point: Vector3, direction: Vector3): Motion {
  return (t) => point.clone().addScaledVector(direction, t);
}

export function turning(point: Vector3, centre: Vector3, axis: Vector3): Motion {
  const arm = point.clone().sub(centre);
  return (t) => arm.clone().applyAxisAngle(axis, t).add(centre);
}

const ROUNDS = 6;
const SMALL = 1e-4;
/** What moves across the screen more slowly than this stays, [px per rad or m]: it is seen end-on. */
const STILL = 12;
/** Most in one round, [rad or m]: beyond, the picture of a turn is far from straight. */
const MOST = 0.5;

/** The number that brings the moved point nearest to the pointer, searched for from one that was near. */
export function follow(view: View, pointer: Vector2, motion: Motion, from: number): number {
  let t = from;
  for (let round = 0; round < ROUNDS; round += 1) {
    const here = project(view, motion(t));
    const rate = project(view, motion(t + SMALL))
      .sub(here)
      .divideScalar(SMALL);
    const error = pointer.clone().sub(here);
    const step = rate.dot(error) / (rate.lengthSq() + STILL * STILL);
    t += Math.max(-MOST, Math.min(MOST, step));
  }
  return t;
}
