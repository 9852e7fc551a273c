/** Curves over an axis, with ticks, limits and marks. */

import type { Point } from "./calculator.ts";
import { extent, type Stage } from "./stage.ts";
import { dot, label, line, svg } from "./svg.ts";

const LEFT = 56;
const RIGHT = 16;
const TITLE = 22;
const BELOW = 20;
const TICKS = 4;

export interface Chart {
  /** Above it: what it shows, with the unit. */
  title: string;
  x: readonly number[];
  /** One for each joint or thing, each as long as `x`. */
  curves: readonly (readonly number[])[];
  /** Values that may not be exceeded, on both sides. */
  limits?: readonly number[];
  marks?: readonly { at: Point; text?: string; kind?: string }[];
  /** Along the axis; only below the last of several charts. */
  axis?: string;
}

export interface Scale {
  to(point: Point): Point;
  from(point: Point): Point;
}

/** A chart between two heights of the picture; its scale for what is drawn on it. */
export function chart(stage: Stage, name: string, top: number, height: number, made: Chart) {
  const box = { x: LEFT, y: top + TITLE, width: stage.width - LEFT - RIGHT, height: height - TITLE - BELOW };
  const [x, y] = stage.scale(name, () => [extent(made.x), room(valuesOf(made))] as const);
  const scale = scaleOf(x, y, box);
  const edge = box.x + box.width;
  const nodes = [
    label([box.x, top + 14], made.title, "title", "start"),
    ...ticks(y).flatMap((value) => {
      const [, at] = scale.to([0, value]);
      const kind = value === 0 ? "grid zero" : "grid";
      return [
        line(
          [
            [box.x, at],
            [edge, at],
          ],
          kind,
        ),
        label([box.x - 6, at + 4], short(value), "tick", "end"),
      ];
    }),
    ...ticks(x).map((value) => label([scale.to([value, 0])[0], box.y + box.height + 15], short(value), "tick")),
    ...(made.limits ?? []).flatMap((limit) => [limit, -limit]).flatMap((value) => limitLine(scale, x, y, value)),
    ...made.curves.map((values, i) =>
      line(
        values.map((value, k) => scale.to([made.x[k]!, value])),
        `curve curve-${(i % 6) + 1}`,
      ),
    ),
    ...(made.marks ?? []).flatMap(({ at, text, kind }) => {
      const [px, py] = scale.to(at);
      const end = px > (box.x + edge) / 2 ? "end" : "start";
      const beside = label([px + (end === "end" ? -8 : 8), Math.max(py - 8, box.y + 10)], text ?? "", "value", end);
      return [dot([px, py], `mark ${kind ?? ""}`), ...(text ? [beside] : [])];
    }),
  ];
  if (made.axis) nodes.push(label([edge, top + 14], made.axis, "tick", "end"));
  return { node: svg("g", {}, ...nodes), scale };
}

function limitLine(scale: Scale, x: Point, [low, high]: Point, value: number): SVGElement[] {
  return value < low || value > high ? [] : [line([scale.to([x[0], value]), scale.to([x[1], value])], "limit")];
}

function valuesOf({ curves, limits = [], marks = [] }: Chart): number[] {
  const values = [...curves.flat(), ...marks.map(({ at }) => at[1])];
  const largest = Math.max(...values.map(Math.abs));
  // A limit that is far away would make the curve a line at zero.
  const near = limits.filter((limit) => limit < 3 * largest);
  return [...values, ...near, ...near.map((limit) => -limit)];
}

function scaleOf(x: Point, y: Point, box: { x: number; y: number; width: number; height: number }): Scale {
  const [kx, ky] = [box.width / (x[1] - x[0] || 1), box.height / (y[1] - y[0] || 1)];
  return {
    to: ([u, v]) => [box.x + (u - x[0]) * kx, box.y + (y[1] - v) * ky],
    from: ([u, v]) => [x[0] + (u - box.x) / kx, y[1] - (v - box.y) / ky],
  };
}

/** With zero, and a little air. */
function room(values: readonly number[]): Point {
  const [low, high] = extent([0, ...values.filter(Number.isFinite)]);
  const air = (high - low) * 0.08 || 1;
  return [low < 0 ? low - air : low, high > 0 ? high + air : high];
}

/** About so many round numbers of a range. */
export function ticks([low, high]: Point): number[] {
  const rough = (high - low) / TICKS;
  if (!(rough > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((size) => size * power).find((size) => size >= rough)!;
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) =>
    Number(((first + i) * step).toPrecision(12)),
  );
}

/** A number with so many digits, without zeros at its end. */
export function short(value: number, digits = 6): string {
  const rounded = Number(value.toPrecision(digits));
  const text = rounded !== 0 && (Math.abs(rounded) < 1e-4 || Math.abs(rounded) >= 1e7) ? power(rounded) : `${rounded}`;
  return text.replace("-", "−");
}

function power(value: number): string {
  const [digits, exponent] = value.toExponential().split("e");
  return `${digits}·10${[...exponent!.replace("+", "")].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("")}`;
}
