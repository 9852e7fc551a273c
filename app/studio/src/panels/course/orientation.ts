/** Orientations: rotations one after the other, each as a triad that can be turned, and the result in every notation. */

import { t } from "../../texts/index.ts";
import type { OrientationAnswer, OrientationRequest } from "../../types.ts";
import { subscript } from "../../ui/quantity.ts";
import { type Calculator, type Fact, type Field, type Inputs, type Picture, valueAt, withValue } from "./calculator.ts";
import { column, IDENTITY, type Rotation, seen, turned, type Vector, dot } from "./space.ts";
import type { Stage } from "./stage.ts";
import { arrow, label, line, svg } from "./svg.ts";

type Motion = Omit<NonNullable<OrientationRequest["then"]>[number], "about">;

const CELL = 230;
const MOST_IN_A_ROW = 3;
const ARC = 0.62;
const AXES = "xyz";
/** [rad] for a pixel of dragging. */
const TURN = Math.PI / 180;

const about = (axis: "x" | "y" | "z", angle: number) => ({ elementary: { axis, angle } });
const chain = (how: "moving" | "fixed", ...turns: [string, number][]): OrientationRequest => {
  const [first, ...others] = turns.map(([axis, angle]) => about(axis as "x", angle));
  return { ...first, then: others.map((one) => ({ ...one, about: how })) };
};

export const orientation: Calculator<OrientationRequest, OrientationAnswer> = {
  id: "orientation",
  title: t("Orientation"),
  says: t(
    "Rotations one after the other, each about an axis of the frame that moves or of the one that stays. Drag a triad.",
  ),
  path: "v1/course/orientation",
  page: "course/poses.html#three-angles",
  hasAngles: true,
  examples: [
    { title: "ZYZ", inputs: chain("moving", ["z", 0.3], ["y", 0.7], ["z", -1.1]) },
    { title: t("Roll, pitch, yaw"), inputs: chain("fixed", ["x", 0.4], ["y", -0.5], ["z", 0.9]) },
    { title: t("ZYZ at θ = 0"), inputs: chain("moving", ["z", 0.3], ["y", 0], ["z", 0.5]) },
    { title: t("Quaternion"), inputs: { quaternion_xyzw: [0.5, 0.5, 0.5, 0.5] } },
    { title: t("Axis and angle"), inputs: { axis_angle: { axis: [1, 1, 1], angle: (2 * Math.PI) / 3 } } },
    {
      title: t("Matrix"),
      inputs: {
        rotation: [
          [0, -1, 0],
          [1, 0, 0],
          [0, 0, 1],
        ],
      },
    },
  ],
  fields: (inputs) => [
    ...motionFields(inputs, "", "1"),
    ...further(inputs).flatMap((motion, i) => motionFields(motion, `then/${i}/`, String(i + 2))),
    ...(further(inputs).length ? [axesField(inputs)] : []),
    ...(inputs.points ? [list("points", t("Points"), "m")] : []),
  ],
  facts: (answer): Fact[] => [
    { label: "R", value: answer.rotation },
    { label: t("Quaternion x, y, z, w"), value: answer.quaternion_xyzw },
    { label: t("Axis"), value: answer.axis_angle.axis ?? "none: nothing is turned" },
    { label: t("Angle"), value: answer.axis_angle.angle, unit: "rad" },
    ...branches("ZYZ φ, θ, ψ", answer.zyz_solutions),
    ...branches(t("Roll, pitch, yaw"), answer.rpy_solutions),
    ...answer.points.map((point, i) => ({ label: t("Point {i}", { i: i + 1 }), value: point, unit: "m" })),
  ],
  picture,
};

function branches(name: string, solutions: readonly number[][]): Fact[] {
  return solutions.map((value, i) => ({ label: i ? t("{name}, too", { name }) : name, value, unit: "rad" }));
}

function further(inputs: OrientationRequest): NonNullable<OrientationRequest["then"]> {
  return Array.isArray(inputs.then) ? inputs.then : [];
}

const list = (pointer: string, label: string, unit = ""): Field => ({ pointer, label, unit, kind: "list" });

/** The fields of the notation that a motion is written in. */
function motionFields(motion: Motion, place: string, number: string): Field[] {
  const fields: Field[] = [];
  const angle = (pointer: string) => ({
    pointer: `${place}${pointer}`,
    label: t("Angle {number}", { number }),
    kind: "angle" as const,
    slides: true,
    step: TURN,
  });
  if (motion.elementary) {
    const options = [...AXES].map((value) => ({ value, text: value }));
    fields.push({ pointer: `${place}elementary/axis`, label: t("Axis {number}", { number }), kind: "choice", options });
    fields.push(angle("elementary/angle"));
  }
  if (motion.axis_angle)
    fields.push(list(`${place}axis_angle/axis`, t("Axis {number}", { number })), angle("axis_angle/angle"));
  for (const [name, text, unit] of NOTATIONS)
    if (motion[name]) fields.push(list(`${place}${name}`, `${text} ${number}`, unit));
  if (motion.position) fields.push(list(`${place}position`, t("Origin {number}", { number }), "m"));
  if (motion.rotation)
    fields.push({ pointer: `${place}project`, label: t("Take the nearest rotation"), kind: "switch" });
  return fields;
}

