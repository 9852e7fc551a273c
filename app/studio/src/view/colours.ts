/** Colours of the scene, from the style sheet: one palette for the page and the picture. */

import { Color } from "three";

export type Hue =
  | "view"
  | "grid"
  | "shadow"
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
  | "dimension-alpha"
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

const JOINT_HUES = 8;

/** The colour of a joint in plots, tables and pictures, by its place in the chain. */
export function jointHue(index: number): `joint-${number}` {
  return `joint-${(index % JOINT_HUES) + 1}`;
}
