/** The exercises of the course, by lectures. */

import { type Api, asProblem } from "../../api.ts";
import type { ExerciseInfo, ExerciseList, Language } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Part, Place } from "./place.ts";
import { type Texts, TEXTS } from "./texts.ts";

const HARDEST = 5;
const rowId = (task: string) => `exercise-${task}`;

const lists = new Map<Language, Promise<readonly ExerciseInfo[]>>();

/** All exercises, with their titles in a language; asked for once. */
export function exercises(api: Api, language: Language): Promise<readonly ExerciseInfo[]> {
  const found = lists.get(language);
  if (found) return found;
  const asked = api.get<ExerciseList>(`v1/course/exercises?language=${language}`).then((list) => list.exercises);
  lists.set(language, asked);
  asked.catch(() => lists.delete(language));
  return asked;
}

/** How hard an exercise is: `●●○○○`. */
export function difficulty(level: number, texts: Texts): HTMLElement {
  const dots = "●".repeat(level) + "○".repeat(HARDEST - level);
  return element(
    "span",
    { class: "difficulty", title: texts.difficulty(level) },
    element("span", { "aria-hidden": "true" }, dots),
    element("span", { class: "unseen" }, texts.difficulty(level)),
  );
}

export class List implements Part {
  readonly host = element("div", { class: "section" });
  #lecture: HTMLSelectElement;
  #groups = element("div", { class: "groups" });
  #problem = new ProblemView();
  #all: readonly ExerciseInfo[] = [];
  #loaded: Promise<void>;

  #texts: Texts;

  /** @param visited the exercise that one comes back from; empty for none. */
  constructor(
    api: Api,
    language: Language,
    private readonly go: (change: Partial<Place>) => void,
    private readonly visited: string,
  ) {
    const texts = (this.#texts = TEXTS[language]);
    this.#lecture = element("select", {
      class: "select",
      "aria-label": texts.lecture,
      onchange: () => go({ lecture: this.#lecture.value }),
    });
    this.host.append(element("div", { class: "bar" }, this.#lecture), this.#problem.host, this.#groups);
    this.#loaded = this.#load(api, language);
  }

  show({ lecture }: Place): void {
    void this.#loaded.then(() => {
      const all = this.#lectures();
      const shown = all.includes(lecture) ? [lecture] : all;
      this.#lecture.value = shown === all ? "" : lecture;
      this.#groups.replaceChildren(...shown.map((one) => this.#group(one)));
      document.getElementById(rowId(this.visited))?.focus();
    });
  }

  close(): void {}

  async #load(api: Api, language: Language): Promise<void> {
    const texts = this.#texts;
    try {
      this.#all = await exercises(api, language);
    } catch (error) {
      this.#problem.show(asProblem(error));
    }
    this.#lecture.replaceChildren(
      element("option", { value: "" }, texts.all),
      ...this.#lectures().map((lecture) => element("option", { value: lecture }, titleOf(lecture, texts))),
    );
  }

  #lectures(): string[] {
    return [...new Set(this.#all.map(({ lecture }) => lecture))];
  }

  #group(lecture: string): HTMLElement {
    const own = this.#all.filter((one) => one.lecture === lecture);
    return element(
      "section",
      {},
      element("h2", {}, titleOf(lecture, this.#texts)),
      element("ul", {}, ...own.map((one) => element("li", {}, this.#row(one)))),
    );
  }

  #row({ id, title, difficulty: level }: ExerciseInfo): HTMLElement {
    const row = button("", () => this.go({ task: id }), { class: "exercise", id: rowId(id) });
    row.append(element("span", {}, title), difficulty(level, this.#texts));
    return row;
  }
}

/** A lecture that a department has added has no title here. */
function titleOf(lecture: string, { lectures }: Texts): string {
  return lectures[lecture] ?? lecture.replaceAll("_", " ");
}
