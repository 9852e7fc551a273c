/** A robot on the screen: the scene that urdf-loader makes of its URDF, its joints, and its own forward kinematics. */

import { type Matrix4, Mesh, type Object3D, type Vector3 } from "three";
import { URDFJoint, type URDFRobot } from "urdf-loader/src/URDFClasses.js";

import type { Positions } from "../state.ts";
import { t } from "../texts/index.ts";
import type { Kind } from "../ui/quantity.ts";
import type { ChainEnds, JointInfo, RobotInfo } from "../types.ts";

/** A joint with a position of its own. */
export interface Joint {
  name: string;
  type: "revolute" | "continuous" | "prismatic";
  /** Null where there is no limit. */
  lower: number | null;
  upper: number | null;
}

/** What its position measures. */
export function kindOf({ type }: Pick<Joint, "type">): Kind {
  return type === "prismatic" ? "length" : "angle";
}

/** A joint that moves: as its leader does, which may be itself. */
export interface Drive {
  joint: URDFJoint;
  leader: string;
  multiplier: number;
  offset: number;
}

/** How far from parallel, or from a right angle, axes of a planar arm may be, as cosines. */
const PARALLEL = 1e-6;
const MOVABLE = new Set(["revolute", "continuous", "prismatic"]);

export class RobotModel {
  /** In the order of the description. */
  readonly joints: readonly Joint[];
  readonly links: readonly string[];
  /** How many mesh files the description shows, and how many of them are on the screen. */
  readonly meshes = { wanted: 0, shown: 0, failed: [] as string[] };
  /** What is shown until they all are. */
  standIns: Mesh[] = [];
  #drives: Drive[];
  #leaders = new Map<string, string>();

  /**
   * @param name of the robot at the service; null for a draft that it does not keep.
   * @param info what the service says about it; null for a draft.
   */
  constructor(
    readonly name: string | null,
    readonly root: URDFRobot,
    readonly urdf: string,
    readonly ends: ChainEnds,
    readonly info: RobotInfo | null,
  ) {
    const all = info?.joints ?? Object.values(root.joints).map(jointInfo);
    this.links = info?.links ?? Object.keys(root.links);
    this.joints = all.filter((joint) => MOVABLE.has(joint.type) && !joint.mimic).map(ownJoint);
    const byName = new Map(all.map((joint) => [joint.name, joint]));
    this.#drives = all.filter((joint) => MOVABLE.has(joint.type)).map((joint) => drive(root, joint, byName));
    for (const { joint, leader } of this.#drives) this.#leaders.set(joint.name, leader);
  }

  get title(): string {
    return this.name ?? t("Unsaved table");
  }

  /** Whether all of its meshes that can be had are on the screen. */
  get isComplete(): boolean {
    const { wanted, shown, failed } = this.meshes;
    return shown + failed.length >= wanted;
  }

  /** Move the scene to a configuration. */
  place(positions: Positions): void {
    for (const { joint, leader, multiplier, offset } of this.#drives) {
      URDFJoint.prototype.setJointValue.call(joint, multiplier * (positions[leader] ?? 0) + offset);
    }
    this.root.updateMatrixWorld(true);
  }

  link(name: string): Object3D {
    const link = this.root.links[name];
    if (!link) throw new Error(`the description has no link ${name}`);
    return link;
  }

  has(link: string | null): link is string {
    return link !== null && link in this.root.links;
  }

  /** T_base_tip at the configuration that the scene is in. */
  pose(base: string, tip: string): Matrix4 {
    return this.link(base).matrixWorld.clone().invert().multiply(this.link(tip).matrixWorld);
  }

  /** The normal of the plane that everything moves in, in the world; null where there is none. */
  normal(): Vector3 | null {
    const axes = this.#drives.map(({ joint }) => ({
      turns: joint.jointType !== "prismatic",
      axis: joint.axis.clone().transformDirection(joint.matrixWorld),
    }));
    const normal = axes.find(({ turns }) => turns)?.axis;
    if (!normal || axes.length < 2) return null;
    const isAcross = axes.every(({ turns, axis }) => Math.abs(Math.abs(axis.dot(normal)) - Number(turns)) < PARALLEL);
    return isAcross ? normal.clone() : null;
  }

  /** What is drawn of one link. */
  parts(name: string): Mesh[] {
    const found: Mesh[] = [];
    const waiting: Object3D[] = [this.link(name)];
    for (let node = waiting.pop(); node; node = waiting.pop()) {
      if (node instanceof Mesh) found.push(node);
      waiting.push(...node.children.filter((child) => !(child instanceof URDFJoint)));
    }
    return found;
  }

  /** What is drawn of the links that move with these joints. */
  moving(joints: readonly Joint[]): Mesh[] {
    const names = new Set(joints.map((joint) => joint.name));
    const found = new Set<Mesh>();
    for (const { joint, leader } of this.#drives) {
      if (names.has(leader)) joint.traverse((node) => node instanceof Mesh && found.add(node));
    }
    return [...found];
  }

  /** What is drawn, by the joint that moves it last, or the one that this joint mimics; null has what none moves. */
  drawnBy(): Map<string | null, Mesh[]> {
    const found = new Map<string | null, Mesh[]>();
    this.root.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const leader = this.drive(node)?.leader ?? null;
      found.set(leader, [...(found.get(leader) ?? []), node]);
    });
    return found;
  }

  /** The joint that moves a thing last; null for none. */
  drive(thing: Object3D): Drive | null {
    const joint = this.#above(thing).find(({ name }) => this.#leaders.has(name));
    return this.#drives.find((drive) => drive.joint === joint) ?? null;
  }

  /** The joints that a configuration of a chain lists, base to tip: those that move, a leader for what mimics it. */
  chain(base: string, tip: string): Joint[] {
    const up = this.#above(this.link(base));
    const down = this.#above(this.link(tip));
    while (up.length && down.length && up.at(-1) === down.at(-1)) {
      up.pop();
      down.pop();
    }
    const names = [...up, ...down.reverse()].map((joint) => this.#leaders.get(joint.name));
    const unique = [...new Set(names)];
    return unique.flatMap((name) => this.joints.find((joint) => joint.name === name) ?? []);
  }

  /** The chain's joints in the middle of their ranges, the others as near to zero as their limits allow. */
  home(base: string, tip: string): Positions {
    const middle = new Set(this.chain(base, tip).map((joint) => joint.name));
    return this.#each((joint) => {
      if (joint.lower === null || joint.upper === null) return 0;
      return middle.has(joint.name) ? (joint.lower + joint.upper) / 2 : within(0, joint);
    });
  }

  zero(): Positions {
    return this.#each(() => 0);
  }

  /** Within the limits, for the joints of a chain; the others as they are. */
  random(base: string, tip: string, others: Positions): Positions {
    const moved = this.chain(base, tip).map((joint) => {
      const { lower, upper } = range(joint);
      return [joint.name, lower + Math.random() * (upper - lower)];
    });
    return { ...others, ...Object.fromEntries(moved) };
  }

  /** One value for each joint: a given one where it is a number of this robot or of its chain alone, else home. */
  complete(given: Positions | readonly number[] | null, base: string, tip: string): Positions {
    const home = this.home(base, tip);
    if (given && !Array.isArray(given))
      return this.#each((joint) => (given as Positions)[joint.name] ?? home[joint.name]!);
    const numbers = given as readonly number[] | null;
    const named = (joints: readonly Joint[]) =>
      Object.fromEntries(joints.map((joint, index) => [joint.name, numbers![index]!]));
    if (numbers?.length === this.joints.length) return named(this.joints);
    const chain = this.chain(base, tip);
    return numbers?.length === chain.length ? { ...home, ...named(chain) } : home;
  }

  #each(value: (joint: Joint) => number): Positions {
    return Object.fromEntries(this.joints.map((joint) => [joint.name, value(joint)]));
  }

  /** The joints between a thing and the root, from the thing up. */
  #above(thing: Object3D): URDFJoint[] {
    const found: URDFJoint[] = [];
    for (let node: Object3D | null = thing; node; node = node.parent) {
      if (node instanceof URDFJoint) found.push(node);
    }
    return found;
  }
}

