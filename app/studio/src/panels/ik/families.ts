/** Families of solutions: each as a slider that takes the robot along it, while ghosts show the whole of it. */

import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { InverseResult, SolutionFamily } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { moved, type Outcome } from "./solver.ts";

export class FamilyList {
  readonly host = element("ul", {
    class: "solutions families",
    "aria-label": t("Families of solutions"),
    hidden: true,
  });
  #result: InverseResult | null = null;

  constructor(
    private readonly store: Store<State>,
    private readonly outcome: Store<Outcome>,
  ) {}

  show(): void {
    const { result } = this.outcome.value;
    if (result === this.#result) return;
    this.#result = result;
    const families = result?.families ?? [];
    this.host.hidden = families.length === 0;
    this.host.replaceChildren(...families.map((family, index) => this.#row(family, index)));
  }

  #row({ text, sweep }: SolutionFamily, index: number): HTMLElement {
    const show = (swept: number | null) => () => this.outcome.set({ swept });
    const slider = element("input", {
      type: "range",
      min: 0,
      max: sweep.length - 1,
      step: 1,
      value: 0,
      "aria-label": t("Go along: {text}", { text }),
      oninput: () => this.#go(sweep[Number(slider.value)]!),
      onfocus: show(index),
      onblur: show(null),
    });
    return element(
      "li",
      { class: "family", onpointerenter: show(index), onpointerleave: show(null) },
      element("span", { class: "solution-name", title: text }, text),
      slider,
    );
  }

  #go(q: readonly number[]): void {
    this.store.set({ positions: moved(this.store.value, this.outcome.value.answer!.joint_names, q) });
  }
}
