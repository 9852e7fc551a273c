/** The picture of a motion of joints over time: position, velocity, acceleration, and the limits. */

import { t } from "../../texts/index.ts";
import type { Fact, Inputs, Picture, Point } from "./calculator.ts";
import { chart, type Chart, short } from "./chart.ts";
import type { Stage } from "./stage.ts";
import { handle } from "./svg.ts";

const HEIGHT = 178;
const QUANTITIES = ["joint_positions", "joint_velocities", "joint_accelerations"] as const;
const TITLES = [t("Position q [rad or m]"), "Velocity q̇ [1/s]", "Acceleration q̈ [1/s²]"];

interface Peak {
  value: number;
  time: number;
  limit: number | null;
}

export interface Motion {
  duration: number;
  times: number[];
  joint_positions: number[][];
  joint_velocities: number[][];
  joint_accelerations: number[][];
  peaks: { velocity: Peak[]; acceleration: Peak[] };
}

/** @param points passed on the way, that can be dragged where `drag` says what becomes of the inputs. */
export function motionPicture(
  motion: Motion,
  stage: Stage,
  points: readonly { at: Point; joint: number }[] = [],
  drag?: (point: number, to: Point, inputs: Inputs) => Inputs,
): Picture {
  const of = (quantity: (typeof QUANTITIES)[number]) =>
    motion.joint_positions[0]!.map((_, joint) => motion[quantity].map((row) => row[joint]!));
  const charts = QUANTITIES.map((quantity, i) => {
    const made: Chart = { title: TITLES[i]!, x: motion.times, curves: of(quantity), ...marks(motion, i) };
    return chart(stage, quantity, i * HEIGHT, HEIGHT, i === 0 ? { ...made, axis: "t [s]" } : made);
  });
  const { scale } = charts[0]!;
  const grips = points.map(({ at, joint }, i) => handle(scale.to(at), String(i), `curve-${(joint % 6) + 1}`));
  return {
    nodes: [...charts.map(({ node }) => node), ...grips],
    height: QUANTITIES.length * HEIGHT,
    name: t("Position, velocity and acceleration over {duration} s", { duration: short(motion.duration) }),
    ...(drag && { drag: (name, at, { inputs }) => drag(Number(name), scale.from(at), inputs) }),
  };
}

/** How long it takes, and the peaks of each joint. */
export function motionFacts({ duration, peaks }: Motion): Fact[] {
  const several = peaks.velocity.length > 1;
  const of = (what: string, list: readonly Peak[], unit: string) =>
    list.map(({ value, time, limit }, i) => ({
      label: t("Peak of {what}{i}", { what, i: several ? t(", joint {i}", { i: i + 1 }) : "" }),
      value: `${short(value)}${unit} at ${short(time)} s${limit === null ? "" : t(", limit {limit}", { limit: short(limit) })}`,
    }));
  return [
    { label: t("Duration T"), value: duration, unit: "s" },
    ...of("q̇", peaks.velocity, " /s"),
    ...of("q̈", peaks.acceleration, " /s²"),
  ];
}

function marks({ peaks }: Motion, quantity: number): Pick<Chart, "marks" | "limits"> {
  if (quantity === 0) return {};
  const list = quantity === 1 ? peaks.velocity : peaks.acceleration;
  return {
    marks: list.map(({ value, time }, joint) => ({
      at: [time, value] as const,
      text: short(value, 4),
      kind: `curve-${(joint % 6) + 1}`,
    })),
    limits: list.flatMap(({ limit }) => (limit === null ? [] : [limit])),
  };
}
