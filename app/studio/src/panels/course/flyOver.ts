/** Fly-over: a corner passed without a stop; its three points can be dragged. */

import { t } from "../../texts/index.ts";
import type { FlyOverAnswer, FlyOverRequest } from "../../types.ts";
import { type Calculator, type Field, type Inputs, number, type Picture, type Point, valueAt } from "./calculator.ts";
import { short } from "./chart.ts";
import { Plane, type Stage } from "./stage.ts";
import { arrow, dot, handle, label, line } from "./svg.ts";

const HEIGHT = 420;
const MARGIN = 44;
/** Between the corner and an end of the blend, for their names, [px]. */
const ROOM = 80;

const GIVEN = [
  { value: "blend_time", text: t("Blend time ΔT"), unit: "s" },
  { value: "distance_before", text: t("Distance d₁"), unit: "m" },
  { value: "distance_after", text: t("Distance d₂"), unit: "m" },
  { value: "radius", text: t("Radius"), unit: "m" },
  { value: "max_acceleration", text: t("Acceleration"), unit: "m/s²" },
] as const;

const POINTS = ["start", "corner", "end"] as const;

export const flyOver: Calculator<FlyOverRequest, FlyOverAnswer> = {
  id: "fly-over",
  title: t("Fly-over"),
  says: t("A corner passed without a stop, on a parabola of constant acceleration. Drag A, B and C."),
  path: "v1/course/fly-over",
  page: "course/trajectories.html#rounding-a-corner",
  examples: [
    {
      title: t("Lecture"),
      inputs: { start: [3, 3], corner: [1, 9], end: [8, 9], speed_before: 1, speed_after: 2, blend_time: 4 },
    },
    {
      title: t("By acceleration"),
      inputs: { start: [3, 3], corner: [1, 9], end: [8, 9], speed_before: 1, speed_after: 2, max_acceleration: 0.5 },
    },
    {
      title: t("In space, from rest to rest"),
      inputs: {
        start: [0, 0, 0],
        corner: [1, 0, 0],
        end: [1, 1, 0.5],
        speed_before: 0.5,
        speed_after: 0.5,
        max_acceleration: 1,
        rest_acceleration: 1,
      },
    },
  ],
  fields: (inputs) => {
    const given = GIVEN.find(({ value }) => inputs[value] != null) ?? GIVEN[0];
    return [
      ...POINTS.map((pointer, i): Field => {
        return { pointer, label: t("Point {value}", { value: "ABC"[i] }), unit: "m", kind: "list" };
      }),
      number("speed_before", t("Speed v₁ along AB"), "m/s"),
      number("speed_after", t("Speed v₂ along BC"), "m/s"),
      {
        pointer: "given",
        label: t("What is given"),
        kind: "choice",
        options: GIVEN,
        chosen: given.value,
        choose: (to) => exchanged(inputs as Inputs, to),
      },
      number(given.value, given.text, given.unit),
      number("rest_acceleration", t("From rest to rest with"), "m/s²", true),
    ];
  },
  beside: () => ({ samples: 161 }),
  facts: ({ blend, rest_to_rest: rest }) => [
    { label: t("Blend time ΔT"), value: blend.blend_time, unit: "s" },
    { label: "d₁, d₂", value: [blend.distance_before, blend.distance_after], unit: "m" },
    { label: t("A′, where it begins"), value: blend.entry, unit: "m" },
    { label: t("C′, where it ends"), value: blend.exit, unit: "m" },
    { label: t("Acceleration"), value: blend.acceleration, unit: `m/s², |a| = ${short(blend.acceleration_norm)}` },
    {
      label: t("Nearest to B"),
      value: blend.closest_distance,
      unit: t("m at {closest_time} s", { closest_time: short(blend.closest_time) }),
    },
    { label: t("Longest ΔT"), value: blend.longest_blend_time, unit: "s" },
    ...(rest
      ? [
          {
            label: t("Rest to rest"),
            value: rest.duration,
            unit: t("s; {time_saved} s saved", { time_saved: short(rest.time_saved) }),
          },
        ]
      : []),
  ],
  picture,
};

