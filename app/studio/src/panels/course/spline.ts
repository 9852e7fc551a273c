/** Cubic splines through knots, which can be dragged. */

import { t } from "../../texts/index.ts";
import type { SplineAnswer, SplineRequest } from "../../types.ts";
import type { Calculator, Field, Inputs, Point } from "./calculator.ts";
import { short } from "./chart.ts";
import { motionFacts, motionPicture } from "./motion.ts";

type Boundary = NonNullable<SplineRequest["boundary"]>;

const BOUNDARIES: readonly { value: Boundary; text: string }[] = [
  { value: "clamped", text: t("Clamped: velocities at the ends") },
  { value: "natural", text: t("Natural: no acceleration at the ends") },
  { value: "not_a_knot", text: t("Not-a-knot") },
  { value: "periodic", text: t("Periodic") },
  { value: "assigned", text: t("Velocities and accelerations") },
];
const list = (pointer: string, label: string, unit: string, optional = true): Field => ({
  pointer,
  label,
  unit,
  kind: "list",
  optional,
});
const VELOCITIES = [list("start_velocity", t("Velocity v₁"), "1/s"), list("end_velocity", "Velocity v_N", "1/s")];
const ACCELERATIONS = [
  list("start_acceleration", t("Acceleration a₁"), "1/s²"),
  list("end_acceleration", "Acceleration a_N", "1/s²"),
];
const OF_BOUNDARY: Partial<Record<Boundary, readonly Field[]>> = {
  clamped: VELOCITIES,
  assigned: [...VELOCITIES, ...ACCELERATIONS, list("fictitious_times", t("Fictitious knots at"), "s")],
};

export const spline: Calculator<SplineRequest, SplineAnswer> = {
  id: "spline",
  title: t("Splines"),
  says: t("A cubic between each two knots, without a jump of the acceleration. Drag the knots."),
  path: "v1/course/spline",
  page: "course/trajectories.html#splines",
  examples: [
    {
      title: t("Lecture"),
      inputs: { times: [0, 2, 3, 5], waypoints: [0, 2 * Math.PI, 0.5 * Math.PI, Math.PI], boundary: "clamped" },
    },
    {
      title: t("Five knots"),
      inputs: { times: [0, 1, 2.5, 3, 4], waypoints: [0, 1, 0.5, 2, 1.5], boundary: "natural" },
    },
    { title: t("Periodic"), inputs: { times: [0, 1, 2.5, 3, 4], waypoints: [0, 1, 0.5, 2, 0], boundary: "periodic" } },
    {
      title: t("Two joints"),
      inputs: {
        times: [0, 1, 2, 4],
        waypoints: [
          [0, 1],
          [1, 0.5],
          [0.5, -0.5],
          [1.5, 0],
        ],
        boundary: "clamped",
      },
    },
  ],
  fields: (inputs) => [
    list("times", t("Times t"), "s", false),
    list("waypoints", t("Knots q"), t("rad or m"), false),
    {
      pointer: "boundary",
      label: t("At the ends"),
      kind: "choice",
      options: BOUNDARIES,
      choose: (boundary) => ({ times: inputs.times, waypoints: inputs.waypoints, boundary }),
    },
    ...(OF_BOUNDARY[inputs.boundary ?? "clamped"] ?? []),
  ],
  beside: () => ({ samples: 301 }),
  facts: (answer) => [
    ...motionFacts(answer),
    ...answer.knots.map(({ time, velocities, accelerations, fictitious }) => ({
      label: t("v, a at {time} s{fictitious}", { time: short(time), fictitious: fictitious ? " (fictitious)" : "" }),
      value: `${velocities.map((v) => short(v)).join(", ")} /s; ${accelerations.map((a) => short(a)).join(", ")} /s²`,
    })),
    ...(answer.system?.matrix ? [{ label: "A", value: answer.system.matrix }] : []),
    ...(answer.system ? [{ label: "b", value: answer.system.right_side }] : []),
  ],
  picture: (answer, _, stage) => {
    const given = answer.knots.filter(({ fictitious }) => !fictitious);
    const grips = given.flatMap(({ time, positions }) =>
      positions.map((position, joint) => ({ at: [time, position] as const, joint })),
    );
    const joints = given[0]?.positions.length ?? 1;
    return motionPicture(answer, stage, grips, (grip, to, inputs) =>
      moved(inputs, Math.floor(grip / joints), grip % joints, to),
    );
  },
};

/** A knot elsewhere; in time it stays between its neighbours, and the first and last keep theirs. */
function moved(inputs: Inputs, knot: number, joint: number, [time, position]: Point): Inputs {
  const { times, waypoints } = inputs as unknown as SplineRequest;
  const [before, after] = [times[knot - 1], times[knot + 1]];
  const isInside = before !== undefined && after !== undefined;
  const round = (value: number) => Number(value.toFixed(2));
  const at = isInside ? Math.min(Math.max(round(time), round(before + 0.05)), round(after - 0.05)) : times[knot]!;
  const rows = waypoints.map((row, i) => {
    if (i !== knot) return row;
    return Array.isArray(row) ? row.map((q, j) => (j === joint ? round(position) : q)) : round(position);
  });
  return { ...inputs, times: times.map((one, i) => (i === knot ? at : one)), waypoints: rows };
}
