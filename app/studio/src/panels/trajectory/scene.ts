/** The motion in the picture: the tip's way, the places that it leads through, and where it ends before its time. */

import { Group, Mesh, MeshBasicMaterial, SphereGeometry, Vector3 } from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";

import type { ShownChain } from "../../robot/chain.ts";
import { asMatrix, isPose, position } from "../../robot/pose.ts";
import { colour, type Hue } from "../../view/colours.ts";
import { clear, label, put, triad } from "../../view/shapes.ts";
import type { View } from "../../view/view.ts";
import type { Failure } from "./answer.ts";
import { poseAt, posesAt } from "./configurations.ts";
import type { Curve } from "./curve.ts";
import { type Motion, type Place, places } from "./motion.ts";

const BALL = new SphereGeometry(1, 20, 14);
const POINTS = 300;
/** How many times larger the marks of the open segment are. */
const OPEN = 1.5;

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
  showPlaces(chain: ShownChain, motion: Motion, unit: number, open: number | null): void {
    clear(this.#places);
    this.#place(chain, motion.start, unit * (open === -1 ? OPEN : 1), "start");
    for (const [index, segment] of motion.segments.entries()) {
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
    for (const line of this.#way.children as Line2[]) if (line instanceof Line2) disposeLine(line);
    clear(this.#way);
    if (points) this.#way.add(line(points, "accent"));
    if (failure) {
      const mark = ball(unit * 0.13, "bad");
      const text = label(failure.reason.replaceAll("_", " "), "failure");
      mark.position.fromArray(failure.position);
      text.position.fromArray(failure.position).add(new Vector3(0, 0, unit * 0.45));
      mark.name = "failure";
      this.#way.add(mark, text);
    }
    this.view.draw();
  }

  remove(): void {
    this.showWay(null, null, 0);
    clear(this.#places);
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
  const geometry = new LineGeometry().setPositions(points.flat());
  const material = new LineMaterial({ color: colour(hue), linewidth: 2.5, depthTest: false, transparent: true });
  const made = new Line2(geometry, material);
  made.name = "way of the tip";
  made.renderOrder = 9;
  made.frustumCulled = false;
  return made;
}

function disposeLine(made: Line2): void {
  made.geometry.dispose();
  made.material.dispose();
}
