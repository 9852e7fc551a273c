/** Time laws: polynomials, the trapezoid, blends. */

import { t } from "../../texts/index.ts";
import type { TimeLawAnswer, TimeLawRequest } from "../../types.ts";
import { type Calculator, type Fact, type Field, type Inputs, number } from "./calculator.ts";
import { motionFacts, motionPicture } from "./motion.ts";
import { short } from "./chart.ts";

type Law = TimeLawRequest["law"];

const JOINT = t("rad or m");
const POINTS = { waypoints: [0, 0.3, 1.2, 1.5], times: [0, 0.5, 1.5, 2] };
const MOVE = { start: 0.2, target: 1.4, start_velocity: 0.5, end_velocity: -0.3, duration: 2 };
const EXAMPLES: Record<Law, TimeLawRequest> = {
  cubic: { law: "cubic", ...MOVE },
  quintic: { law: "quintic", ...MOVE, start_acceleration: 0.1, end_acceleration: 0.2 },
  septic: { law: "septic", ...MOVE },
  trapezoidal: {
    law: "trapezoidal",
    start: 0,
    target: 2,
    limits: { joint_velocity: 0.8, joint_acceleration: 1.6 },
  },
  "4-3-4": { law: "4-3-4", ...POINTS },
  parabolic_blends: { law: "parabolic_blends", ...POINTS, blend_time: 0.2 },
};
const LAWS: readonly { value: Law; text: string }[] = [
  { value: "cubic", text: t("Cubic") },
  { value: "quintic", text: t("Quintic") },
  { value: "septic", text: t("Septic") },
  { value: "trapezoidal", text: t("Trapezoid (bang-coast-bang)") },
  { value: "4-3-4", text: "4-3-4" },
  { value: "parabolic_blends", text: t("Lines with parabolic blends") },
];

const field = (pointer: string, label: string, unit: string, optional = true): Field => ({
  pointer,
  label,
  unit,
  kind: "list",
  optional,
});

const ENDS = [field("start", t("Start q₀"), JOINT, false), field("target", t("Target q₁"), JOINT, false)];
const VELOCITIES = [field("start_velocity", t("Velocity v₀"), "1/s"), field("end_velocity", t("Velocity v₁"), "1/s")];
const ACCELERATIONS = [
  field("start_acceleration", t("Acceleration a₀"), "1/s²"),
  field("end_acceleration", t("Acceleration a₁"), "1/s²"),
];
const JERKS = [field("start_jerk", t("Jerk j₀"), "1/s³"), field("end_jerk", t("Jerk j₁"), "1/s³")];
const DURATION = number("duration", t("Duration T"), "s");
const LIMITS = [
  field("limits/joint_velocity", t("Limit of |q̇|"), "1/s"),
  field("limits/joint_acceleration", t("Limit of |q̈|"), "1/s²"),
];
const KNOTS = [field("waypoints", t("Points q"), JOINT, false), field("times", t("at times t"), "s", false)];

const FIELDS: Record<Law, readonly Field[]> = {
  cubic: [...ENDS, ...VELOCITIES, DURATION, ...LIMITS],
  quintic: [...ENDS, ...VELOCITIES, ...ACCELERATIONS, DURATION, ...LIMITS],
  septic: [...ENDS, ...VELOCITIES, ...ACCELERATIONS, ...JERKS, DURATION, ...LIMITS],
  trapezoidal: [
    ...ENDS,
    ...VELOCITIES,
    ...LIMITS.map((one) => ({ ...one, optional: false })),
    { ...DURATION, optional: true },
    { pointer: "may_reverse", label: t("May turn back"), kind: "switch" },
  ],
  "4-3-4": [...KNOTS, ...VELOCITIES, ...ACCELERATIONS, ...LIMITS],
  parabolic_blends: [...KNOTS, field("blend_time", t("Blend time"), "s"), ...LIMITS],
};

export const timeLaw: Calculator<TimeLawRequest, TimeLawAnswer> = {
  id: "time-law",
  title: t("Time laws"),
  says: t("How a joint gets from one position to another: position, velocity and acceleration over time."),
  path: "v1/course/time-law",
  page: "course/trajectories.html#polynomials",
  examples: LAWS.map(({ value, text }) => ({ title: text, inputs: EXAMPLES[value] })),
  fields: ({ law }) => [
    { pointer: "law", label: t("Law"), kind: "choice", options: LAWS, choose: (to) => EXAMPLES[to as Law] as Inputs },
    ...(FIELDS[law] ?? FIELDS.cubic),
  ],
  beside: () => ({ samples: 241 }),
  facts: (answer) => [...motionFacts(answer), ...coefficients(answer), ...profile(answer)],
  picture: (answer, _, stage) => motionPicture(answer, stage),
};

function coefficients({ normalised }: TimeLawAnswer): Fact[] {
  return (normalised ?? []).flatMap((list, i) =>
    list ? [{ label: `a, b, c, …${i ? t(", joint {i}", { i: i + 1 }) : ""}`, value: list }] : [],
  );
}

function profile({ profiles }: TimeLawAnswer): Fact[] {
  return (profiles ?? []).map(({ acceleration_time, coast_time, deceleration_time, peak_velocity }, i) => ({
    label: t("Phases{i}", { i: i ? t(", joint {i}", { i: i + 1 }) : "" }),
    value: `${[acceleration_time, coast_time, deceleration_time].map((one) => short(one)).join(" + ")} s at ${short(peak_velocity)} /s`,
  }));
}
