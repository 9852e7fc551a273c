/** An exercise: its title, which variant of it, and the variant. */

import { type Api, asProblem, Latest } from "../../api.ts";
import type { ExerciseVariant, Language } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { difficulty, exercises } from "./list.ts";
import { type Part, type Place, seedOf } from "./place.ts";
import { type Texts, TEXTS } from "./texts.ts";
import { pathOf, Work } from "./work.ts";

export class Task implements Part {
  readonly host = element("div");
  #title = element("h2", { class: "exercise-title" });
  #seed: HTMLInputElement;
  #place = element("div");
  #problem = new ProblemView();
  #latest = new Latest();
  #work: Work | null = null;
  #texts: Texts;
  #wanted = 0;

  constructor(
    private readonly api: Api,
    language: Language,
    private readonly go: (change: Partial<Place>) => void,
  ) {
    const texts = (this.#texts = TEXTS[language]);
    this.#seed = element("input", {
      class: "number seed",
      type: "text",
      inputmode: "numeric",
      autocomplete: "off",
      onchange: () => this.#choose(),
    });
    const variant = element("label", { class: "bar" }, element("span", { class: "field" }, texts.variant), this.#seed);
    const next = button(texts.next, () => this.go({ seed: this.#wanted + 1 }));
    const back = button(`← ${texts.back}`, () => go({ task: "" }), { class: "button small back" });
    const bar = element("div", { class: "bar" }, variant, next);
    const head = element("div", { class: "section" }, back, this.#title, bar, this.#problem.host);
    this.host.append(head, this.#place);
  }

  show(place: Place): void {
    this.#wanted = place.seed;
    this.#seed.value = String(place.seed);
    void this.#draw(place);
  }

  close(): void {
    this.#latest.cancel();
    this.#work?.close();
  }

  #choose(): void {
    const seed = seedOf(this.#seed.value);
    if (seed === null) this.#seed.value = String(this.#wanted);
    else this.go({ seed });
  }

  async #draw(place: Place): Promise<void> {
    const { task, seed, language } = place;
    this.close();
    this.#problem.show(null);
    this.#place.replaceChildren(element("p", { class: "section muted", role: "status" }, this.#texts.loading));
    try {
      const [list, variant] = await Promise.all([
        exercises(this.api, language),
        this.#latest.run((signal) => this.api.post<ExerciseVariant>(pathOf(task), { seed, language }, signal)),
      ]);
      if (!variant) return;
      const { title, difficulty: level } = list.find(({ id }) => id === task)!;
      this.#title.replaceChildren(`${title} `, difficulty(level, this.#texts));
      this.#work = new Work(this.api, place, variant, title);
      this.#place.replaceChildren(this.#work.host);
    } catch (error) {
      this.#place.replaceChildren();
      this.#problem.show(asProblem(error));
    }
  }
}
