/** Names for parts of the trajectory call's answer. */

import type { ShownChain } from "../../robot/chain.ts";
import type { Scene } from "../../scene/objects.ts";
import type { TrajectoryAnswer } from "../../types.ts";
import type { Motion } from "./motion.ts";

export type Audit = TrajectoryAnswer["audit"];
export type Peak = Audit["tip"]["speed"];
export type Failure = NonNullable<TrajectoryAnswer["failure"]>;
export type JointLimits = Pick<TrajectoryAnswer["limits"], "joint_velocity" | "joint_acceleration" | "joint_jerk">;

/** An answer, and the motion that it is of, in its scene. */
export interface Plan {
  motion: Motion;
  scene: Scene;
  /** Where joints off the chain stand. */
  others: ShownChain["others"];
  answer: TrajectoryAnswer;
}
