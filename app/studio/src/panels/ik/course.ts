/** The course's methods step by step: what they are called, what becomes of them, and the errors on their way. */

import { type ShownChain } from "../../robot/chain.ts";
import { asMatrix } from "../../robot/pose.ts";
import type { State } from "../../state.ts";
import type { Direction, Errors, InverseAnswer, InverseMethod, Iteration, Pose } from "../../types.ts";
import type { Hue } from "../../view/colours.ts";
import { errorsOf } from "./errors.ts";
import { moved } from "./solver.ts";

export type CourseMethod = Extract<InverseMethod, "newton" | "gradient" | "gradient_then_newton">;

/** The way of one method from its start. */
export interface Way {
  method: CourseMethod;
  hue: Hue;
  joints: readonly string[];
  steps: readonly (Iteration & Errors)[];
  /** What became of it, in words. */
  end: string;
}

export const TITLES: Record<CourseMethod, string> = {
  newton: "Newton",
  gradient: "Gradient",
  gradient_then_newton: "Gradient, then Newton",
};
const ENDS: Record<string, (count: string) => string> = {
  converged: (count) => `converged after ${count}`,
  stagnated: (count) => `stagnated after ${count}: no joint can make the error smaller`,
  near_singular: (count) => `stopped near a singularity after ${count}`,
  at_limits: (count) => `stopped at the limits of the joints after ${count}`,
  diverged: (count) => `diverged after ${count}`,
  time_limit: (count) => `ran out of time after ${count}`,
  iterations: (count) => `not there after ${count}`,
};

export function wayOf(
  answer: InverseAnswer,
  method: CourseMethod,
  chain: ShownChain,
  state: Readonly<State>,
  target: Pose,
): Way {
  const { trace, stop_reason } = answer.results[0]!;
  const steps = withErrors(trace ?? [], answer, chain, state, target);
  const count = steps.length === 2 ? "1 iteration" : `${Math.max(steps.length - 1, 0)} iterations`;
  const end = ENDS[stop_reason ?? ""]?.(count) ?? `ended after ${count}`;
  return { method, hue: method === "newton" ? "accent" : "dimension-a", joints: answer.joint_names, steps, end };
}

/** The step of a way that a scrubber is at: its last one where it has come to its end before. */
export function stepAt(way: Way, index: number): Way["steps"][number] {
  return way.steps[Math.min(index, way.steps.length - 1)]!;
}

/** Each iterate's distance and angle, which the service mixes, by the browser's own forward kinematics. */
function withErrors(
  trace: readonly Iteration[],
  { joint_names, task }: { joint_names: readonly string[]; task: readonly Direction[] },
  { model, base, tip }: ShownChain,
  state: Readonly<State>,
  target: Pose,
): Way["steps"] {
  const T_base_target = asMatrix(target);
  const steps = trace.map((iteration) => {
    model.place(moved(state, joint_names, iteration.joint_positions));
    return { ...iteration, ...errorsOf(task, T_base_target, model.pose(base, tip)) };
  });
  model.place(state.positions);
  return steps;
}
