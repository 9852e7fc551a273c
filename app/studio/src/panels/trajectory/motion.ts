/** A motion as it is built here: the request itself, but for places that are still missing, and whose it is. */

import { type Scene, surroundings } from "../../scene/objects.ts";
import type { ShownChain } from "../../robot/chain.ts";
import { asPose, isPose } from "../../robot/pose.ts";
import { t } from "../../texts/index.ts";
import type { Direction, Pose, TrajectoryRequest } from "../../types.ts";
import { poseAt } from "./configurations.ts";

type SegmentRequest = NonNullable<TrajectoryRequest["segments"]>[number];
export type SegmentType = SegmentRequest["type"];
export type Boundary = NonNullable<Extract<SegmentRequest, { type: "spline" }>["boundary"]>;
export type OrientationLaw = NonNullable<Extract<SegmentRequest, { type: "line" }>["orientation"]>;
export type Law = NonNullable<TrajectoryRequest["law"]>;
export type NearSingularity = NonNullable<TrajectoryRequest["near_singularity"]>;

/** A configuration of the chain, base to tip, or a pose of its tip in its base. */
export type Place = number[] | Pose;

export interface Limits {
  joint_velocity?: Record<string, number>;
  joint_acceleration?: Record<string, number>;
  joint_jerk?: Record<string, number>;
  /** Those of the robot's description, or none. */
  joint_torque?: "effort";
  tip_velocity?: number;
  tip_acceleration?: number;
  tip_angular_velocity?: number;
  tip_angular_acceleration?: number;
}

/** How fast and by which law; of a segment what is left out is the motion's. */
export interface Pace {
  law?: Law;
  duration?: number;
  velocity_scale?: number;
  acceleration_scale?: number;
}

export interface Segment extends Pace {
  type: SegmentType;
  /** Of a circle. */
  via?: Pose;
  /** Of all but a spline; a circle may lack it for a while. */
  target?: Place;
  /** Of a spline: configurations or poses, never both. */
  waypoints?: Place[];
  /** When each of them is passed, after the segment's start, [s]. */
  times?: number[];
  /** Of a line, at most one of the three. */
  blend_radius?: number;
  blend_time?: number;
  blend_acceleration?: number;
  orientation?: OrientationLaw;
  boundary?: Boundary;
  /** Of a spline through configurations: straight lines of the joints with parabolas, beside the inner ones. */
  blends?: boolean;
}

export type ToolPath = NonNullable<TrajectoryRequest["path"]>;
/** Those of the tip about which a tool may turn. */
export const AXES = ["rx", "ry", "rz"] as const satisfies ToolPath["free"];
export type FreeAxis = (typeof AXES)[number];

/** What the tip carries; its centre of mass is at the tip if left out. */
export type Payload = Pick<NonNullable<TrajectoryRequest["payload"]>, "mass" | "center">;

/** How fast the joints are where the motion begins and ends. */
export const RATES = ["start_velocities", "start_accelerations", "end_velocities", "end_accelerations"] as const;
export type Rates = Record<(typeof RATES)[number], number[]>;

export interface Motion extends Pace, Partial<Rates> {
  robot: string;
  base_frame: string;
  tip_frame: string;
  start: number[];
  segments: Segment[];
  limits?: Limits;
  sample_period?: number;
  path_tolerance?: number;
  orientation_tolerance?: number;
  min_singular_value?: number;
  near_singularity?: NearSingularity;
  /** Of a tool, in place of the segments, which wait. */
  path?: ToolPath;
  /** Whether a motion along it begins at the start, else at its first pose. */
  approach?: boolean;
  payload?: Payload;
  /** Whether the motors' torques are told. */
  torques?: boolean;
  /** Directions in which a way of the tip counts; all of them if left out. */
  task?: Direction[];
  /** Whether the time-optimal duration of each way is told beside that of its law. */
  compare_timing?: boolean;
}

export const TYPES: readonly { value: SegmentType; text: string }[] = [
  { value: "joint", text: t("Joints") },
  { value: "line", text: t("Line") },
  { value: "circle", text: t("Circle") },
  { value: "spline", text: t("Spline") },
];

export const LAWS: readonly { value: Law; text: string }[] = [
  { value: "trapezoidal", text: t("Trapezoidal") },
  { value: "cubic", text: t("Cubic") },
  { value: "quintic", text: t("Quintic") },
  { value: "septic", text: t("Septic") },
  { value: "jerk_limited", text: t("Jerk-limited") },
  { value: "time_optimal", text: t("Time-optimal") },
];

/** The law where a motion says none. */
export const USUAL_LAW: Law = "trapezoidal";

