/** Pieces of a picture, as elements of SVG; classes colour them. */

import type { Point } from "./calculator.ts";

const NS = "http://www.w3.org/2000/svg";
const HEAD = 9;

export function svg(tag: string, attributes: Record<string, string | number>, ...children: (Node | string)[]) {
  const node = document.createElementNS(NS, tag) as SVGElement;
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  node.append(...children);
  return node;
}

export function line(points: readonly Point[], kind: string): SVGElement {
  return svg("polyline", { points: written(points), class: kind });
}

export function polygon(points: readonly Point[], kind: string): SVGElement {
  return svg("polygon", { points: written(points), class: kind });
}

export function dot([x, y]: Point, kind: string, radius = 4): SVGElement {
  return svg("circle", { cx: x, cy: y, r: radius, class: kind });
}

/** What can be dragged: a dot, and around it room for a finger. */
export function handle(at: Point, name: string, kind: string): SVGElement {
  const room = svg("circle", { cx: at[0], cy: at[1], r: 16, class: "reach" });
  return svg("g", { "data-handle": name }, room, dot(at, `${kind} grip`, 6));
}

/** @param anchor which end or the middle of the text is at the point. */
export function label([x, y]: Point, text: string, kind = "", anchor: "start" | "middle" | "end" = "middle") {
  return svg("text", { x, y, class: kind, "text-anchor": anchor }, text);
}

export function arrow(from: Point, to: Point, kind: string): SVGElement[] {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (length < 1) return [];
  const size = Math.min(HEAD, length);
  const [ux, uy] = [(dx / length) * size, (dy / length) * size];
  const corner = (side: number): Point => [to[0] - ux - side * uy * 0.4, to[1] - uy + side * ux * 0.4];
  return [line([from, to], kind), polygon([to, corner(1), corner(-1)], `${kind} head`)];
}

function written(points: readonly Point[]): string {
  return points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");
}
