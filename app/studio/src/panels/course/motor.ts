/** A DC motor: its torque-speed line with the operating point, and the response to the step of the voltage. */

import { t } from "../../texts/index.ts";
import type { DcMotorAnswer, DcMotorRequest } from "../../types.ts";
import { type Calculator, number, type Picture } from "./calculator.ts";
import { chart, short } from "./chart.ts";
import type { Stage } from "./stage.ts";

const HEIGHT = 220;
const SMALL = 170;

const EXAMPLE: DcMotorRequest = {
  resistance: 1.2,
  inductance: 2e-3,
  torque_constant: 0.05,
  viscous_friction: 1e-4,
  inertia: 2e-4,
  voltage: 24,
  load_torque: 0.1,
  duration: 0.5,
};

export const motor: Calculator<DcMotorRequest, DcMotorAnswer> = {
  id: "dc-motor",
  title: t("DC motor"),
  says: t("A motor at a constant voltage and load: where it runs, and how it gets there."),
  path: "v1/course/dc-motor",
  page: "course/actuators.html#the-dc-motor",
  examples: [
    { title: t("Lecture"), inputs: EXAMPLE },
    { title: t("Beyond the stall torque"), inputs: { ...EXAMPLE, load_torque: 1.2 } },
    { title: t("As a generator"), inputs: { ...EXAMPLE, load_torque: -0.4 } },
    { title: t("Oscillating"), inputs: { ...EXAMPLE, inductance: 0.05, inertia: 2e-5, duration: 0.3 } },
  ],
  fields: () => [
    number("voltage", t("Voltage V"), "V", false, 1),
    number("load_torque", "Load τ_L", "N m", true, 0.01),
    number("resistance", t("Resistance R"), "Ω"),
    number("inductance", t("Inductance L"), "H", false, 0.001),
    number("torque_constant", "Constant k_t", "N m/A", false, 0.01),
    number("back_emf_constant", "Constant k_e", "V s/rad", true, 0.01),
    number("viscous_friction", t("Friction b"), "N m s", true, 1e-5),
    number("inertia", t("Inertia J"), "kg m²", false, 1e-5),
    number("duration", t("Shown for"), "s", true),
  ],
  beside: ({ duration }) => (duration == null ? {} : { samples: 241, times: null }),
  facts: ({ steady_state: steady, torque_speed_line: edge, dynamics }) => [
    { label: t("Speed ω"), value: steady.angular_velocity, unit: "rad/s" },
    { label: t("Current i"), value: steady.current, unit: "A" },
    { label: t("Regime"), value: steady.regime.replaceAll("_", " ") },
    { label: t("Shaft power"), value: steady.shaft_power, unit: "W" },
    { label: t("Efficiency"), value: steady.efficiency === null ? "none" : steady.efficiency },
    { label: t("Without load ω₀"), value: edge.no_load_angular_velocity, unit: "rad/s" },
    { label: t("Stall torque"), value: edge.stall_torque, unit: "N m" },
    { label: t("Stall current"), value: edge.stall_current, unit: "A" },
    {
      label: t("Poles"),
      value: dynamics.poles
        .map(
          ({ real, imaginary }) =>
            short(real) + (imaginary ? ` ${imaginary < 0 ? "−" : "+"} ${short(Math.abs(imaginary))}j` : ""),
        )
        .join(", "),
      unit: "1/s",
    },
  ],
  picture,
};

function picture(answer: DcMotorAnswer, inputs: DcMotorRequest, stage: Stage): Picture {
  const { steady_state: steady, torque_speed_line: edge, response } = answer;
  const load = inputs.load_torque ?? 0;
  const ends = [
    [0, edge.no_load_angular_velocity],
    [edge.stall_torque, 0],
    [load, steady.angular_velocity],
  ].sort((a, b) => a[0]! - b[0]!) as [number, number][];
  const curve = chart(stage, "line", 0, HEIGHT, {
    title: t("Speed ω [rad/s] over torque"),
    axis: "τ_L [N m]",
    x: ends.map(([torque]) => torque),
    curves: [ends.map(([, speed]) => speed)],
    marks: [
      { at: [load, steady.angular_velocity], text: `${short(steady.angular_velocity, 4)} rad/s`, kind: "curve-2" },
    ],
  });
  const over = (name: string, title: string, top: number, values: readonly number[]) =>
    chart(stage, name, top, SMALL, { title, axis: "t [s]", x: response!.times, curves: [values] }).node;
  const isShown = response !== null && response.times.length > 1;
  return {
    nodes: [
      curve.node,
      ...(isShown ? [over("speed", t("Speed ω [rad/s]"), HEIGHT, response.angular_velocities)] : []),
      ...(isShown ? [over("current", t("Current i [A]"), HEIGHT + SMALL, response.currents)] : []),
    ],
    height: HEIGHT + (isShown ? 2 * SMALL : 0),
    name: t("The torque-speed line; the motor runs at {angular_velocity} rad/s", {
      angular_velocity: short(steady.angular_velocity, 4),
    }),
  };
}
