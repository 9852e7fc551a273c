/** The derivation of an exercise, one step at a time: what it does, then its formulas for whoever opens them. */

import type { ExerciseSolution } from "../../types.ts";
import { button, element, reaching } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import type { Texts } from "./texts.ts";

type Step = ExerciseSolution["steps"][number];

export class Steps {
  readonly host: HTMLElement;
  #list = element("ol", { class: "steps" });
  #denied: HTMLElement;
  #next: HTMLButtonElement;
  #watch = reaching();

  /**
   * @param titles of the steps, which everybody may see.
   * @param solve gives the solution; null where there is none to be had.
   * @param more is told that another step is wanted.
   */
  constructor(
    private readonly titles: readonly string[],
    private readonly texts: Texts,
    private readonly solve: () => Promise<ExerciseSolution | null>,
    more: () => void,
  ) {
    this.#next = button("", more);
    this.#denied = element("p", { class: "muted small", role: "status" });
    const head = element("div", { class: "bar" }, element("h2", { class: "spring" }, texts.hints), this.#next);
    this.host = element("section", { class: "section", tabindex: "-1" }, head, this.#list, this.#denied);
    this.show(0);
  }

  /** Show so many steps; with their formulas where all is to be seen. */
  show(count: number, isOpen = false): void {
    const { titles, texts } = this;
    for (let index = this.#list.children.length; index < count; index += 1)
      this.#list.append(this.#step(index, isOpen));
    if (isOpen) for (const one of this.#list.querySelectorAll("details")) one.open = true;
    this.#next.textContent = texts.hint(Math.min(count + 1, titles.length), titles.length);
    this.#next.disabled = count >= titles.length;
  }

  /** Say that the solution is not for everybody. */
  deny(): void {
    this.#denied.textContent = this.texts.denied;
  }

  close(): void {
    this.#watch.disconnect();
  }

  #step(index: number, isOpen: boolean): HTMLElement {
    const host = element("li", {}, element("strong", {}, this.titles[index]!));
    void this.solve().then((solution) => {
      const step = solution?.steps[index];
      if (step) host.append(element("p", {}, step.text), ...(step.latex.length ? [this.#formulas(step, isOpen)] : []));
    });
    return host;
  }

  #formulas({ title, latex }: Step, isOpen: boolean): HTMLElement {
    const lines = latex.map((_, i) => {
      const region = element("div", { class: "wide", role: "group", "aria-label": `${title}, ${i + 1}` });
      this.#watch.observe(region);
      return region;
    });
    const set = () => lines.forEach((line, i) => line.childElementCount || line.append(formula(latex[i]!)));
    const summary = element("summary", {}, this.texts.formulas);
    return element("details", { open: isOpen, ontoggle: set }, summary, ...lines);
  }
}
