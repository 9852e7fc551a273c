/** Encoders: the disc of an absolute one, the signals of an incremental one. */

import { t } from "../../texts/index.ts";
import type { EncoderAnswer, EncoderRequest } from "../../types.ts";
import type { Calculator, Fact, Field, Picture, Point } from "./calculator.ts";
import { short } from "./chart.ts";
import type { Stage } from "./stage.ts";
import { label, line, svg } from "./svg.ts";

const DISC = 380;
const MOST_DRAWN = 8; // tracks of a disc that the service lists
const LANE = 64;

const INCREMENTAL: EncoderRequest = {
  type: "incremental",
  pulses_per_revolution: 1024,
  decoding: "x4",
  gear_ratio: 50,
  sample_period: 0.001,
  samples: "00 10 11 01 00 10 11 10 00 01 11",
};
const ABSOLUTE: EncoderRequest = { type: "absolute", bits: 4, code: "gray", gear_ratio: 1, values: [5] };

const count = (pointer: string, label: string, optional = false): Field => ({
  pointer,
  label,
  kind: "number",
  optional,
  step: 1,
});
const COMMON: readonly Field[] = [
  { pointer: "gear_ratio", label: t("Gear ratio N"), kind: "number", optional: true, step: 1 },
  { pointer: "sample_period", label: "Sample period T_s", unit: "s", kind: "number", optional: true, step: 0.001 },
  {
    pointer: "motor_angular_velocity",
    label: t("Motor's speed"),
    unit: "rad/s",
    kind: "number",
    optional: true,
    step: 1,
  },
  { pointer: "wanted_resolution", label: t("Wanted at the load"), kind: "angle", optional: true },
];

export const encoder: Calculator<EncoderRequest, EncoderAnswer> = {
  id: "encoder",
  title: t("Encoder"),
  says: t("What a shaft encoder resolves, how its channels are counted, and the codes on its disc."),
  path: "v1/course/encoder",
  page: "course/actuators.html#measuring-the-angle",
  examples: [
    { title: t("Incremental"), inputs: INCREMENTAL },
    { title: t("Absolute, Gray"), inputs: ABSOLUTE },
    { title: t("Absolute, binary"), inputs: { ...ABSOLUTE, code: "binary" } },
    {
      title: t("Which one is needed?"),
      inputs: { type: "incremental", gear_ratio: 128, wanted_resolution: Math.PI / 180000, decoding: "x4" },
    },
  ],
  fields: ({ type }) => [
    {
      pointer: "type",
      label: t("Kind"),
      kind: "choice",
      options: [
        { value: "incremental", text: t("Incremental") },
        { value: "absolute", text: t("Absolute") },
      ],
      choose: (to) => (to === "absolute" ? ABSOLUTE : INCREMENTAL),
    },
    ...(type === "absolute" ? absoluteFields() : incrementalFields()),
    ...COMMON,
  ],
  beside: ({ type, bits }) => ({ table: type === "absolute" && typeof bits === "number" && bits <= MOST_DRAWN }),
  facts,
  picture: (answer, inputs, stage) => {
    if (answer.absolute?.table) return disc(answer.absolute.table, inputs, stage);
    return answer.quadrature ? signals(answer.quadrature, inputs, stage) : null;
  },
};

function incrementalFields(): Field[] {
  return [
    count("pulses_per_revolution", t("Lines"), true),
    {
      pointer: "decoding",
      label: t("Counted"),
      kind: "choice",
      options: ["x1", "x2", "x4"].map((value) => ({ value, text: value })),
    },
    { pointer: "samples", label: t("Channels AB or ABZ"), kind: "text", optional: true },
    count("counter_bits", t("Bits of the counter"), true),
  ];
}

function absoluteFields(): Field[] {
  return [
    count("bits", t("Bits"), true),
    {
      pointer: "code",
      label: t("Code"),
      kind: "choice",
      options: [
        { value: "gray", text: t("Gray") },
        { value: "binary", text: t("Binary") },
      ],
    },
    { pointer: "values", label: t("Numbers to write"), kind: "list", optional: true },
  ];
}

function facts({ resolution, required, quadrature, absolute }: EncoderAnswer): Fact[] {
  const made: (Fact | null | undefined)[] = [
    resolution && { label: t("Counts a turn"), value: resolution.counts_per_revolution },
    resolution && { label: t("Resolution, motor"), value: resolution.motor, unit: "rad" },
    resolution && { label: t("Resolution, load"), value: resolution.load, unit: "rad" },
    resolution?.motor_velocity_quantum != null
      ? { label: t("Quantum of speed"), value: `${short(resolution.motor_velocity_quantum)} rad/s` }
      : null,
    resolution?.count_rate != null ? { label: t("Counts a second"), value: resolution.count_rate } : null,
    required && { label: t("Needed: counts a turn"), value: required.counts_per_revolution },
    required && { label: t("Needed: bits"), value: required.bits },
    required && { label: t("Needed: lines"), value: required.pulses_per_revolution },
    quadrature && { label: t("Count"), value: quadrature.count },
    quadrature && { label: t("Direction"), value: quadrature.direction },
    quadrature && { label: t("Impossible transitions"), value: quadrature.illegal_transitions.length },
    quadrature?.load_angle != null ? { label: t("Angle, load"), value: quadrature.load_angle, unit: "rad" } : null,
    ...(absolute?.values ?? []).flatMap(({ value, binary, gray, angle }): Fact[] => [
      { label: t("{value} in binary and Gray", { value }), value: `${binary}, ${gray}` },
      { label: t("{value} as an angle", { value }), value: angle, unit: "rad" },
    ]),
  ];
  return made.filter((one) => one !== null && one !== undefined);
}

