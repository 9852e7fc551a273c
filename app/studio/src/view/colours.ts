/** Colours of the scene, from the style sheet: one palette for the page and the picture. */

import { Color } from "three";

export type Hue =
  | "view"
  | "grid"
  | "grid-strong"
  | "line"
  | "field-line"
  | "x"
  | "y"
  | "z"
  | "axis"
  | "accent"
  | "ink"
  | "muted"
  | "bad"
  | "dimension-a"
  | "dimension-d"
  | `joint-${number}`;

const probe = document.createElement("span");
probe.hidden = true;
document.documentElement.append(probe);

export function colour(hue: Hue): Color {
  probe.style.color = `var(--${hue})`;
  return new Color(getComputedStyle(probe).color);
}

/** The same for what is drawn on a canvas. */
export function paint(hue: Hue): string {
  return `#${colour(hue).getHexString()}`;
}
