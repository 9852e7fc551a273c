/** The answer of the trajectory call, as far as the panel uses it. */

import type { Law, Motion, SegmentType } from "./motion.ts";

export interface Peak {
  ratio: number | null;
  value: number;
  joint: string | null;
  time: number;
}

export interface Jump {
  value: number;
  joint: string | null;
  time: number;
}

export interface JointLimits {
  joint_velocity: number[];
  joint_acceleration: number[];
  joint_jerk: number[];
}

export interface SegmentAnswer {
  index: number;
  type: SegmentType;
  law: Law;
  start_time: number;
  end_time: number;
  length: number | null;
  angle: number | null;
  blended: boolean;
  limits: JointLimits;
  notes: string[];
  polynomials: Polynomials;
}

/** q(t) = Σ_k coefficients[i][k] (t − breaks[i])ᵏ between breaks[i] and breaks[i + 1]. */
export interface Polynomials {
  breaks: number[];
  coefficients: number[][][];
}

export interface Failure {
  reason: "out_of_reach" | "joint_limit" | "singularity" | "branch_change";
  segment: number;
  time: number;
  position: number[];
  joint: string | null;
  detail: string;
}

export interface Audit {
  passed: boolean;
  velocity: Peak | null;
  acceleration: Peak | null;
  jerk: Peak | null;
  path_deviation: Peak | null;
  orientation_deviation: Peak | null;
  continuity: Record<"position" | "velocity" | "acceleration" | "jerk", Jump | null>;
  min_singular_value: { value: number; time: number } | null;
  limit_margin: { value: number; joint: string; bound: "lower" | "upper"; time: number } | null;
  tip: Record<"speed" | "angular_speed" | "acceleration" | "angular_acceleration", Peak>;
  reasons: { check: string; detail: string; joint: string | null; time: number }[];
}

/** How long a way takes by its law, scaled until a limit is reached, and at least; [s]. */
export interface Timing {
  segments: number[];
  law: Law;
  uniform_duration: number;
  time_optimal_duration: number;
}

export interface TrajectoryAnswer {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  duration: number;
  completed_fraction: number;
  failure: Failure | null;
  segments: SegmentAnswer[];
  audit: Audit;
  limits: JointLimits;
  limit_sources: Record<keyof JointLimits, ("request" | "robot" | "assumed")[]>;
  notes: string[];
  timing: Timing[] | null;
}

/** An answer, and the motion that it is of. */
export interface Plan {
  motion: Motion;
  answer: TrajectoryAnswer;
}
