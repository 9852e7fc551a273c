/** Mobility: a mechanism that is edited, and Grübler's count of it. */

import { t } from "../../texts/index.ts";
import type { MobilityAnswer, MobilityRequest } from "../../types.ts";
import type { Calculator, Fact, Field, Inputs, Picture, Point } from "./calculator.ts";
import {
  isNamed,
  isPlaced,
  kindOf,
  linksOf,
  type Pair,
  pairsOf,
  spaceOf,
  TYPES,
  withPairChanged,
} from "./mechanism.ts";
import { MechanismEditor } from "./mobilityEditor.ts";
import { Plane, type Stage } from "./stage.ts";
import { dot, handle, label, line, polygon } from "./svg.ts";

const HEIGHT = 400;
const MARGIN = 56;
const TOP = 40;

const pair = (link_a: string, link_b: string, type: string, ...at: number[]) =>
  ({ link_a, link_b, type, ...(at.length && { point: [...at, 0] }) }) as Pair & { type: "revolute" };
const FOUR_BAR: MobilityRequest = {
  space: "planar",
  links: ["frame", "crank", "coupler", "rocker"],
  pairs: [
    pair("frame", "crank", "revolute", 0, 0),
    pair("crank", "coupler", "revolute", 0.3, 0.8),
    pair("coupler", "rocker", "revolute", 2, 1.6),
    pair("rocker", "frame", "revolute", 2.4, 0),
  ],
};
const SLIDER_CRANK: MobilityRequest = {
  space: "planar",
  links: ["frame", "crank", "rod", "slider"],
  pairs: [
    pair("frame", "crank", "revolute", 0, 0),
    pair("crank", "rod", "revolute", 0.5, 0.7),
    pair("rod", "slider", "revolute", 2.2, 0),
    { ...pair("slider", "frame", "prismatic", 2.6, 0), axis: [1, 0, 0] },
  ],
};
const TRUSS: MobilityRequest = {
  space: "planar",
  links: ["frame", "left", "right"],
  pairs: [
    pair("frame", "left", "revolute", 0, 0),
    pair("left", "right", "revolute", 1, 1.6),
    pair("right", "frame", "revolute", 2, 0),
  ],
};
const SIX_JOINTS: MobilityRequest = {
  space: "spatial",
  links: ["base", "1", "2", "3", "4", "5", "6"],
  pairs: ["base", "1", "2", "3", "4", "5"].map((link, i) => pair(link, String(i + 1), "revolute")),
};
const RSSR: MobilityRequest = {
  space: "spatial",
  links: ["frame", "input", "rod", "output"],
  pairs: [
    pair("frame", "input", "revolute"),
    pair("input", "rod", "spherical"),
    pair("rod", "output", "spherical"),
    pair("output", "frame", "revolute"),
  ],
};

export const mobility: Calculator<MobilityRequest, MobilityAnswer> = {
  id: "mobility",
  title: t("Mobility"),
  says: t("Links and joints of a mechanism, and Grübler's count of its freedoms. In the plane drag the joints."),
  path: "v1/course/mobility",
  page: "course/mobility.html",
  examples: [
    { title: t("Four bars"), inputs: FOUR_BAR },
    { title: t("Slider and crank"), inputs: SLIDER_CRANK },
    { title: t("Truss"), inputs: TRUSS },
    { title: t("Six joints"), inputs: SIX_JOINTS },
    { title: t("RSSR"), inputs: RSSR },
  ],
  fields: (inputs) => (isNamed(inputs as Inputs) || inputs.robot ? [] : countFields(inputs)),
  facts,
  picture: (answer, inputs, stage) => (isNamed(inputs as Inputs) ? picture(answer, inputs as Inputs, stage) : null),
  editor: (change) => new MechanismEditor(change),
};

/** Of a mechanism of which only numbers are given. */
function countFields({ pairs }: MobilityRequest): Field[] {
  const kinds = typeof pairs === "object" && pairs !== null && !Array.isArray(pairs) ? Object.keys(pairs) : [];
  return [
    {
      pointer: "space",
      label: t("Space"),
      kind: "choice",
      options: [
        { value: "planar", text: t("Plane") },
        { value: "spatial", text: t("Space") },
      ],
    },
    { pointer: "links", label: t("Links n, with the ground"), kind: "number", step: 1 },
    ...kinds.map((kind): Field => ({
      pointer: `pairs/${kind}`,
      label: kind.replaceAll("_", " "),
      kind: "number",
      step: 1,
    })),
  ];
}

