/** How far configurations are apart. */

import type { ShownChain } from "../../robot/chain.ts";
import { type Joint, kindOf } from "../../robot/model.ts";
import { t } from "../../texts/index.ts";
import { inUnit, rounded, SI, type Units, unitOf, withUnit } from "../../ui/quantity.ts";

/** From the posture on the screen to another: the root of the sum of squares, as the service sorts solutions by. */
export function distance(chain: ShownChain, values: readonly number[]): number {
  return Math.hypot(...chain.configuration.map((value, i) => value - values[i]!));
}

/** Such a distance in words; lengths and angles have no common unit, so that both together stay in the service's. */
export function distanceText(joints: readonly Joint[], apart: number, units: Units): string {
  const kinds = [...new Set(joints.map(kindOf))];
  const [kind] = kinds;
  if (kind && kinds.length === 1) return withUnit(rounded(inUnit(apart, kind, units)), kind, units);
  return `${rounded(apart)} (${kinds.map((each) => unitOf(each, SI)).join(t(" and "))})`;
}