/** Another quantity is given, with the value that the blend has anyhow where the form knows one. */
function exchanged(inputs: Inputs, to: string): Inputs {
  const rest = Object.fromEntries(
    Object.entries(inputs).filter(([name]) => !GIVEN.some(({ value }) => value === name)),
  );
  return { ...rest, [to]: valueAt(inputs, to) ?? 1 };
}

function picture({ blend, samples }: FlyOverAnswer, inputs: FlyOverRequest, stage: Stage): Picture {
  const corners = POINTS.map((name) => flat(inputs[name]));
  const box = { x: MARGIN, y: MARGIN, width: stage.width - 2 * MARGIN, height: HEIGHT - 2 * MARGIN };
  const plane = stage.scale("plane", () => new Plane(corners, box));
  const at = (point: readonly number[]) => plane.to(flat(point));
  const [a, b, c] = corners.map((point) => plane.to(point)) as [Point, Point, Point];
  const [entry, exit] = [at(blend.entry), at(blend.exit)];
  const middle: Point = [(entry[0] + exit[0]) / 2, (entry[1] + exit[1]) / 2];
  const nodes = [
    line([a, b, c], "leg"),
    line((samples?.positions ?? []).map(at), "curve curve-1"),
    ...arrow(middle, along(blend.acceleration, middle), "curve-2"),
    label(
      [along(blend.acceleration, middle)[0] + 6, along(blend.acceleration, middle)[1] - 6],
      "a",
      "curve-2",
      "start",
    ),
    dot(entry, "mark"),
    dot(exit, "mark"),
    ...(distance(entry, b) > ROOM ? ends(entry, b, exit, "A′", `d₁ = ${short(blend.distance_before, 4)}`) : []),
    ...(distance(exit, b) > ROOM ? ends(exit, b, entry, "C′", `d₂ = ${short(blend.distance_after, 4)}`) : []),
    ...[a, b, c].flatMap((point, i) => [
      handle(point, String(i), "curve-3"),
      label([point[0] - 12, point[1] - 10], "ABC"[i]!, "title"),
    ]),
  ];
  const name = t("The way from A past B to C; the parabola passes B at {closest_distance} m", {
    closest_distance: short(blend.closest_distance, 4),
  });
  const drag: Picture["drag"] = (grip, to, { inputs: before }) => {
    const key = POINTS[Number(grip)]!;
    const [x, y] = plane.from(to);
    return { ...before, [key]: [x, y] };
  };
  return { nodes, height: HEIGHT, name, ...(inputs.corner.length === 2 && { drag }) };
}

/** In the plane as it is; in space from in front, from the right and above. */
function flat([x = 0, y = 0, z]: readonly number[]): Point {
  return z === undefined ? [x, y] : [x - 0.35 * y, z + 0.35 * y];
}

function along(vector: readonly number[], from: Point): Point {
  const [x, y] = flat(vector);
  const length = Math.hypot(x, y) || 1;
  return [from[0] + (x / length) * 48, from[1] - (y / length) * 48];
}

/** The names of an end of the blend and of its distance from the corner. */
function ends(at: Point, corner: Point, other: Point, name: string, distance: string): SVGElement[] {
  return [label([at[0] + 8, at[1] + 18], name, "value", "start"), label(beside(at, corner, other), distance, "tick")];
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/** Beside the middle of a leg, on the side where the other one is not. */
function beside(from: Point, to: Point, other: Point): Point {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy) || 1;
  const side = Math.sign(dx * (other[1] - from[1]) - dy * (other[0] - from[0])) || 1;
  return [(from[0] + to[0]) / 2 + side * (dy / length) * 36, (from[1] + to[1]) / 2 + 4 - side * (dx / length) * 14];
}