function facts(answer: MobilityAnswer): Fact[] {
  const { chain, loop_count: loops, idle, posture, mobility_without_split: unsplit } = answer;
  return [
    { label: t("Mobility M"), value: answer.mobility },
    { label: t("Verdict"), value: answer.verdict.replaceAll("_", " ") },
    { label: t("Links n, pairs j"), value: [answer.link_count, answer.pair_count] },
    { label: t("Constraints Σc"), value: answer.constraint_count },
    ...(chain
      ? [{ label: t("Chain"), value: `${chain}, ${loops} independent ${loops === 1 ? "loop" : "loops"}` }]
      : []),
    ...(idle?.length ? [{ label: t("Without idle spins"), value: answer.mobility_without_idle! }] : []),
    ...(posture ? [{ label: t("In this posture"), value: posture.mobility }] : []),
    ...(unsplit === null ? [] : [{ label: t("Without the split"), value: `${unsplit}, which is wrong` }]),
  ];
}

function picture(answer: MobilityAnswer, inputs: Inputs, stage: Stage): Picture {
  const { space_freedoms: freedoms, link_count: n, constraint_count: c, mobility: M } = answer;
  const formula = `M = λ (n − 1) − Σc = ${freedoms} · ${n - 1} − ${c} = ${String(M).replace("-", "−")}`;
  const head = label([stage.width / 2, 26], formula, "title");
  const isDrawn = isPlaced(inputs) && spaceOf(inputs) === "planar";
  const { nodes, drag } = isDrawn
    ? inPosture(inputs, answer.ground, stage)
    : { nodes: graph(inputs, stage), drag: undefined };
  const name = t("{length} links and {length2} joints; {formula}", {
    length: linksOf(inputs).length,
    length2: pairsOf(inputs).length,
    formula,
  });
  return { nodes: [head, ...nodes], height: HEIGHT, name, ...(drag && { drag }) };
}

/** Each link as a bar or plate between its joints; the ground's are hatched. */
function inPosture(inputs: Inputs, rest: string | null, stage: Stage): Pick<Picture, "nodes" | "drag"> {
  const [links, pairs] = [linksOf(inputs), pairsOf(inputs)];
  const box = { x: MARGIN, y: TOP + MARGIN / 2, width: stage.width - 2 * MARGIN, height: HEIGHT - TOP - MARGIN * 1.5 };
  const points = pairs.map(({ point }) => [point![0]!, point![1]!] as const);
  const plane = stage.scale("plane", () => new Plane([...points, [0, 0], [1, 1]], box));
  const at = points.map((point) => plane.to(point));
  const nodes = links.flatMap((link, i) => {
    const own = at.filter((_, k) => pairs[k]!.link_a === link || pairs[k]!.link_b === link);
    return own.length ? body(link, own, i, link === rest) : [];
  });
  const joints = pairs.flatMap((one, k) => [...mark(one, at[k]!), handle(at[k]!, String(k), "joint")]);
  return {
    nodes: [...nodes, ...joints],
    drag: (grip, to, { inputs: before }) => withPairChanged(before, Number(grip), { point: [...plane.from(to), 0] }),
  };
}

function body(link: string, points: readonly Point[], i: number, isGround: boolean): SVGElement[] {
  const kind = `curve-${(i % 6) + 1}`;
  const middle = mean(points);
  const name = label(beside(points, middle), link, `${kind} value`, points.length < 3 ? "start" : "middle");
  if (isGround)
    return [...points.flatMap(ground), label([middle[0], Math.max(...points.map(([, y]) => y)) + 36], link, "tick")];
  if (points.length < 3) return [line(points, `bar ${kind}`), name];
  const around = [...points].sort((a, b) => turn(a, middle) - turn(b, middle));
  return [polygon(around, `plate ${kind}`), name];
}

