/** The worked solution as lines to show: the service's words and formulas, each with the numbers that belong to it. */

import type { Writing } from "../../state.ts";
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
}

export interface Section {
  title: string;
  text: string;
  lines: Line[];
}

/** Characters of a formula that nobody reads as a whole: it is set when asked for. */
const LONG = 6000;

export const PARTS: readonly { value: Writing["part"]; text: string; titles: readonly string[] }[] = [
  { value: "transforms", text: "DH and Aᵢ", titles: ["Denavit-Hartenberg table", "Transforms between neighbours"] },
  { value: "pose", text: "T⁰ᵢ", titles: ["Position of the tip", "Forward kinematics"] },
  { value: "jacobian", text: "Jacobian", titles: ["Geometric Jacobian"] },
  { value: "singular", text: "Singularities", titles: ["Determinant", "Singular configurations"] },
  { value: "motion", text: "Motion", titles: [] },
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
  const lines = LINES[title]?.(answer, step?.latex ?? []) ?? whole(step?.latex ?? [], title);
  return { title, text: step?.text ?? "", lines };
}

/** Sections whose formulas have numbers; the others are what the service's step says. */
const LINES: Record<string, (answer: DeriveAnswer, latex: string[]) => Line[]> = {
  "Transforms between neighbours": ({ A }, latex) => [
    ...whole(latex.slice(0, 1), "The rule"),
    ...A.map((matrix, i) => line(`A_{${i + 1}}`, matrix, (all) => all.A[i]!)),
  ],
  "Forward kinematics": ({ T_0, T_base_tool }) => {
    const lines = T_0.map((matrix, i) => line(`T^{0}_{${i + 1}}`, matrix, (all) => all.T_0[i]!));
    if (T_base_tool && T_base_tool.latex === T_0.at(-1)?.latex) return lines;
    return [
      ...lines,
      line("T^{\\mathrm{base}}_{\\mathrm{tool}}", T_base_tool ?? unwritten("T_base_tool"), (all) => all.T_base_tool),
    ];
  },
  "Geometric Jacobian": ({ jacobian, joint_names, convention }) => {
    const frame = (i: number) => (convention === "standard" ? i : i + 1);
    const columns = jacobian?.columns ?? [];
    const matrix = line("J", jacobian?.matrix ?? unwritten("J"), (all) => all.jacobian);
    return [
      ...columns.flatMap((column, i) => columnLines(column, frame(i), i)),
      ...(columns.length ? [blocks(columns, frame)] : []),
      ...(joint_names.length ? [{ ...matrix, isLong: (matrix.latex?.length ?? 0) > LONG }] : []),
    ];
  },
  Determinant: ({ determinant }, latex) =>
    determinant && (latex.length || determinant.latex === null)
      ? [
          {
            symbol: latex.length ? "" : "\\det J",
            latex: latex[0] ?? null,
            name: "Determinant",
            numbers: (all) => [[all.determinant ?? NaN]],
          },
        ]
      : [],
  "Singular configurations": ({ singularities }, latex) =>
    latex.map((formula, i) => {
      const { example, example_singular_value: sigma } = singularities[i] ?? {};
      const found: Line = { symbol: "", latex: formula, name: `Singular configuration ${i + 1}` };
      return example
        ? { ...found, example: { positions: example, title: `σ_min = ${sigma?.toExponential(1) ?? "0"}` } }
        : found;
    }),
};

/** J by the names of what stands in its columns. */
function blocks(columns: readonly ColumnFormulas[], frame: (index: number) => number): Line {
  const linear = columns.map(({ arm }, i) => (arm ? `z_{${frame(i)}} \\times p_{${frame(i)},E}` : `z_{${frame(i)}}`));
  const angular = columns.map(({ arm }, i) => (arm ? `z_{${frame(i)}}` : "0"));
  const latex = `\\begin{bmatrix} ${linear.join(" & ")} \\\\ ${angular.join(" & ")} \\end{bmatrix}`;
  return { symbol: "J", latex, name: "J by its columns" };
}

function columnLines({ joint, axis, arm, linear }: ColumnFormulas, frame: number, index: number): Line[] {
  const z = `z_{${frame}}`;
  const column = (values: number[]) => values.map((value) => [value]);
  const first = { ...line(z, axis, (all) => column(all.columns[index]!.axis)), name: `z of ${joint}` };
  if (!arm) return [first];
  const p = `p_{${frame},E}`;
  return [
    first,
    { ...line(p, arm, (all) => column(all.columns[index]!.arm)), name: `p of ${joint}` },
    { ...line(`${z} \\times ${p}`, linear, (all) => column(all.columns[index]!.linear)), name: `z × p of ${joint}` },
  ];
}

function line(symbol: string, { name, latex }: MatrixFormula, numbers: (all: SolutionNumbers) => number[][]): Line {
  return { symbol, latex, name, numbers };
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
