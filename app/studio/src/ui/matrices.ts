/** Matrices as text: as the page shows them, and as other programs read them. */

import { t } from "../texts/index.ts";
import { copyButton } from "./copy.ts";
import { element } from "./dom.ts";
import { fixed } from "./quantity.ts";

export type Rows = readonly (readonly number[])[];

const DECIMALS = 4;
const DUST = 1e-14;

/** With four decimals; what is whole but for the dust of rounding as such. */
export function rounded(value: number): string {
  const isWhole = Math.abs(value - Math.round(value)) < DUST;
  return fixed(value, isWhole ? 0 : DECIMALS);
}

/** With the same digits for LaTeX. */
export function matrixLatex(values: Rows): string {
  const lines = values.map((row) => row.map((value) => rounded(value).replace("−", "-")).join(" & "));
  return `\\begin{bmatrix} ${lines.join(" \\\\ ")} \\end{bmatrix}`;
}

/** A matrix to the last digit as other programs read it, and as LaTeX shows it. */
const WRITINGS: Readonly<Record<string, (rows: Rows) => string>> = {
  LaTeX: matrixLatex,
  NumPy: (rows) => `np.array([${rows.map((row) => `[${row.join(", ")}]`).join(", ")}])`,
  MATLAB: (rows) => `[${rows.map((row) => row.join(" ")).join("; ")}]`,
  CSV: (rows) => rows.map((row) => `${row.join(",")}\n`).join(""),
};

/** A matrix as text in one of these forms. */
export function matrixText(rows: Rows, form: string): string {
  return WRITINGS[form]!(rows);
}

/** Buttons that copy a matrix, one for each form; nothing is copied while there is none. */
export function matrixCopies(rows: () => Rows | null, what: string): HTMLElement {
  const made = Object.keys(WRITINGS).map((form) =>
    copyButton(() => matrixText(rows() ?? [], form), t("{what} as {form}", { what, form }), form),
  );
  return element("div", { class: "bar copies" }, element("span", { class: "muted small" }, t("Copy as")), ...made);
}