/** A motion of the chain on the screen that has a start, where the robot is now, and goes nowhere yet. */
export function fresh(chain: ShownChain): Motion {
  return { robot: chain.model.title, ...chain.ends, start: chain.configuration, segments: [] };
}

/** Whether a motion is one of the chain on the screen. */
export function belongs(motion: Motion | null, chain: ShownChain): motion is Motion {
  return (
    motion !== null &&
    motion.robot === chain.model.title &&
    motion.base_frame === chain.base &&
    motion.tip_frame === chain.tip &&
    motion.start.length === chain.joints.length
  );
}

/** The tip's pose as the API takes it, its orientation as roll, pitch and yaw, which can be typed. */
export function presentPose({ model, base, tip }: ShownChain): Pose {
  return asPose(model.pose(base, tip), "rpy");
}

/** Whether a circle waits for the place that it leads to. */
export function isOpen(segment: Segment | undefined): boolean {
  return segment?.type === "circle" && segment.target === undefined;
}

/** The segments after the present pose was added as one of a type; an open circle and a spline go on instead. */
export function added(segments: readonly Segment[], type: SegmentType, chain: ShownChain): Segment[] {
  const last = segments.at(-1);
  const pose = () => presentPose(chain);
  if (last && type === "circle" && isOpen(last)) return [...segments.slice(0, -1), { ...last, target: pose() }];
  if (last?.waypoints && type === "spline") {
    const waypoint = last.waypoints.some(isPose) ? pose() : chain.configuration;
    return [...segments.slice(0, -1), withWaypoints(last, [...last.waypoints, waypoint])];
  }
  const made: Record<SegmentType, () => Segment> = {
    joint: () => ({ type, target: chain.configuration }),
    line: () => ({ type, target: pose() }),
    circle: () => ({ type, via: pose() }),
    spline: () => ({ type, waypoints: [chain.configuration] }),
  };
  return [...segments, made[type]()];
}

/** A spline through other waypoints; where it has times, a second for each that is new. */
export function withWaypoints(segment: Segment, waypoints: Place[]): Segment {
  const { times } = segment;
  if (!times) return { ...segment, waypoints };
  const more = waypoints.slice(times.length).map((_, i) => (times.at(-1) ?? 0) + i + 1);
  return { ...segment, waypoints, times: [...times, ...more].slice(0, waypoints.length) };
}

/** Where a segment leads through, in order, its end last. */
export function places(segment: Segment): Place[] {
  return [segment.via, ...(segment.waypoints ?? []), segment.target].filter((place) => place !== undefined);
}

/** A segment of another type through the same places, as many of them as it has; what both know stays. */
export function converted(segment: Segment, type: SegmentType, chain: ShownChain): Segment {
  const { law, duration, velocity_scale, acceleration_scale } = segment;
  const pace = defined({ law, duration, velocity_scale, acceleration_scale });
  const all = places(segment);
  const last = all.at(-1)!;
  const pose = (place: Place): Pose => asPoseOf(place, chain);
  switch (type) {
    case "joint":
      return { type, target: last, ...pace };
    case "line":
      return { type, target: pose(last), ...pace };
    case "circle":
      return { type, via: pose(all[0]!), ...(all.length > 1 ? { target: pose(last) } : {}), ...pace };
    case "spline":
      return { type, waypoints: all.some(isPose) ? all.map(pose) : all, ...pace };
  }
}

/** A place as a pose of the tip: where the joints bring it. */
export function asPoseOf(place: Place, chain: ShownChain): Pose {
  return isPose(place) ? place : asPose(poseAt(chain, place), "rpy");
}

/** What keeps a motion from being asked for; null for one that is whole. */
export function missing({ path, segments }: Motion): string | null {
  if (path) return null;
  if (segments.length === 0) return t("Move the arm, then add its pose as the first segment.");
  const open = segments.findIndex(isOpen);
  return open < 0
    ? null
    : t("Segment {open} lacks its target: move the arm, then press “Circle target”.", { open: open + 1 });
}

/** The body of the call, where the scene and the joints off the chain are as given. */
export function request(motion: Motion, scene: Scene, others: ShownChain["others"]): object {
  const { robot: _, approach, ...own } = motion;
  const call = { ...own, ...surroundings(scene, others) };
  if (!call.path) return call;
  const { segments: __, start, ...along } = call;
  return approach ? { ...along, start } : along;
}

/** Without the fields that are undefined or null. */
export function defined<T extends object>(fields: { [K in keyof T]: T[K] | null | undefined }): T {
  return Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== undefined && value !== null)) as T;
}
