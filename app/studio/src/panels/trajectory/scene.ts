/** The motion in the picture: the tip's way, the places that it leads through, and where it ends before its time. */

import { Group, Matrix4, Mesh, MeshBasicMaterial, type Object3D, SphereGeometry, Vector3 } from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

import type { ShownChain } from "../../robot/chain.ts";
import { asMatrix, isPose, position } from "../../robot/pose.ts";
import { t } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import { colour, type Hue } from "../../view/colours.ts";
import { clear, label, put, triad } from "../../view/shapes.ts";
import type { View } from "../../view/view.ts";
import type { Failure, Plan } from "./answer.ts";
import { poseAt, posesAt } from "./configurations.ts";
import type { Curve } from "./curve.ts";
import { AXES, type FreeAxis, type Motion, type Place, places, type ToolPath } from "./motion.ts";

const BALL = new SphereGeometry(1, 20, 14);
const POINTS = 300;
/** How many times larger the marks of the open segment are. */
const OPEN = 1.5;
/** How long the lines at the way-points of a tool are, in units of the picture. */
const DASH = 0.25;

/** Where the tip is during a motion, in the chain's base: as many points and one more, [m]. */
export function tipPath(chain: ShownChain, curve: Curve, count = POINTS): number[][] {
  const times = Array.from({ length: count + 1 }, (_, i) => (i * curve.duration) / count);
  return posesAt(
    chain,
    times.map((time) => curve.at(time)),
  ).map(position);
}

export class MotionMarks {
  #group = new Group();
  #places = new Group();
  #way = new Group();

  constructor(private readonly view: View) {
    this.#group.name = "motion";
    this.#group.add(this.#way, this.#places);
    view.scene.add(this.#group);
  }

  /** Everything is drawn in the chain's base, which itself may move with the robot. */
  follow({ model, base }: ShownChain): void {
    put(this.#group, model.link(base).matrixWorld);
    this.view.draw();
  }

  /** The start and the places of each segment; a segment's end has its number. What is open stands out; −1 the start. */
  showPlaces(chain: ShownChain, motion: Motion, plan: Plan | null, unit: number, open: number | null): void {
    erase(this.#places);
    if (motion.path) {
      const planned = plan?.motion.path === motion.path ? plan : null;
      for (const place of wayPoints(motion.path, planned, unit)) this.#places.add(place);
      if (!motion.approach) return this.follow(chain);
    }
    this.#place(chain, motion.start, unit * (open === -1 ? OPEN : 1), t("start"));
    for (const [index, segment] of motion.path ? [] : motion.segments.entries()) {
      const all = places(segment);
      for (const [i, place] of all.entries()) {
        const isEnd = i === all.length - 1 && (segment.type !== "circle" || segment.target !== undefined);
        this.#place(chain, place, unit * (open === index ? OPEN : 1), isEnd ? String(index + 1) : null);
      }
    }
    this.follow(chain);
  }

  /** The way of the tip, in the base, and the place where it could not go on. */
  showWay(points: readonly (readonly number[])[] | null, failure: Failure | null, unit: number): void {
    erase(this.#way);
    if (points) this.#way.add(line(points, "accent"));
    if (failure) {
      const mark = ball(unit * 0.13, "bad");
      const text = label(word(failure.reason), "failure");
      mark.position.fromArray(failure.position);
      text.position.fromArray(failure.position).add(new Vector3(0, 0, unit * 0.45));
      mark.name = "failure";
      this.#way.add(mark, text);
    }
    this.view.draw();
  }

  remove(): void {
    this.showWay(null, null, 0);
    erase(this.#places);
    this.view.scene.remove(this.#group);
    this.view.draw();
  }

  #place(chain: ShownChain, place: Place, unit: number, name: string | null): void {
    const T = isPose(place) ? asMatrix(place) : poseAt(chain, place);
    const mark = new Group();
    mark.add(ball(unit * (name === null ? 0.06 : 0.09), "accent"));
    if (name !== null) {
      const text = label(name, "waypoint");
      text.position.set(0, 0, 0);
      mark.add(triad(unit * 0.5), text);
    }
    put(mark, T);
    this.#places.add(mark);
  }
}

function ball(radius: number, hue: Hue): Mesh {
  const mesh = new Mesh(BALL, new MeshBasicMaterial({ color: colour(hue), depthTest: false, transparent: true }));
  mesh.scale.setScalar(radius);
  mesh.renderOrder = 12;
  return mesh;
}

function line(points: readonly (readonly number[])[], hue: Hue): Line2 {
  const made = new Line2(new LineGeometry().setPositions(points.flat()), stroke(hue));
  made.name = "way of the tip";
  return drawnOver(made);
}

/** The tool at each pose of its path: as it is turned, where a plan says so, and muted where none leads. */
function wayPoints({ poses, free }: ToolPath, plan: Plan | null, unit: number): Object3D[] {
  const turns = plan?.answer.path?.turns ?? [];
  const tools = poses.map((pose, i) => asMatrix(pose).multiply(turned(free[0], turns[i] ?? 0)));
  const reached = plan ? tools.slice(0, turns.length) : tools;
  const numbers = new Set([0, poses.length - 1, Math.min(reached.length, poses.length - 1)]);
  return [
    ...(["x", "y", "z"] as const).map((axis) => dashes(reached, axis, axis, unit)),
    ...(["x", "y", "z"] as const).map((axis) => dashes(tools.slice(reached.length), axis, "muted", unit)),
    ...[...numbers].map((i) => {
      const text = label(String(i), i === reached.length ? "failure" : "waypoint");
      text.position.fromArray(position(tools[i]!));
      return text;
    }),
  ];
}

/** The turn of a tool about its own axis. */
function turned(axis: FreeAxis | undefined, angle: number): Matrix4 {
  const unit = AXES.map((other) => Number(other === axis));
  return axis ? new Matrix4().makeRotationAxis(new Vector3(...unit), angle) : new Matrix4();
}

/** A short line along one axis of each frame. */
function dashes(frames: readonly Matrix4[], axis: "x" | "y" | "z", hue: Hue, unit: number): LineSegments2 {
  const column = 4 * "xyz".indexOf(axis);
  const points = frames.flatMap((T) => {
    const from = position(T);
    return [...from, ...from.map((value, i) => value + DASH * unit * T.elements[column + i]!)];
  });
  const made = new LineSegments2(new LineSegmentsGeometry().setPositions(points), stroke(hue));
  made.name = `way-points ${hue}`;
  return drawnOver(made);
}

function stroke(hue: Hue): LineMaterial {
  return new LineMaterial({ color: colour(hue), linewidth: 2.5, depthTest: false, transparent: true });
}

function drawnOver<T extends LineSegments2>(made: T): T {
  made.renderOrder = 9;
  made.frustumCulled = false;
  return made;
}

/** Remove what is in a group, its lines too. */
function erase(group: Group): void {
  for (const made of group.children) {
    if (!(made instanceof LineSegments2)) continue;
    made.geometry.dispose();
    made.material.dispose();
  }
  clear(group);
}
