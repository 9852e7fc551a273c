/** The calculators: a list of them, and of the chosen one the form, the picture, the numbers and the solution. */

import { asProblem, Latest, Paced, Problem } from "../../api.ts";
import { prefer } from "../../prefs.ts";
import { t } from "../../texts/index.ts";
import { button, Choice, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { SI, type Units } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import type { Studio } from "../panel.ts";
import { AnswerView } from "./answer.ts";
import type { Calculator, Editor, Inputs, Step } from "./calculator.ts";
import { CALCULATORS } from "./calculators.ts";
import { Form } from "./form.ts";
import { go, type Place, placeOf } from "./place.ts";
import { Stage } from "./stage.ts";

export function open(host: HTMLElement, studio: Studio): () => void {
  const { store } = studio;
  const list = new List((calculator) => go(store, { calculator, inputs: calculator.examples[0]!.inputs }));
  const place = element("div", { class: "course-place" });
  host.append(element("div", { class: "course" }, element("h1", {}, t("Course")), list.host, place));
  let sheet: Sheet | null = null;
  const stop = store.watch(["options", "degrees"], (state) => {
    const { calculator, inputs } = placeOf(state);
    list.show(calculator);
    if (sheet?.calculator !== calculator) {
      sheet?.close();
      sheet = new Sheet(calculator, studio);
      place.replaceChildren(sheet.host);
      host.scrollTop = 0;
    }
    sheet.show(inputs);
  });
  return () => {
    stop();
    sheet?.close();
  };
}

/** The units of the calculators: lengths are in metres, as in the course and in the pictures. */
function angles({ degrees }: Units): Units {
  return { ...SI, degrees };
}

class List {
  readonly host = element("nav", { class: "course-list", "aria-label": t("Calculators") });
  #buttons: Map<Calculator, HTMLButtonElement>;

  constructor(choose: (calculator: Calculator) => void) {
    this.#buttons = new Map(
      CALCULATORS.map((one) => [one, button(one.title, () => choose(one), { class: "course-one" })]),
    );
    this.host.append(...this.#buttons.values());
  }

  show(chosen: Calculator): void {
    for (const [one, made] of this.#buttons) made.setAttribute("aria-current", String(one === chosen));
  }
}

/** A calculator at work. */
class Sheet {
  readonly host: HTMLElement;
  #form: Form;
  #editor: Editor | null;
  #stage: Stage;
  #answer = new AnswerView();
  #problem = new ProblemView();
  #request: RequestView;
  #unit: Choice<"rad" | "deg">;
  #latest = new Latest();
  #paced = new Paced<Inputs>((inputs) => this.#ask(inputs));
  #inputs: Inputs = {};
  #asked = "";
  #shown: { answer: unknown; inputs: Inputs } | null = null;

  constructor(
    readonly calculator: Calculator,
    private readonly studio: Studio,
  ) {
    const { store } = studio;
    const change = (inputs: Inputs) => this.#go({ calculator, inputs });
    this.#request = new RequestView(studio.api);
    this.#form = new Form(() => angles(store.value), change);
    this.#editor = calculator.editor?.(change) ?? null;
    this.#stage = new Stage(
      () => this.#inputs,
      change,
      () => this.#draw(),
      () => angles(store.value),
    );
    this.#unit = new Choice(
      t("Unit of angles"),
      [
        { value: "rad", text: "rad" },
        { value: "deg", text: "deg" },
      ],
      (chosen) => prefer(store, { degrees: chosen === "deg" }),
    );
    this.host = element("div", { class: "course-sheet" }, this.#inputsPart(change), this.#answerPart());
  }

  show(inputs: Inputs): void {
    const { degrees } = this.studio.store.value;
    this.#unit.show(degrees ? "deg" : "rad");
    this.#inputs = inputs;
    const fields = this.calculator.fields(inputs);
    this.#unit.host.hidden = !fields.some(({ kind }) => kind === "angle") && !this.calculator.hasAngles;
    this.#form.show(fields, inputs);
    this.#editor?.show(inputs);
    const asked = JSON.stringify(inputs);
    if (asked !== this.#asked) this.#paced.want(inputs);
    else this.#draw(); // in another unit
    this.#asked = asked;
  }

  close(): void {
    this.#paced.cancel();
    this.#latest.cancel();
    this.#stage.close();
    this.#answer.close();
  }

  #go(place: Place): void {
    go(this.studio.store, place);
    if (JSON.stringify(place.inputs) === this.#asked) this.#draw();
  }

  #inputsPart(change: (inputs: Inputs) => void): HTMLElement {
    const { title, says, page, examples } = this.calculator;
    const link = element("a", { href: `handbook/${page}`, target: "_blank", rel: "noopener" }, t("Its chapter"));
    const shown = examples.map((one) => button(one.title, () => change(one.inputs), { class: "button small" }));
    return element(
      "section",
      { class: "section course-inputs" },
      element("div", { class: "bar" }, element("h2", {}, title), element("span", { class: "spring" }), this.#unit.host),
      element("p", { class: "muted" }, says, " ", link),
      element("div", { class: "bar", role: "group", "aria-label": t("Examples") }, ...shown),
      this.#editor?.host,
      this.#form.host,
      this.#problem.host,
    );
  }

  #answerPart(): HTMLElement {
    const attributes = { class: "section course-result", "aria-label": t("Answer") };
    return element("section", attributes, this.#stage.host, this.#answer.host, this.#request.host);
  }

  async #ask(inputs: Inputs): Promise<void> {
    const { path } = this.calculator;
    const body = { ...inputs, ...this.calculator.beside?.(inputs) };
    try {
      const answer = await this.#latest.run((signal) => this.#request.api.post<unknown>(path, body, signal));
      if (answer === undefined) return;
      this.#fail(null);
      this.#shown = { answer, inputs };
      this.#draw();
    } catch (error) {
      this.#fail(asProblem(error));
    }
  }

  /** The last answer, as wide as there is now room for it. */
  #draw(): void {
    if (!this.#shown) return;
    const { answer, inputs } = this.#shown;
    this.#stage.show(this.calculator.picture(answer, inputs, this.#stage));
    const shown = answer as { steps: Step[]; warnings?: string[] };
    this.#answer.show(this.calculator.facts(answer, inputs), shown, this.studio.store.value.degrees);
  }

  /** What is wrong stands at its field; what has none, below the form. */
  #fail(problem: Problem | null): void {
    this.#form.clear();
    const places = problem?.places ?? [];
    const reason = problem?.facts["reason"]; // without the name of the field, which it stands at
    const unplaced = places.filter(({ pointer, detail }) => {
      const text = typeof reason === "string" ? reason : detail;
      return !this.#editor?.fail(pointer, text) && !this.#form.fail(pointer, text);
    });
    this.#problem.show(problem && (places.length === 0 || unplaced.length) ? problem : null);
    this.host.classList.toggle("outdated", problem !== null);
  }
}
