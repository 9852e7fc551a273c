/** The exercises' parts: the list, an exercise, the pictures. */

import { t } from "../../texts/index.ts";
import type { Language } from "../../types.ts";
import { Choice, element } from "../../ui/dom.ts";
import { RequestView } from "../../ui/request.ts";
import type { Studio } from "../panel.ts";
import { Gallery } from "./gallery.ts";
import { List } from "./list.ts";
import { go, type Part, type Place, placeOf } from "./place.ts";
import { Task } from "./task.ts";
import { TEXTS } from "./texts.ts";

const LANGUAGES: readonly { value: Language; text: string }[] = [
  { value: "en", text: "English" },
  { value: "de", text: "Deutsch" },
];

export function open(host: HTMLElement, studio: Studio): () => void {
  const request = new RequestView(studio.api);
  const parts = new Parts(host, { ...studio, api: request.api });
  host.append(parts.host, request.host);
  const stop = studio.store.watch(["options"], (state) => parts.show(placeOf(state)));
  return () => {
    stop();
    parts.close();
  };
}

/** One part at a time, below what chooses part and language. */
class Parts {
  readonly host: HTMLElement;
  #head: HTMLElement;
  #languages: Choice<Language>;
  /** On a narrow page, which has no picture of the robot with its name. */
  #title = element("h1");
  #names: Choice<Place["part"]> | null = null;
  #part: Part | null = null;
  #place: Place | null = null;

  /** @param panel scrolls, and takes the focus of a part that goes. */
  constructor(
    private readonly panel: HTMLElement,
    private readonly studio: Studio,
  ) {
    this.#languages = new Choice(t("Language"), LANGUAGES, (language) => this.#go({ language }));
    const spring = element("span", { class: "spring" });
    this.#head = element("div", { class: "section bar" }, spring, this.#languages.host);
    this.host = element("div", { class: "exercises" }, this.#title, this.#head);
  }

  show(place: Place): void {
    const { language, part, task } = place;
    const before = this.#place;
    if (before?.language !== language) this.#speak(language);
    if (before?.language !== language || before.part !== part || before.task !== task) this.#exchange(place);
    this.#names!.show(part);
    this.#part!.show(place);
    this.#place = place;
  }

  close(): void {
    this.#part?.close();
  }

  #go(change: Partial<Place>): void {
    go(this.studio.store, change);
  }

  #speak(language: Language): void {
    const { parts, what } = TEXTS[language];
    const options = (["tasks", "pictures"] as const).map((value) => ({ value, text: parts[value] }));
    this.#title.textContent = parts.tasks;
    this.#names?.host.remove();
    this.#names = new Choice(what, options, (part) => this.#go({ part }));
    this.#head.prepend(this.#names.host);
    this.#languages.show(language);
    this.host.lang = language;
  }

  #exchange(place: Place): void {
    const hadFocus = this.#part?.host.contains(document.activeElement);
    this.close();
    this.#part?.host.remove();
    this.#part = this.#made(place);
    this.host.append(this.#part.host);
    if (hadFocus) this.panel.focus();
    this.panel.scrollTop = 0;
  }

  #made(place: Place): Part {
    const { part, language, task } = place;
    const { api } = this.studio;
    const move = (change: Partial<Place>) => this.#go(change);
    if (part === "pictures") return new Gallery(api, language, TEXTS[language]);
    return task ? new Task(api, language, move) : new List(api, language, move, this.#place?.task ?? "");
  }
}
