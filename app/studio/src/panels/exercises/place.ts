/** Where in the exercises one is; a link restores it. */

import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { language as usual } from "../../texts/index.ts";
import type { Language } from "../../types.ts";

export interface Place {
  part: "tasks" | "pictures";
  language: Language;
  /** The lecture that is listed; empty for all. */
  lecture: string;
  /** The exercise that is open; empty for the list. */
  task: string;
  seed: number;
}

const PREFIX = "exercises.";
const FIRST_SEED = 1;
const SEED = /^\d{1,15}$/; // the service takes up to 2⁵³ − 1

/** A part of the panel. */
export interface Part {
  host: HTMLElement;
  show(place: Place): void;
  close(): void;
}

/** The seed that is written; null for what is none. */
export function seedOf(text: string): number | null {
  return SEED.test(text.trim()) ? Number(text) : null;
}

export function placeOf({ options }: Readonly<State>): Place {
  const given = (name: keyof Place) => options[PREFIX + name] ?? "";
  return {
    part: given("part") === "pictures" ? "pictures" : "tasks",
    language: (["en", "de"] as const).find((one) => one === given("language")) ?? usual,
    lecture: given("lecture"),
    task: given("task"),
    seed: seedOf(given("seed")) ?? FIRST_SEED,
  };
}

/** Go to another place; its link names the language, whatever that of the reader's browser is. */
export function go(store: Store<State>, change: Partial<Place>): void {
  const { part, language, lecture, task, seed } = { ...placeOf(store.value), ...change };
  const named = { part: part === "tasks" ? "" : part, language, lecture, task, seed: task && String(seed) };
  const others = Object.entries(store.value.options).filter(([option]) => !option.startsWith(PREFIX));
  const own = Object.entries(named).filter(([, value]) => value !== "");
  store.set({ options: Object.fromEntries([...others, ...own.map(([name, value]) => [PREFIX + name, value])]) });
}