/** The code disc: a ring for each bit, the highest inside; the numbers that are written are marked. */
function disc(
  table: NonNullable<NonNullable<EncoderAnswer["absolute"]>["table"]>,
  inputs: EncoderRequest,
  stage: Stage,
): Picture {
  const size = Math.min(DISC, stage.width);
  const centre: Point = [stage.width / 2, size / 2];
  const bits = table[0]!.binary.length;
  const [inner, outer] = [size * 0.14, size * 0.42];
  const step = (outer - inner) / bits;
  const marked = new Set((inputs.values ?? []) as number[]);
  const sectors = table.flatMap(({ value, [inputs.code ?? "gray"]: code }) =>
    [...code].map((bit, ring) =>
      sector(centre, inner + ring * step, inner + (ring + 1) * step, value, table.length, [
        bit === "1" ? "dark" : "light",
        marked.has(value) ? "marked" : "",
      ]),
    ),
  );
  const names =
    table.length > 32
      ? []
      : table.map(({ value }) => {
          const angle = (2 * Math.PI * (value + 0.5)) / table.length;
          const at: Point = [
            centre[0] + (outer + 14) * Math.cos(angle),
            centre[1] - (outer + 14) * Math.sin(angle) + 4,
          ];
          return label(at, String(value), marked.has(value) ? "title" : "tick");
        });
  // What is marked is not covered by what lies beside it.
  sectors.sort((a, b) => Number(a.classList.contains("marked")) - Number(b.classList.contains("marked")));
  return {
    nodes: [...sectors, ...names],
    height: size,
    name: t("A disc with {bits} tracks and {length} positions", { bits, length: table.length }),
  };
}

function sector(centre: Point, r0: number, r1: number, value: number, of: number, kinds: readonly string[]) {
  const at = (radius: number, turn: number): string => {
    const angle = (2 * Math.PI * turn) / of;
    return `${(centre[0] + radius * Math.cos(angle)).toFixed(2)},${(centre[1] - radius * Math.sin(angle)).toFixed(2)}`;
  };
  const large = of === 1 ? 1 : 0;
  const [from, to] = [value, value + (of === 1 ? 0.999 : 1)];
  const path = `M${at(r0, from)} L${at(r1, from)} A${r1},${r1} 0 ${large} 0 ${at(r1, to)} L${at(r0, to)} A${r0},${r0} 0 ${large} 1 ${at(r0, from)} Z`;
  return svg("path", { d: path, class: `sector ${kinds.join(" ")}` });
}

/** The channels over the samples, and the count below them. */
function signals(quadrature: NonNullable<EncoderAnswer["quadrature"]>, inputs: EncoderRequest, stage: Stage): Picture {
  const samples = (inputs.samples ?? "").split(/[\s,;]+/).filter(Boolean);
  const [left, right] = [40, 20];
  const width = (stage.width - left - right) / Math.max(samples.length, 1);
  const wrong = new Set(quadrature.illegal_transitions);
  const lanes = ["A", "B", ...(samples[0]?.length === 3 ? ["Z"] : [])];
  const nodes = lanes.flatMap((name, lane) => {
    const [low, high] = [lane * LANE + 54, lane * LANE + 22];
    const points = samples.flatMap((sample, i): Point[] => {
      const y = sample[lane] === "1" ? high : low;
      return [
        [left + i * width, y],
        [left + (i + 1) * width, y],
      ];
    });
    return [label([left - 14, (low + high) / 2 + 4], name, "title"), line(points, `curve curve-${lane + 1}`)];
  });
  const bottom = lanes.length * LANE + 30;
  const isRoomy = width > 18;
  const counts = isRoomy
    ? quadrature.counts.map((value, i) =>
        label([left + (i + 0.5) * width, bottom], String(value).replace("-", "−"), wrong.has(i) ? "bad" : "value"),
      )
    : [];
  return {
    nodes: [...nodes, ...counts, label([left - 14, bottom], "n", "title")],
    height: bottom + 20,
    name: t("Channels {lanes} over {length} samples; the count ends at {count}", {
      lanes: lanes.join(", "),
      length: samples.length,
      count: quadrature.count,
    }),
  };
}
