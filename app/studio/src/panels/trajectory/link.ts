/** A motion from the address bar, where anybody can have written anything. */

import { isPose } from "../../robot/pose.ts";
import { DIRECTIONS } from "../../types.ts";
import { AXES, type Motion, type Place, RATES, type Segment, type ToolPath, TYPES } from "./motion.ts";

const NUMBERS = ["duration", "velocity_scale", "acceleration_scale"] as const;
const TOLERANCES = ["path_tolerance", "orientation_tolerance", "min_singular_value"] as const;
const OF_THE_WHOLE = [...NUMBERS, ...TOLERANCES, "sample_period"] as const;
const OF_A_SEGMENT = [...NUMBERS, "blend_radius", "blend_time", "blend_acceleration"] as const;

/** The motion, where it is one that the panel can show; whether it can be done the service knows. */
export function asMotion(value: unknown): Motion | null {
  const motion = value as Motion;
  const isMotion =
    isObject(value) &&
    [motion.robot, motion.base_frame, motion.tip_frame].every((name) => typeof name === "string") &&
    areNumbers(motion.start) &&
    Array.isArray(motion.segments) &&
    motion.segments.every((segment) => isSegment(segment, motion.start.length)) &&
    hasNumbers(motion, OF_THE_WHOLE) &&
    RATES.every((rate) => motion[rate] === undefined || areNumbers(motion[rate], motion.start.length)) &&
    (motion.task === undefined || isTask(motion.task)) &&
    isFlag(motion.compare_timing) &&
    isFlag(motion.torques) &&
    isFlag(motion.approach) &&
    (motion.path === undefined || isToolPath(motion.path)) &&
    (motion.payload === undefined || isPayload(motion.payload)) &&
    areLimits(motion.limits);
  return isMotion ? motion : null;
}

function isSegment(value: unknown, joints: number): value is Segment {
  if (!isObject(value) || !hasNumbers(value, OF_A_SEGMENT) || !isFlag(value["blends"])) return false;
  const { type, via, target, waypoints, times } = value as Partial<Segment>;
  const isThere = (place: unknown) => isPlace(place, joints);
  const isTip = (place: unknown) => isThere(place) && !Array.isArray(place);
  switch (TYPES.find((known) => known.value === type)?.value) {
    case "joint":
      return isThere(target);
    case "line":
      return isTip(target);
    case "circle":
      return isTip(via) && (target === undefined || isTip(target));
    case "spline":
      return (
        Array.isArray(waypoints) &&
        waypoints.length > 0 &&
        waypoints.every(isThere) &&
        (times === undefined || areNumbers(times, waypoints.length))
      );
    default:
      return false;
  }
}

function isPlace(value: unknown, joints: number): value is Place {
  return isPose(value) || areNumbers(value, joints);
}

/** Some of the directions, in their order. */
function isTask(value: unknown): boolean {
  if (!Array.isArray(value) || value.length === 0) return false;
  return JSON.stringify(DIRECTIONS.filter((direction) => value.includes(direction))) === JSON.stringify(value);
}

function isToolPath(value: unknown): boolean {
  if (!isObject(value) || !hasNumbers(value, ["steps"])) return false;
  const { poses, free } = value as Partial<ToolPath>;
  return (
    Array.isArray(poses) && poses.every(isPose) && Array.isArray(free) && free.every((axis) => AXES.includes(axis))
  );
}

function isPayload(value: unknown): boolean {
  if (!isObject(value)) return false;
  return isNumber(value["mass"]) && (value["center"] === undefined || areNumbers(value["center"], 3));
}

function isFlag(value: unknown): boolean {
  return value === undefined || typeof value === "boolean";
}

function areLimits(value: unknown): boolean {
  if (value === undefined) return true;
  if (!isObject(value)) return false;
  const { joint_torque, ...others } = value;
  return (
    (joint_torque === undefined || joint_torque === "effort") &&
    Object.values(others).every((limit) => isNumber(limit) || (isObject(limit) && Object.values(limit).every(isNumber)))
  );
}

function hasNumbers(value: object, names: readonly string[]): boolean {
  const fields = value as Record<string, unknown>;
  return names.every((name) => fields[name] === undefined || isNumber(fields[name]));
}

/** @param count how many, where that is known. */
function areNumbers(value: unknown, count?: number): value is number[] {
  return Array.isArray(value) && value.every(isNumber) && (count === undefined || value.length === count);
}

function isNumber(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
