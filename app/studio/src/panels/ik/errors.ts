/** How far a configuration brings the tip from the target, in words. */

import type { Direction, Errors } from "../../types.ts";
import { fixed, scientific } from "../../ui/quantity.ts";

/** Distance and angle, as far as they count. */
export function errors({ position_error, orientation_error }: Errors, task: readonly Direction[]): string {
  const parts: string[] = [];
  if (task.some((direction) => direction.length === 1)) parts.push(`${written(position_error)} m`);
  if (task.some((direction) => direction.length === 2)) parts.push(`${written(orientation_error)} rad`);
  return parts.join(", ");
}

function written(value: number): string {
  return value !== 0 && value < 1e-3 ? scientific(value) : fixed(value, 4);
}
