/** Below the solution: whether the numbers agree with the service's, what the symbols stand for, and what was left out. */

import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import { scientific } from "../../ui/quantity.ts";
import type { DeriveAnswer } from "../../types.ts";
import type { Derived } from "./derivation.ts";
import { apart, numbersAt } from "./numbers.ts";

/** Rounding stays far below; anything above is an error of one of the two. */
const TOLERANCE = 1e-9;

export class Remarks {
  readonly host: HTMLElement;
  #check = element("p", { class: "agreement", role: "status" });
  #legend = element("dl", { class: "symbols" });
  #symbols = element("details", {}, element("summary", {}, t("Symbols")), this.#legend);
  #notes = element("ul", { class: "remarks" });
  #shown = "";

  constructor() {
    this.host = element("section", { class: "section", hidden: true }, this.#check, this.#symbols, this.#notes);
  }

  show({ table, answer, positions, key }: Derived): void {
    this.host.hidden = false;
    this.#compare(answer, apart(numbersAt(table, positions, answer.determinant), answer.numeric[0]!));
    if (key === this.#shown) return;
    this.#shown = key;
    const entries = answer.legend.flatMap(({ latex, meaning_latex, value }) => [
      element("dt", {}, formula(latex)),
      element("dd", {}, formula(value === null ? meaning_latex : `${meaning_latex} = ${value}`)),
    ]);
    this.#legend.replaceChildren(...entries);
    this.#symbols.hidden = entries.length === 0;
    this.#notes.replaceChildren(...answer.notes.map((note) => element("li", {}, note)));
    this.#notes.hidden = answer.notes.length === 0;
  }

  #compare({ certificate, numeric_certificate: judged }: DeriveAnswer, difference: number): void {
    const agrees = difference < TOLERANCE;
    const formulas = certificate
      ? t(" The formulas hold at {samples} random configurations, to {max_error}.", {
          samples: certificate.samples,
          max_error: scientific(certificate.max_error),
        })
      : "";
    this.#check.dataset["tone"] = agrees ? "good" : "bad";
    this.#check.dataset["difference"] = String(difference);
    this.#check.textContent =
      (agrees
        ? t("The numbers here and the service's agree: {difference}; ", { difference: scientific(difference) })
        : t("The numbers here and the service's differ: {difference}; ", { difference: scientific(difference) })) +
      t("the service's and Pinocchio's: {max_jacobian_error}.{formulas}", {
        max_jacobian_error: scientific(judged?.max_jacobian_error ?? 0),
        formulas,
      });
  }
}
