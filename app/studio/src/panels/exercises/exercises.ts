/** The exercises' parts: the list, an exercise, the pictures. */

import type { Api } from "../../api.ts";
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

export function open(host: HTMLElement, { api, store }: Studio): () => void {
  const request = new RequestView(api);
  const move = (change: Partial<Place>) => go(store, change);
  const languages = new Choice("Language", LANGUAGES, (language) => move({ language }));
  const head = element("div", { class: "section bar" }, element("span", { class: "spring" }), languages.host);
  const body = element("div", { class: "exercises" }, head);
  host.append(body, request.host);
  let parts: Choice<Place["part"]>;
  let part: Part | null = null;
  let before: Place | null = null;
  const speak = ({ language }: Place) => {
    body.lang = language;
    languages.show(language);
    parts?.host.remove();
    const names = TEXTS[language].parts;
    const options = (["tasks", "pictures"] as const).map((value) => ({ value, text: names[value] }));
    parts = new Choice(TEXTS[language].what, options, (chosen) => move({ part: chosen }));
    head.prepend(parts.host);
  };
  const exchange = (place: Place) => {
    const hadFocus = part?.host.contains(document.activeElement);
    part?.close();
    part?.host.remove();
    part = made(place, before, request.api, move);
    body.append(part.host);
    if (hadFocus) host.focus();
    host.scrollTop = 0;
  };
  const stop = store.watch(["options"], (state) => {
    const place = placeOf(state);
    const isElsewhere = before?.part !== place.part || before.task !== place.task;
    const isInOtherWords = before?.language !== place.language;
    if (isInOtherWords) speak(place);
    if (isElsewhere || isInOtherWords) exchange(place);
    parts.show(place.part);
    part!.show(place);
    before = place;
  });
  return () => {
    stop();
    part?.close();
  };
}

function made(place: Place, before: Place | null, api: Api, move: (change: Partial<Place>) => void): Part {
  const { part, language, task } = place;
  if (part === "pictures") return new Gallery(api, language, TEXTS[language]);
  if (task) return new Task(api, place, move);
  return new List(api, language, move, before?.task ?? "");
}
