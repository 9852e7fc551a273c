/** The course's methods step by step: what they are called, what becomes of them, and the errors on their way. */

import { type ShownChain } from "../../robot/chain.ts";
import { asMatrix } from "../../robot/pose.ts";
import type { State } from "../../state.ts";
import { t } from "../../texts/index.ts";
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
  newton: t("Newton"),
  gradient: t("Gradient"),
  gradient_then_newton: t("Gradient, then Newton"),
};
const ENDS: Record<string, (count: string) => string> = {
  converged: (count) => t("converged after {count}", { count }),
  stagnated: (count) => t("stagnated after {count}: no joint can make the error smaller", { count }),
  near_singular: (count) => t("stopped near a singularity after {count}", { count }),
  at_limits: (count) => t("stopped at the limits of the joints after {count}", { count }),
  diverged: (count) => t("diverged after {count}", { count }),
  time_limit: (count) => t("ran out of time after {count}", { count }),
  iterations: (count) => t("not there after {count}", { count }),
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
  const count =
    steps.length === 2 ? t("1 iteration") : t("{length} iterations", { length: Math.max(steps.length - 1, 0) });
  const end = ENDS[stop_reason ?? ""]?.(count) ?? t("ended after {count}", { count });
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
