/** Colours of the scene, from the style sheet: one palette for the page and the picture. */

import { Color } from "three";

export type Hue =
  "view" | "grid" | "grid-strong" | "x" | "y" | "z" | "axis" | "accent" | "ink" | "bad" | "dimension-a" | "dimension-d";

const probe = document.createElement("span");
probe.hidden = true;
document.documentElement.append(probe);

export function colour(hue: Hue): Color {
  probe.style.color = `var(--${hue})`;
  return new Color(getComputedStyle(probe).color);
}
