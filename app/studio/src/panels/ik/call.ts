/** What is asked of `ik`: the fields of the call, and what is usual where the state does not say. */

import type { ShownChain } from "../../robot/chain.ts";
import { DIRECTIONS, type Direction, type InverseMethod, type InverseOptions, type Pose } from "../../types.ts";

const POSITION: readonly Direction[] = ["x", "y", "z"];
const POSITION_AND_AXIS: readonly Direction[] = [...POSITION, "rx", "ry"];
/** The methods that look for every solution. */
const THOROUGH: ReadonlySet<InverseMethod> = new Set(["auto", "analytic"]);

export interface FullOptions extends InverseOptions {
  method: InverseMethod;
  solutions: "one" | "all";
  task: Direction[];
  respect_limits: boolean;
}

/** The options with everything said: an arm of few joints cannot be asked for every direction. */
export function fullOptions(given: InverseOptions | null, joints: number): FullOptions {
  const method = given?.method ?? "auto";
  const task = given?.task ?? usualTask(joints);
  const isFinite = joints <= task.length;
  return {
    ...given,
    method,
    task,
    respect_limits: given?.respect_limits ?? true,
    solutions: findsAll(method) ? (given?.solutions ?? (isFinite ? "all" : "one")) : "one",
  };
}

export function findsAll(method: InverseMethod): boolean {
  return THOROUGH.has(method);
}

export function usualTask(joints: number): Direction[] {
  return [...(joints >= 6 ? DIRECTIONS : joints === 5 ? POSITION_AND_AXIS : POSITION)];
}

/** The body of a call for one target, started at the configuration on the screen; what the service assumes is left out. */
export function inverseCall(chain: ShownChain, target: Pose, options: FullOptions): Record<string, unknown> {
  const { method, task, respect_limits, ...rest } = options;
  return {
    targets: [target],
    seeds: [chain.configuration],
    ...chain.ends,
    ...(method !== "auto" && { method }),
    ...(task.length < DIRECTIONS.length && { task }),
    ...(!respect_limits && { respect_limits }),
    ...rest,
  };
}