/** Where a slider ends: the limits, and ±π or ±1 m where there are none. */
export function range(joint: Joint): { lower: number; upper: number } {
  const reach = joint.type === "prismatic" ? 1 : Math.PI;
  return { lower: joint.lower ?? -reach, upper: joint.upper ?? reach };
}

export function isBeyond(joint: Joint, value: number): boolean {
  return (joint.lower !== null && value < joint.lower) || (joint.upper !== null && value > joint.upper);
}

/** The position that a joint can have, nearest to a value. */
export function within(value: number, joint: Joint): number {
  return Math.max(joint.lower ?? -Infinity, Math.min(joint.upper ?? Infinity, value));
}

function ownJoint(joint: JointInfo): Joint {
  const bounded = joint.type !== "continuous";
  return {
    name: joint.name,
    type: joint.type as Joint["type"],
    lower: bounded ? joint.limits.lower : null,
    upper: bounded ? joint.limits.upper : null,
  };
}

/** Follow a mimic joint to the joint that moves by itself. */
function drive(root: URDFRobot, info: JointInfo, byName: Map<string, JointInfo>): Drive {
  const joint = root.joints[info.name]!;
  joint.ignoreLimits = true;
  joint.mimicJoints = [];
  let [leader, multiplier, offset] = [info, 1, 0];
  for (let steps = 0; leader.mimic && steps < byName.size; steps += 1) {
    offset += multiplier * leader.mimic.offset;
    multiplier *= leader.mimic.multiplier;
    leader = byName.get(leader.mimic.joint)!;
  }
  return { joint, leader: leader.name, multiplier, offset };
}

/** What urdf-loader has read of a joint, for a draft. */
function jointInfo(joint: URDFJoint): JointInfo {
  const { lower, upper, velocity, effort } = joint.limit;
  const mimic =
    "mimicJoint" in joint ? (joint as unknown as { mimicJoint: string; multiplier: number; offset: number }) : null;
  return {
    name: joint.name,
    type: joint.jointType,
    parent: "",
    child: "",
    limits: { lower, upper, velocity, effort },
    mimic: mimic && { joint: mimic.mimicJoint, multiplier: mimic.multiplier, offset: mimic.offset },
  };
}
