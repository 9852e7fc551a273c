/** What a calculator answers, as numbers, remarks, and the worked solution. */

import { t } from "../../texts/index.ts";
import { element, reaching } from "../../ui/dom.ts";
import { matrixLatex, type Rows } from "../../ui/matrices.ts";
import { formula } from "../../ui/mathematics.ts";
import type { Fact, Step } from "./calculator.ts";
import { short } from "./chart.ts";

/** Part of the largest number of a list that is only rounding. */
const DUST = 1e-14;

export class AnswerView {
  readonly host = element("div", { class: "course-answer" });
  #facts = element("dl", { class: "facts course-facts" });
  #remarks = element("ul", { class: "remarks" });
  #steps = element("ol", { class: "steps" });
  #solution: HTMLDetailsElement;
  #shown: readonly Step[] = [];
  #watch = reaching();
  #wide = reaching();

  constructor() {
    const summary = element("summary", {}, t("Worked solution"));
    this.#solution = element("details", { ontoggle: () => this.#write() }, summary, this.#steps);
    this.host.append(this.#facts, this.#remarks, this.#solution);
  }

  show(
    facts: readonly Fact[],
    answer: { steps: readonly Step[]; warnings?: readonly string[] },
    degrees: boolean,
  ): void {
    this.#facts.replaceChildren(...facts.flatMap((fact) => row(degrees ? inDegrees(fact) : fact)));
    this.#wide.disconnect();
    for (const value of this.#facts.querySelectorAll("dd:has(.formula)")) this.#wide.observe(value);
    this.#remarks.replaceChildren(...(answer.warnings ?? []).map((text) => element("li", {}, text)));
    this.#remarks.hidden = !answer.warnings?.length;
    this.#shown = answer.steps;
    this.#write();
  }

  close(): void {
    this.#watch.disconnect();
    this.#wide.disconnect();
  }

  #write(): void {
    if (!this.#solution.open) return;
    this.#watch.disconnect();
    this.#steps.replaceChildren(
      ...this.#shown.map(({ title, text, latex }) => {
        const lines = latex.map((one, i) => {
          const attributes = { class: "wide", role: "group", "aria-label": `${title}, ${i + 1}` };
          const region = element("div", attributes, formula(one));
          this.#watch.observe(region);
          return region;
        });
        return element("li", {}, element("strong", {}, title), element("p", {}, text), ...lines);
      }),
    );
  }
}

function row({ label, value, unit = "" }: Fact): HTMLElement[] {
  return [element("dt", {}, label), element("dd", {}, readable(value), unit && ` ${unit}`)];
}

function inDegrees(fact: Fact): Fact {
  const { value, unit } = fact;
  if (unit !== "rad" || typeof value === "string") return fact;
  const turned = (one: number) => (one * 180) / Math.PI;
  return { ...fact, value: typeof value === "number" ? turned(value) : (value as number[]).map(turned), unit: "°" };
}

function readable(value: Fact["value"]): Node | string {
  if (typeof value === "string") return value;
  if (typeof value === "number") return short(value);
  if (value.length && Array.isArray(value[0])) return formula(matrixLatex(value as Rows));
  const numbers = value as readonly number[];
  const dust = DUST * Math.max(...numbers.map(Math.abs));
  return `(${numbers.map((one) => short(Math.abs(one) < dust ? 0 : one)).join(", ")})`;
}