const NOTATIONS = [
  ["zyz", "φ, θ, ψ", "rad"],
  ["rpy", t("Roll, pitch, yaw"), "rad"],
  ["rotation_vector", t("Rotation vector"), "rad"],
  ["quaternion_xyzw", t("Quaternion x, y, z, w"), ""],
  ["quaternion_wxyz", t("Quaternion w, x, y, z"), ""],
  ["rotation", t("Matrix"), ""],
] as const;

/** Whether all further rotations are about moving axes or about fixed ones. */
function axesField(inputs: OrientationRequest): Field {
  return {
    pointer: "then/0/about",
    label: t("About axes that"),
    kind: "choice",
    options: [
      { value: "moving", text: t("move") },
      { value: "fixed", text: t("stay") },
    ],
    chosen: further(inputs)[0]!.about ?? "moving",
    choose: (how) =>
      ({ ...inputs, then: further(inputs).map((one) => ({ ...one, about: how as "moving" | "fixed" })) }) as Inputs,
  };
}

function picture({ frames }: OrientationAnswer, inputs: OrientationRequest, stage: Stage): Picture {
  const motions: readonly (Motion & { about?: string })[] = [inputs, ...further(inputs)];
  const inRow = Math.min(frames.length, Math.max(1, Math.min(MOST_IN_A_ROW, Math.floor(stage.width / 200))));
  const width = stage.width / inRow;
  const rows = Math.ceil(frames.length / inRow);
  const nodes = frames.map(({ rotation }, i) => {
    const before = i ? frames[i - 1]!.rotation : IDENTITY;
    const place = [(i % inRow) * width, Math.floor(i / inRow) * CELL] as const;
    return triad(before, rotation, motions[i], i, { x: place[0], y: place[1], width }, stage);
  });
  return {
    nodes,
    height: rows * CELL,
    name: t("{length}, each with the one before it", {
      length: frames.length === 1 ? t("A frame") : t("{length} frames, one after the other", { length: frames.length }),
    }),
    drag: (grip, at, from) => {
      const place = Number(grip) ? `then/${Number(grip) - 1}/` : "";
      const pointer = ["elementary/angle", "axis_angle/angle"]
        .map((name) => place + name)
        .find((name) => typeof valueAt(from.inputs, name) === "number");
      if (!pointer) return from.inputs;
      const angle = (valueAt(from.inputs, pointer) as number) + (at[0] - from.at[0]) * TURN;
      return withValue(from.inputs, pointer, Number(Math.atan2(Math.sin(angle), Math.cos(angle)).toFixed(3)));
    },
  };
}

/** A frame in colours, the one before it in grey, and the arc that leads from one to the other. */
function triad(
  before: Rotation,
  R: Rotation,
  motion: (Motion & { about?: string }) | undefined,
  i: number,
  box: { x: number; y: number; width: number },
  stage: Stage,
): SVGElement {
  const centre = [box.x + box.width / 2, box.y + CELL / 2 + 22] as const;
  const size = Math.min(CELL, box.width) * 0.38;
  const at = (v: Vector, length = 1) => {
    const [x, y] = seen(v);
    return [centre[0] + x * size * length, centre[1] + y * size * length] as const;
  };
  const axes = [0, 1, 2].flatMap((j) => [
    line([centre, at(column(before, j))], "leg"),
    ...arrow(centre, at(column(R, j)), `axis-${AXES[j]}`),
    label(at(column(R, j), 1.14), `${AXES[j]}${subscript(i + 1)}`, `axis-${AXES[j]} value`),
  ]);
  const elementary = motion?.elementary;
  const title = elementary
    ? `R${elementary.axis}(${stage.angle(elementary.angle)})${i ? t(", {about} axis", { about: motion.about ?? "moving" }) : ""}`
    : t("Frame {i}", { i: i + 1 });
  const surface = svg("rect", { x: box.x, y: box.y, width: box.width, height: CELL, class: "reach" });
  const arcs = elementary ? arc(before, motion, at) : [];
  return svg("g", { "data-handle": i }, surface, label([centre[0], box.y + 20], title, "title"), ...axes, ...arcs);
}

/** The way of that axis of the frame before which the rotation moves most. */
function arc(
  before: Rotation,
  motion: Motion & { about?: string },
  at: (v: Vector, length: number) => readonly [number, number],
) {
  const { axis, angle } = motion.elementary!;
  const j = AXES.indexOf(axis);
  const frame = motion.about === "fixed" ? IDENTITY : before;
  const along = (k: number) => Math.abs(dot(column(before, k), column(frame, j)));
  const from = column(before, [0, 1, 2].sort((a, b) => along(a) - along(b))[0]!);
  const points = Array.from({ length: 33 }, (_, k) => at(turned(from, column(frame, j), (angle * k) / 32), ARC));
  return [line(points.slice(0, -1), "curve-2"), ...arrow(points.at(-2)!, points.at(-1)!, "curve-2")];
}