/** To the right of the middle of a bar, above one that lies. */
function beside(points: readonly Point[], [x, y]: Point): Point {
  if (points.length !== 2) return [x + 10, y - 10];
  const [dx, dy] = [points[1]![0] - points[0]![0], points[1]![1] - points[0]![1]];
  const length = Math.hypot(dx, dy) || 1;
  const side = Math.abs(dy) < 0.3 * length ? Math.sign(dx) || 1 : Math.sign(dy);
  return [x + (side * dy * 12) / length, y - (side * dx * 12) / length + 4];
}

/** The sign of what is at rest. */
function ground([x, y]: Point): SVGElement[] {
  const hatches = [-12, -4, 4, 12].map((dx) =>
    line(
      [
        [x + dx, y + 16],
        [x + dx - 6, y + 23],
      ],
      "tick",
    ),
  );
  const base = polygon(
    [
      [x, y],
      [x - 13, y + 16],
      [x + 13, y + 16],
    ],
    "support",
  );
  return [base, ...hatches];
}

/** What a joint does where it is more than turning. */
function mark(pair: Pair, [x, y]: Point): SVGElement[] {
  const kind = kindOf(pair);
  const letter = kind === "revolute" ? [] : [label([x, y - 14], TYPES.planar[kind] ?? kind, "value")];
  const [dx = 0, dy = 0] = pair.axis ?? [];
  const length = Math.hypot(dx, dy);
  if (!length) return letter;
  const [ux, uy] = [(dx / length) * 30, (-dy / length) * 30];
  const track = line(
    [
      [x - ux, y - uy],
      [x + ux, y + uy],
    ],
    "track",
  );
  return [track, ...letter];
}

/** Links on a circle and pairs between them. */
function graph(inputs: Inputs, stage: Stage): SVGElement[] {
  const [links, pairs] = [linksOf(inputs), pairsOf(inputs)];
  const centre: Point = [stage.width / 2, (HEIGHT + TOP) / 2];
  const radius = Math.min(stage.width, HEIGHT - TOP) / 2 - MARGIN;
  const place = new Map(
    links.map((link, i) => {
      const angle = (2 * Math.PI * i) / links.length + Math.PI / 2;
      return [link, [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)] as Point];
    }),
  );
  const beside = new Map<string, number>();
  const edges = pairs.flatMap((one) => {
    const [from, to] = [place.get(one.link_a), place.get(one.link_b)];
    if (!from || !to) return [];
    const key = [one.link_a, one.link_b].sort().join("\n");
    const count = beside.get(key) ?? 0;
    beside.set(key, count + 1);
    // Several pairs of the same links run beside each other.
    const off = (count % 2 ? 1 : -1) * Math.ceil(count / 2) * 26;
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
    const [nx, ny] = [(-(to[1] - from[1]) / length) * off, ((to[0] - from[0]) / length) * off];
    const middle: Point = [(from[0] + to[0]) / 2 + nx, (from[1] + to[1]) / 2 + ny];
    const letter = TYPES[spaceOf(inputs)][kindOf(one)] ?? one.type;
    return [line([from, middle, to], "leg-solid"), label([middle[0], middle[1] + 4], letter, "title")];
  });
  const nodes = links.flatMap((link, i) => {
    const [x, y] = place.get(link)!;
    const [dx, dy] = [x - centre[0], y - centre[1]];
    const out = 16 / (Math.hypot(dx, dy) || 1);
    const anchor = Math.abs(dx) < 5 ? "middle" : dx > 0 ? "start" : "end";
    return [
      dot([x, y], `mark curve-${(i % 6) + 1}`, i ? 8 : 11),
      label([x + dx * out, y + dy * out + 4], link, `curve-${(i % 6) + 1} value`, anchor),
    ];
  });
  return [...edges, ...nodes];
}

function mean(points: readonly Point[]): Point {
  const of = (k: 0 | 1) => points.reduce((sum, point) => sum + point[k], 0) / points.length;
  return [of(0), of(1)];
}

function turn([x, y]: Point, [cx, cy]: Point): number {
  return Math.atan2(y - cy, x - cx);
}
