/** How far configurations are apart. */

import type { ShownChain } from "../../robot/chain.ts";

/** From the posture on the screen to another: the root of the sum of squares, as the service sorts solutions by. */
export function distance(chain: ShownChain, values: readonly number[]): number {
  return Math.hypot(...chain.configuration.map((value, i) => value - values[i]!));
}

/** The unit of such a distance: radians and metres have no common one. */
export function unitOfDistance(chain: ShownChain): string {
  const kinds = new Set(chain.joints.map((joint) => (joint.type === "prismatic" ? "m" : "rad")));
  return [...kinds].join(", ");
}
