/** The pose of the tip in every notation of the API. */

import type { Matrix4 } from "three";

import { asPose, FORMATS, IN_RADIANS, position } from "../../robot/pose.ts";
import { t } from "../../texts/index.ts";
import type { PoseFormat } from "../../types.ts";
import { copyButton } from "../../ui/copy.ts";
import { element } from "../../ui/dom.ts";
import { matrixCopies } from "../../ui/matrices.ts";
import { column, type Kind, type Units, unitOf } from "../../ui/quantity.ts";

const DECIMALS = 5;

export class TipPose {
  readonly host: HTMLElement;
  #chain = element("p", { class: "muted" });
  #cells = new Map<PoseFormat | "position", HTMLElement>();
  #T: Matrix4 | null = null;

  constructor() {
    const line = (key: PoseFormat | "position", title: string) => {
      const cell = element("output", { class: "numbers", "data-format": key, "aria-label": title });
      this.#cells.set(key, cell);
      const text = () => JSON.stringify(this.#T && (key === "position" ? position(this.#T) : asPose(this.#T, key)));
      const head = element("dt", {}, title);
      if (key !== "rotation" && key !== "matrix")
        return [head, element("dd", {}, cell), element("dd", { class: "copy" }, copyButton(text, title))];
      const rows = () => this.#T && (asPose(this.#T, key)[key] as number[][]);
      return [head, element("dd", { class: "wide" }, cell, matrixCopies(rows, title))];
    };
    const formats = FORMATS.filter(({ format }) => format !== "rotation" && format !== "matrix");
    const matrices = FORMATS.filter(({ format }) => format === "rotation" || format === "matrix");
    this.host = element(
      "div",
      {},
      this.#chain,
      element(
        "dl",
        { class: "pose" },
        ...line("position", t("Position")),
        ...formats.flatMap(({ format, title }) => line(format, title)),
      ),
      element(
        "details",
        {},
        element("summary", {}, t("As matrices")),
        element("dl", { class: "pose" }, ...matrices.flatMap(({ format, title }) => line(format, title))),
      ),
    );
  }

  /** T_base_tip. The element carries it to the last digit as `data-matrix`. */
  show(T: Matrix4, base: string, tip: string, units: Units): void {
    this.#T = T;
    this.#chain.textContent = t("of {tip} in {base}", { tip, base });
    this.host.dataset["matrix"] = JSON.stringify(asPose(T, "matrix").matrix);
    for (const [key, cell] of this.#cells) cell.replaceChildren(...columns(T, key, units));
  }
}

function columns(T: Matrix4, key: PoseFormat | "position", units: Units): Node[] {
  if (key === "position") return [row(position(T), units, "length")];
  const value = asPose(T, key)[key]!;
  // Of a transform the last column is a length.
  if (Array.isArray(value[0])) return (value as number[][]).map((numbers) => row(numbers, units));
  return [row(value as number[], units, IN_RADIANS.has(key) ? "angle" : "number")];
}

/** @param kind of all the numbers; without one they are a row of a matrix. */
function row(numbers: number[], units: Units, kind?: Kind): HTMLElement {
  const unit = unitOf(kind ?? "number", units);
  const written = (number: number, i: number) =>
    column(number, kind ?? (i === 3 ? "length" : "number"), units, DECIMALS);
  const cells = numbers.map((number, i) => element("span", {}, written(number, i)));
  return element("span", { class: "row" }, ...cells, unit && element("span", { class: "unit" }, unit));
}
