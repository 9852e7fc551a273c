/** Triangles, from three of their parts. */

import { t } from "../../texts/index.ts";
import type { TriangleAnswer, TriangleRequest } from "../../types.ts";
import type { Calculator, Field, Picture, Point } from "./calculator.ts";
import { short } from "./chart.ts";
import { Plane, type Stage } from "./stage.ts";
import { dot, label, line, polygon } from "./svg.ts";

type Triangle = TriangleAnswer["triangles"][number];

const HEIGHT = 360;
const MARGIN = 52;
const RADIUS = 30;
/** About that wide is a letter, [px]. */
const LETTER = 7.5;
const SIDES = ["a", "b", "c"] as const;
const ANGLES = ["alpha", "beta", "gamma"] as const;
const GREEK = { alpha: "α", beta: "β", gamma: "γ" };

export const triangle: Calculator<TriangleRequest, TriangleAnswer> = {
  id: "triangle",
  title: t("Triangle"),
  says: t("A triangle from three of its six parts, one of them a side: the calculation behind every elbow."),
  path: "v1/course/triangle",
  page: "course/inverse-kinematics.html#the-triangle-alone",
  examples: [
    { title: t("Two sides, the angle between"), inputs: { a: 3, b: 4, gamma: Math.PI / 3 } },
    { title: t("Three sides"), inputs: { a: 3, b: 4, c: 5 } },
    { title: t("Two sides, another angle"), inputs: { a: 3, b: 4, alpha: Math.PI / 4 } },
    { title: t("A side, two angles"), inputs: { c: 2, alpha: Math.PI / 3, beta: Math.PI / 4 } },
  ],
  fields: () => [
    ...SIDES.map((name): Field => ({
      pointer: name,
      label: t("Side {name}", { name }),
      kind: "length",
      optional: true,
      step: 0.1,
    })),
    ...ANGLES.map((name): Field => ({
      pointer: name,
      label: t("Angle {GREEK}", { GREEK: GREEK[name] }),
      kind: "angle",
      optional: true,
      step: Math.PI / 180,
    })),
  ],
  facts: ({ case: given, triangles }) => [
    { label: t("Given"), value: given },
    ...triangles.flatMap((one, i) => {
      const which = triangles.length > 1 ? t(", triangle {i}", { i: i + 1 }) : "";
      return [
        { label: `a, b, c${which}`, value: SIDES.map((name) => one[name]), unit: "m" },
        { label: `α, β, γ${which}`, value: ANGLES.map((name) => one[name]), unit: "rad" },
        { label: t("Area{which}", { which }), value: one.area, unit: "m²" },
      ];
    }),
  ],
  picture: ({ triangles }, inputs, stage) => {
    const width = stage.width / triangles.length;
    const all = triangles.flatMap(({ corners }) => corners as unknown as Point[]);
    return {
      nodes: triangles.flatMap((one, i) => {
        const box = { x: i * width + MARGIN, y: MARGIN, width: width - 2 * MARGIN, height: HEIGHT - 2 * MARGIN };
        return drawn(one, inputs, new Plane(all, box), stage);
      }),
      height: HEIGHT,
      name: triangles
        .map((one) => t("Sides {SIDES} m", { SIDES: SIDES.map((name) => short(one[name], 4)).join(", ") }))
        .join("; "),
    } satisfies Picture;
  },
};

/** What is given stands bold. */
function drawn(one: Triangle, inputs: TriangleRequest, plane: Plane, stage: Stage): SVGElement[] {
  const corners = one.corners.map((corner) => plane.to(corner as unknown as Point)) as [Point, Point, Point];
  const centre: Point = [0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k]!, 0) / 3) as unknown as Point;
  const kind = (name: keyof TriangleRequest) => (inputs[name] == null ? "value" : "title");
  const sides = SIDES.map((name, i) => {
    const [from, to] = [corners[(i + 1) % 3]!, corners[(i + 2) % 3]!];
    const at = away([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2], centre, name === "c" ? 40 : 22); // c below the angles
    return inside(at, `${name} = ${short(one[name], 4)}`, kind(name), stage);
  });
  const angles = ANGLES.flatMap((name, i) => {
    const corner = corners[i]!;
    return [
      line(arc(corner, corners[(i + 1) % 3]!, corners[(i + 2) % 3]!), `curve-${i + 2}`),
      inside(
        [corner[0], corner[1] + (corner[1] > centre[1] ? 20 : -12)],
        `${GREEK[name]} = ${stage.angle(one[name])}`,
        kind(name),
        stage,
      ),
      label(away(corner, centre, -RADIUS - 14), "ABC"[i]!, "tick"),
    ];
  });
  return [polygon(corners, "surface"), ...corners.map((corner) => dot(corner, "mark")), ...sides, ...angles];
}

/** A label that is not cut off at the picture's edges. */
function inside([x, y]: Point, text: string, kind: string, stage: Stage): SVGElement {
  const half = (text.length * LETTER) / 2 + 2;
  return label([Math.min(Math.max(x, half), stage.width - half), y], text, kind);
}

function away(from: Point, centre: Point, by: number): Point {
  const [dx, dy] = [from[0] - centre[0], from[1] - centre[1]];
  const length = Math.hypot(dx, dy) || 1;
  return [from[0] + (dx / length) * by, from[1] + (dy / length) * by + 4];
}

/** From one leg of an angle to the other. */
function arc(corner: Point, one: Point, other: Point): Point[] {
  const towards = (point: Point) => Math.atan2(point[1] - corner[1], point[0] - corner[0]);
  const from = towards(one);
  const turn = Math.atan2(Math.sin(towards(other) - from), Math.cos(towards(other) - from));
  return Array.from({ length: 25 }, (_, i) => {
    const angle = from + (turn * i) / 24;
    return [corner[0] + RADIUS * Math.cos(angle), corner[1] + RADIUS * Math.sin(angle)] as const;
  });
}
