/** The worked solution as lines to show: the service's words and formulas, each with the numbers that belong to it. */

import type { Writing } from "../../state.ts";
import { t } from "../../texts/index.ts";
import type { ColumnFormulas, DeriveAnswer, MatrixFormula, SolutionNumbers } from "../../types.ts";

/** A formula on a line of its own. */
export interface Line {
  /** What stands left of the equals sign, in LaTeX; empty where the formula is whole. */
  symbol: string;
  /** Null where there are only numbers. */
  latex: string | null;
  /** Whether it is set only when somebody wants to see it. */
  isLong?: boolean;
  /** What a screen reader calls it. */
  name: string;
  /** The same in numbers. */
  numbers?: (all: SolutionNumbers) => number[][];
  /** A configuration worth going to, with what it is. */
  example?: { positions: number[]; title: string };
  /** The row of the table whose link or joint it belongs to. */
  row?: number | undefined;
  /** Whether it is a matrix with a column for each joint, or a table with a row for each below its head. */
  each?: "column" | "row";
}

export interface Section {
  title: string;
  text: string;
  lines: Line[];
}

/** Characters of a formula that nobody reads as a whole: it is set when asked for. */
const LONG = 6000;

export const PARTS: readonly { value: Writing["part"]; text: string; titles: readonly string[] }[] = [
  {
    value: "transforms",
    text: t("DH and Aᵢ"),
    titles: [t("Denavit-Hartenberg table"), t("Transforms between neighbours")],
  },
  { value: "pose", text: "T⁰ᵢ", titles: [t("Position of the tip"), t("Forward kinematics")] },
  { value: "jacobian", text: t("Jacobian"), titles: [t("Geometric Jacobian")] },
  { value: "singular", text: t("Singularities"), titles: [t("Determinant"), t("Singular configurations")] },
  { value: "motion", text: t("Motion"), titles: [] },
];

/** The sections of a part; the last part has what belongs to no other. */
export function sections(answer: DeriveAnswer, part: Writing["part"]): Section[] {
  const others = new Set(PARTS.flatMap(({ titles }) => titles));
  const own = PARTS.find(({ value }) => value === part)!.titles;
  const titles = own.length ? own : answer.steps.map(({ title }) => title).filter((title) => !others.has(title));
  return titles.map((title) => section(answer, title)).filter(({ text, lines }) => text !== "" || lines.length > 0);
}

function section(answer: DeriveAnswer, title: string): Section {
  const step = answer.steps.find((one) => one.title === title);
  const lines = BY_TITLE.get(title)?.(answer, step?.latex ?? []) ?? whole(step?.latex ?? [], title);
  return { title, text: step?.text ?? "", lines };
}

/** Sections whose formulas have numbers; the others are what the service's step says. */
const LINES: Record<string, (answer: DeriveAnswer, latex: string[]) => Line[]> = {
  "Denavit-Hartenberg table": (_, latex) =>
    whole(latex, t("Denavit-Hartenberg table")).map((table) => ({ ...table, each: "row" })),
  "Transforms between neighbours": ({ A }, latex) => [
    ...whole(latex.slice(0, 1), t("The rule")),
    ...A.map((matrix, i) => line(`A_{${i + 1}}`, matrix, (all) => all.A[i]!, i)),
  ],
  "Forward kinematics": ({ T_0, T_base_tool }) => {
    const lines = T_0.map((matrix, i) => line(`T^{0}_{${i + 1}}`, matrix, (all) => all.T_0[i]!, i));
    if (T_base_tool && T_base_tool.latex === T_0.at(-1)?.latex) return lines;
    return [
      ...lines,
      line("T^{\\mathrm{base}}_{\\mathrm{tool}}", T_base_tool ?? unwritten("T_base_tool"), (all) => all.T_base_tool),
    ];
  },
  "Geometric Jacobian": ({ jacobian, joint_names, convention }) => {
    const frame = (i: number) => (convention === "standard" ? i : i + 1);
    const columns = jacobian?.columns ?? [];
    const matrix: Line = line("J", jacobian?.matrix ?? unwritten("J"), (all) => all.jacobian);
    return [
      ...columns.flatMap((column, i) => columnLines(column, frame(i), i)),
      ...(columns.length ? [blocks(columns, frame)] : []),
      ...(joint_names.length
        ? [{ ...matrix, isLong: (matrix.latex?.length ?? 0) > LONG, each: "column" as const }]
        : []),
    ];
  },
  Determinant: ({ determinant }, latex) =>
    determinant && (latex.length || determinant.latex === null)
      ? [
          {
            symbol: latex.length ? "" : "\\det J",
            latex: latex[0] ?? null,
            name: t("Determinant"),
            numbers: (all) => [[all.determinant ?? NaN]],
          },
        ]
      : [],
  "Singular configurations": ({ singularities }, latex) =>
    latex.map((formula, i) => {
      const { example, example_singular_value: sigma } = singularities[i] ?? {};
      const found: Line = { symbol: "", latex: formula, name: t("Singular configuration {i}", { i: i + 1 }) };
      return example
        ? { ...found, example: { positions: example, title: `σ_min = ${sigma?.toExponential(1) ?? "0"}` } }
        : found;
    }),
};

/** By the title as the service writes it in the language of the page, where its texts and the page's agree. */
const BY_TITLE = new Map(Object.entries(LINES).map(([title, lines]) => [t(title), lines]));

/** J by the names of what stands in its columns. */
function blocks(columns: readonly ColumnFormulas[], frame: (index: number) => number): Line {
  const linear = columns.map(({ arm }, i) => (arm ? `z_{${frame(i)}} \\times p_{${frame(i)},E}` : `z_{${frame(i)}}`));
  const angular = columns.map(({ arm }, i) => (arm ? `z_{${frame(i)}}` : "0"));
  const latex = `\\begin{bmatrix} ${linear.join(" & ")} \\\\ ${angular.join(" & ")} \\end{bmatrix}`;
  return { symbol: "J", latex, name: t("J by its columns"), each: "column" };
}

function columnLines({ joint, axis, arm, linear }: ColumnFormulas, frame: number, index: number): Line[] {
  const z = `z_{${frame}}`;
  const column = (values: number[]) => values.map((value) => [value]);
  const first = {
    ...line(z, axis, (all) => column(all.columns[index]!.axis), index),
    name: t("z of {joint}", { joint }),
  };
  if (!arm) return [first];
  const p = `p_{${frame},E}`;
  return [
    first,
    { ...line(p, arm, (all) => column(all.columns[index]!.arm), index), name: t("p of {joint}", { joint }) },
    {
      ...line(`${z} \\times ${p}`, linear, (all) => column(all.columns[index]!.linear), index),
      name: t("z × p of {joint}", { joint }),
    },
  ];
}

function line(
  symbol: string,
  { name, latex }: MatrixFormula,
  numbers: NonNullable<Line["numbers"]>,
  row?: number,
): Line {
  return { symbol, latex, name, numbers, row };
}

/** Formulas as the service wrote them, with both of their sides. */
function whole(latex: readonly string[], name: string): Line[] {
  return latex.map((formula, i) => ({
    symbol: "",
    latex: formula,
    name: latex.length > 1 ? `${name}, ${i + 1}` : name,
  }));
}

function unwritten(name: string): MatrixFormula {
  return { name, latex: null };
}
