/** The chain that every panel speaks of: what a call about the robot on the screen says of it. */

import type { Positions, State } from "../state.ts";
import type { Joint, RobotModel } from "./model.ts";

export interface ShownChain {
  model: RobotModel;
  base: string;
  tip: string;
  /** Base to tip: the order of a configuration. */
  joints: readonly Joint[];
  /** Of the whole robot on the screen. */
  positions: Positions;
  /** The configuration on the screen, one number a joint. */
  configuration: number[];
  /** The fields of a call that name the chain. */
  ends: { base_frame: string; tip_frame: string };
  /** The field of a call that says where joints off the chain stand, such as fingers; none where all are at 0. */
  others: { other_joints?: Record<string, number> };
  /** Where the calls on this robot are; null for a draft, which the service does not keep. */
  path: string | null;
}

/** The chain at this moment; null while there is no robot. */
export function shownChain(state: Readonly<State>): ShownChain | null {
  const { model, positions } = state;
  if (!model) return null;
  const base = state.base ?? model.ends.base_frame;
  const tip = state.tip ?? model.ends.tip_frame;
  const joints = model.chain(base, tip);
  const off = model.joints.filter(({ name }) => positions[name] && !joints.some((joint) => joint.name === name));
  return {
    model,
    base,
    tip,
    joints,
    positions,
    configuration: joints.map((joint) => positions[joint.name] ?? 0),
    ends: { base_frame: base, tip_frame: tip },
    others: off.length ? { other_joints: Object.fromEntries(off.map(({ name }) => [name, positions[name]!])) } : {},
    path: model.name === null ? null : `v1/robots/${encodeURIComponent(model.name)}`,
  };
}
