/** A variant at work: its text, the fields to answer, what they earn, hints and the solution. */

import { type Api, asProblem, Latest } from "../../api.ts";
import type { ExerciseGrade, ExerciseSolution, ExerciseVariant } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { imageOf } from "../../ui/drawing.ts";
import { ProblemView } from "../../ui/problem.ts";
import { emptyGrid, type Grid } from "./answer.ts";
import { FieldView } from "./field.ts";
import type { Place } from "./place.ts";
import { Steps } from "./steps.ts";
import { type Texts, TEXTS } from "./texts.ts";

const FORBIDDEN = 403;

/** What somebody has done with a variant: it is there again after a look at another panel, or in the other language. */
interface Draft {
  grids: Record<string, Grid>;
  hints: number;
  isChecked: boolean;
  isSolved: boolean;
}
const drafts = new Map<string, Draft>();

export function pathOf(task: string): string {
  return `v1/course/exercises/${encodeURIComponent(task)}`;
}

export class Work {
  readonly host: HTMLElement;
  #texts: Texts;
  #draft: Draft;
  #fields: FieldView[];
  #steps: Steps;
  #grades = new Latest();
  #status = element("strong", { role: "status" });
  #reveal: HTMLButtonElement;
  #problem = new ProblemView();
  #solution: Promise<ExerciseSolution | null> | null = null;

  constructor(
    private readonly api: Api,
    private readonly place: Place,
    private readonly variant: ExerciseVariant,
    title: string,
  ) {
    const texts = (this.#texts = TEXTS[place.language]);
    this.#draft = draftOf(place);
    this.#fields = variant.fields.map((field) => {
      const grid = (this.#draft.grids[field.name] ??= emptyGrid(field));
      return new FieldView(field, grid, texts, (value) => this.#number(value));
    });
    this.#steps = new Steps(
      variant.hints,
      texts,
      () => this.#solve(),
      () => this.#hint(),
    );
    this.#reveal = button(texts.show, () => void this.#show(), { hidden: true });
    const image = variant.picture && imageOf(variant.picture, texts.picture(title));
    const prose = element("div", { class: "section prose" }, ...paragraphs(variant.text), image || null);
    this.host = element("div", {}, prose, this.#form(), this.#steps.host);
    this.#resume();
  }

  close(): void {
    this.#grades.cancel();
    this.#steps.close();
  }

  get #question() {
    const { seed, language } = this.place;
    return { seed, language };
  }

  #form(): HTMLElement {
    const check = element("button", { type: "submit", class: "button primary" }, this.#texts.check);
    return element(
      "form",
      { class: "section", onsubmit: (event: Event) => this.#submit(event) },
      element("p", { class: "muted small" }, this.#texts.numbers),
      ...this.#fields.map(({ host }) => host),
      element("div", { class: "bar" }, check, this.#reveal, this.#status),
      this.#problem.host,
    );
  }

  #number(value: number): string {
    return value.toLocaleString(this.place.language, { maximumFractionDigits: 2 });
  }

  #resume(): void {
    const { hints, isChecked, isSolved } = this.#draft;
    this.#steps.show(hints);
    if (isChecked) void this.#check();
    if (isSolved) void this.#show();
  }

  #submit(event: Event): void {
    event.preventDefault();
    void this.#check();
  }

  async #check(): Promise<void> {
    const given = this.#fields.map(({ field, answer }) => [field.name, answer] as const);
    const answers = Object.fromEntries(given.filter(([, answer]) => answer !== undefined));
    const call = { ...this.#question, answers };
    this.#problem.show(null);
    try {
      const path = `${pathOf(this.place.task)}/grade`;
      const grade = await this.#grades.run((signal) => this.api.post<ExerciseGrade>(path, call, signal));
      if (grade) this.#graded(grade);
    } catch (error) {
      this.#problem.show(asProblem(error));
    }
  }

  #graded({ fields, points, max_points }: ExerciseGrade): void {
    this.#draft.isChecked = true;
    for (const [i, field] of this.#fields.entries()) field.grade(fields[i]!);
    this.#status.textContent = this.#texts.points(this.#number(points), this.#number(max_points));
    this.#reveal.hidden = this.#draft.isSolved;
  }

  #hint(): void {
    this.#draft.hints += 1;
    this.#steps.show(this.#draft.hints);
  }

  async #show(): Promise<void> {
    const solution = await this.#solve();
    if (!solution) return;
    this.#draft.isSolved = true;
    this.#draft.hints = this.variant.hints.length;
    if (document.activeElement === this.#reveal) this.#steps.host.focus({ preventScroll: true });
    this.#reveal.hidden = true;
    for (const field of this.#fields) field.solve(solution.answers[field.field.name]);
    this.#steps.show(this.#draft.hints, true);
  }

  /** The solution, asked for once; null where the key may not see it, which is said, or something else is wrong. */
  #solve(): Promise<ExerciseSolution | null> {
    this.#solution ??= this.api
      .post<ExerciseSolution>(`${pathOf(this.place.task)}/solution`, this.#question)
      .catch((error: unknown) => {
        const found = asProblem(error);
        if (found.status === FORBIDDEN) {
          this.#steps.deny();
        } else {
          this.#problem.show(found);
          this.#solution = null; // another time it may be there
        }
        return null;
      });
    return this.#solution;
  }
}

function draftOf({ task, seed }: Place): Draft {
  const key = `${task} ${seed}`;
  const draft = drafts.get(key) ?? { grids: {}, hints: 0, isChecked: false, isSolved: false };
  drafts.set(key, draft);
  return draft;
}

function paragraphs(text: string): HTMLElement[] {
  return text.split(/\n\s*\n/).map((paragraph) => element("p", {}, paragraph));
}
