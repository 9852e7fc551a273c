/** What is drawn at the tip: the ellipsoids, what is lost, and what the joint under the pointer does to the tip. */

import {
  BufferGeometry,
  type Color,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineLoop,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  TorusGeometry,
  Vector3,
} from "three";

import type { ShownChain } from "../../robot/chain.ts";
import type { Ellipsoid, PartAnswer } from "../../types.ts";
import { subscript } from "../../ui/quantity.ts";
import { colour } from "../../view/colours.ts";
import { arrow, clear, label, rod } from "../../view/shapes.ts";
import type { View } from "../../view/view.ts";

const BALL = new SphereGeometry(1, 48, 32);
const CIRCLE = new BufferGeometry().setFromPoints(
  Array.from({ length: 96 }, (_, k) => new Vector3(Math.cos((k * Math.PI) / 48), Math.sin((k * Math.PI) / 48), 0)),
);
const RING = new TorusGeometry(1, 0.06, 8, 48, (5 / 3) * Math.PI);
const LONGEST = 3; // units of the robot's marks
/** A semi-axis of the force is drawn so many times as long as the shortest at most: near a singularity it has no end. */
export const CUT = 20;

/** Metres in the picture for one unit of velocity, and for one of force. */
export interface Scale {
  velocity: number;
  force: number;
}

/** A twist to draw, linear before angular, in the base's axes. */
export interface Drawn {
  part: PartAnswer | null;
  /** Whether these axes are angular. */
  turns: boolean;
  velocity: boolean;
  force: boolean;
  lost: readonly number[][];
  /** The column of the joint under the pointer. */
  column: number[] | null;
  scale: Scale;
}

/** A scale at which the longest axes come to a length that suits the robot. */
export function fitting(part: PartAnswer | null, unit: number): Scale {
  const length = LONGEST * unit;
  const longest = part?.velocity_ellipsoid.semi_axes[0] || 1;
  const forces = part ? cut(part.force_ellipsoid) : [];
  return { velocity: length / longest, force: length / (Math.max(...forces, 0) || 1) };
}

/** Semi-axes with an end. */
function cut(ellipsoid: Ellipsoid): number[] {
  const bounded = ellipsoid.semi_axes.filter((length): length is number => length !== null);
  const most = CUT * (bounded.length ? Math.min(...bounded) : 1);
  return ellipsoid.semi_axes.map((length) => Math.min(length ?? Infinity, most));
}

export function isCut(ellipsoid: Ellipsoid): boolean {
  return cut(ellipsoid).some((length, i) => length !== ellipsoid.semi_axes[i]);
}

export class TipPicture {
  #group = new Group();

  constructor(private readonly view: View) {
    this.#group.name = "at the tip";
    view.scene.add(this.#group);
  }

  /** Draw all of it anew, at the tip, along the base's axes. */
  show(chain: ShownChain, drawn: Drawn, unit: number): void {
    clear(this.#group);
    this.#group.setRotationFromMatrix(new Matrix4().extractRotation(chain.model.link(chain.base).matrixWorld));
    this.#group.position.setFromMatrixPosition(chain.model.link(chain.tip).matrixWorld);
    const { part, scale } = drawn;
    if (part && drawn.force) this.#force(part, scale.force, unit);
    if (part && drawn.velocity) this.#velocity(part, scale.velocity, unit);
    for (const twist of drawn.lost) this.#lost(twist, unit);
    if (drawn.column) this.#column(drawn.column, drawn.turns, scale.velocity, unit);
    this.view.draw();
  }

  close(): void {
    clear(this.#group);
    this.view.scene.remove(this.#group);
    this.view.draw();
  }

  #velocity({ velocity_ellipsoid: { axes, semi_axes } }: PartAnswer, scale: number, unit: number): void {
    const lengths = semi_axes.map((length) => length! * scale);
    const body = ellipsoid(axes, lengths, colour("accent"), unit);
    body.name = "velocity ellipsoid";
    this.#group.add(body);
    for (const [i, axis] of axes.entries()) {
      if (lengths[i]! < 0.1 * unit) continue;
      const name = label(`σ${subscript(i + 1)}`, "velocity");
      name.position.copy(vector(axis)).multiplyScalar(lengths[i]! + 0.2 * unit);
      this.#group.add(name);
    }
  }

  #force({ force_ellipsoid: found }: PartAnswer, scale: number, unit: number): void {
    const lengths = cut(found).map((length) => length * scale);
    const body = ellipsoid(found.axes, lengths, colour("dimension-a"), unit);
    body.name = "force ellipsoid";
    this.#group.add(body);
  }

  /** A direction that the tip cannot move in: a line where it cannot go, a ring about what it cannot turn about. */
  #lost(twist: number[], unit: number): void {
    const length = 2.2 * unit;
    const [v, w] = [vector(twist), vector(twist.slice(3))];
    const group = new Group();
    group.name = "lost direction";
    for (const sign of [1, -1]) {
      const along = v.clone().multiplyScalar(sign);
      if (v.length() > 0.05) group.add(arrow(along, length * v.length(), 0.05 * unit, colour("bad")));
    }
    if (w.length() > 0.05) group.add(turn(w, 0.8 * length * w.length(), unit, colour("bad")));
    this.#group.add(group);
  }

  #column(column: number[], turns: boolean, scale: number, unit: number): void {
    const direction = vector(turns ? column.slice(3) : column);
    if (direction.length() * scale < 0.02 * unit) return;
    const made = arrow(direction, direction.length() * scale, 0.05 * unit, colour("axis"));
    made.name = "column";
    this.#group.add(made);
  }
}

