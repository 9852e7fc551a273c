/** The principal axes of the ellipsoids as bars, and the measures drawn from them. */

import { t } from "../../texts/index.ts";
import type { ManipulabilityAnswer, Part, PartAnswer } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { fixed, rounded, subscript } from "../../ui/quantity.ts";

/** What a lecturer calls each measure, and what it says. */
const MEASURES = [
  { key: "measure", title: t("Yoshikawa w"), hint: t("Manipulability, the product of the σ: √det(JJᵀ)") },
  { key: "condition_number", title: t("Condition κ"), hint: t("The longest σ over the shortest") },
  { key: "rank", title: t("Rank"), hint: t("Directions that the tip has here, of those that it has at all") },
  {
    key: "isotropy",
    title: t("Isotropy 1/κ"),
    hint: t("The shortest σ over the longest: 1 is a sphere, 0 is singular"),
  },
] as const;

export class AxesView {
  readonly host: HTMLElement;
  #rows = element("tbody");
  #velocityUnit = element("span", { class: "unit" });
  #forceUnit = element("span", { class: "unit" });
  #measures = new Map<string, HTMLElement>();
  #nothing = element("p", { class: "muted small", hidden: true }, t("The tip never moves in this way."));
  #table: HTMLElement;

  constructor() {
    this.#table = element(
      "table",
      { class: "axes" },
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          element("th", { scope: "col", colspan: 2 }, t("Axis")),
          element("th", { scope: "col", colspan: 2, class: "velocity" }, t("Velocity "), this.#velocityUnit),
          element("th", { scope: "col", class: "force" }, t("Force "), this.#forceUnit),
        ),
      ),
      this.#rows,
    );
    const facts = MEASURES.map(({ key, title, hint }) => {
      const cell = element("dd", { "data-measure": key });
      this.#measures.set(key, cell);
      return element("div", { title: hint }, element("dt", {}, title), cell);
    });
    this.host = element(
      "div",
      { class: "part" },
      this.#nothing,
      this.#table,
      element("dl", { class: "measures" }, ...facts),
    );
  }

  /** The element carries the semi-axes of the velocity to the last digit as `data-semi-axes`. */
  show(answer: ManipulabilityAnswer, part: Part): void {
    const space = answer.spaces.find((entry) => entry.part === part);
    const found = answer.results[0]![part];
    const isThere = found !== null && space !== undefined && space.dimension > 0;
    this.#nothing.hidden = isThere;
    this.#table.hidden = !isThere;
    this.host.dataset["semiAxes"] = JSON.stringify(found?.velocity_ellipsoid.semi_axes ?? []);
    if (!isThere) {
      for (const cell of this.#measures.values()) cell.textContent = "–";
      delete this.host.dataset["measures"];
      return;
    }
    this.#velocityUnit.textContent = space.velocity_unit;
    this.#forceUnit.textContent = space.force_unit;
    this.#rows.replaceChildren(...found.velocity_ellipsoid.axes.map((axis, i) => row(found, axis, i)));
    const unit = space.measure_unit.replace(/\^(\d)/, (_, digit) => "⁰¹²³⁴⁵⁶"[Number(digit)]!);
    const number = (value: number | null) => (value === null ? t("unbounded") : rounded(value));
    const texts = {
      measure: `${number(found.measure)} ${unit}`,
      condition_number: number(found.condition_number),
      isotropy: number(found.isotropy),
      rank: t("{rank} of {dimension}", { rank: found.rank, dimension: space.dimension }),
    };
    for (const { key } of MEASURES) this.#measures.get(key)!.textContent = texts[key];
    this.host.dataset["measures"] = JSON.stringify(found, ["measure", "condition_number", "isotropy", "rank"]);
  }
}

function row(part: PartAnswer, axis: number[], i: number): HTMLElement {
  const sigma = part.velocity_ellipsoid.semi_axes[i]!;
  const force = part.force_ellipsoid.semi_axes[i]!;
  const longest = part.velocity_ellipsoid.semi_axes[0]!;
  const bar = element("span", { class: "bar-fill" });
  bar.style.width = `${longest > 0 ? (100 * sigma) / longest : 0}%`;
  return element(
    "tr",
    { class: sigma === 0 ? "vanishing" : "" },
    element("th", { scope: "row" }, `σ${subscript(i + 1)}`),
    element("td", { class: "direction" }, ...directions(axis)),
    element("td", { class: "bar-cell" }, element("span", { class: "bar-track" }, bar)),
    element("td", { title: String(sigma) }, rounded(sigma)),
    element("td", { title: String(force) }, force === null ? "∞" : rounded(force)),
  );
}

/** An axis in words of numbers; of a whole twist velocity and angular velocity, each on its line. */
export function directions(axis: number[]): HTMLElement[] {
  const parts = axis.length === 6 ? [axis.slice(0, 3), axis.slice(3)] : [axis];
  return parts.map((numbers, i) =>
    element("span", {}, axis.length === 6 ? `${"vω"[i]} ` : "", `(${numbers.map((x) => fixed(x, 2)).join(", ")})`),
  );
}