/** A body with its principal axes and outlines; flat where an axis has no length, or where there is none. */
function ellipsoid(axes: number[][], lengths: number[], tone: Color, unit: number): Group {
  const group = new Group();
  const [x, y, z] = basis(axes);
  const thickness = 1e-4 * unit;
  const [a, b, c] = [lengths[0] ?? 0, lengths[1] ?? 0, lengths[2] ?? 0].map((length) => Math.max(length, thickness));
  const T = new Matrix4().makeBasis(x.clone().setLength(a!), y.clone().setLength(b!), z.clone().setLength(c!));
  const body = new Mesh(
    BALL,
    new MeshBasicMaterial({
      color: tone,
      transparent: true,
      opacity: 0.16,
      depthTest: false,
      depthWrite: false,
      side: DoubleSide,
    }),
  );
  body.renderOrder = 8;
  group.add(fixed(body, T));
  for (const permuted of [T, swapped(x, a!, z, c!, y), swapped(y, b!, z, c!, x)]) {
    const outline = new LineLoop(CIRCLE, new LineBasicMaterial({ color: tone, depthTest: false, transparent: true }));
    outline.renderOrder = 9;
    group.add(fixed(outline, permuted));
  }
  for (const [axis, length] of [
    [x, a!],
    [y, b!],
    [z, c!],
  ] as const) {
    if (length <= thickness) continue;
    const end = axis.clone().setLength(length);
    group.add(rod(end.clone().negate(), end, 0.018 * unit, tone));
  }
  return group;
}

function swapped(first: Vector3, a: number, second: Vector3, b: number, third: Vector3): Matrix4 {
  return new Matrix4().makeBasis(first.clone().setLength(a), second.clone().setLength(b), third);
}

function fixed<T extends Mesh | LineLoop>(object: T, T: Matrix4): T {
  object.matrixAutoUpdate = false;
  object.matrix.copy(T);
  return object;
}

/** The axes, filled up to three that are square to each other. */
function basis(axes: number[][]): [Vector3, Vector3, Vector3] {
  const found = axes.slice(0, 3).map(vector);
  for (const unit of [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)]) {
    if (found.length === 3) break;
    const rest = unit.clone();
    for (const axis of found) rest.addScaledVector(axis, -axis.dot(unit));
    if (rest.length() > 0.5) found.push(rest.normalize());
  }
  return found as [Vector3, Vector3, Vector3];
}

function turn(axis: Vector3, radius: number, unit: number, tone: Color): Group {
  const group = new Group();
  const ring = new Mesh(RING, new MeshBasicMaterial({ color: tone, depthTest: false, transparent: true }));
  ring.renderOrder = 10;
  ring.scale.setScalar(radius * 0.5);
  const end = axis.clone().setLength(radius);
  group.add(ring, rod(end.clone().negate(), end, 0.03 * unit, tone));
  ring.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), axis.clone().normalize());
  return group;
}

function vector(numbers: readonly number[]): Vector3 {
  return new Vector3(numbers[0], numbers[1], numbers[2]);
}
