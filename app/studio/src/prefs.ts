/** What a person prefers on this device, whatever robot or link is opened: kept by the browser. */

import type { State } from "./state.ts";
import type { Store } from "./store.ts";
import type { Language } from "./types.ts";
import { SI, type Units } from "./ui/quantity.ts";

const NAME = "gelenk.preferences";
const THEMES = ["auto", "light", "dark"] as const;
const LANGUAGES: readonly Language[] = ["en", "de"];

export type Theme = (typeof THEMES)[number];

export interface Prefs extends Units {
  theme: Theme;
  /** Width of the panel beside the picture, [px]; null for the usual one. */
  width: number | null;
  /** Null for that of the browser. */
  language: Language | null;
}

export const USUAL: Prefs = { theme: "auto", ...SI, width: null, language: null };

/** What is kept; the usual where that is nothing, or nothing that makes sense. */
export function preferred(): Prefs {
  return asPrefs(kept());
}

/** A choice of the person at the page: shown now, and kept. A link that says otherwise changes what is shown alone. */
export function prefer(store: Store<State>, choice: Partial<Omit<Prefs, "language">>): void {
  store.set(choice);
  keep(choice);
}

/** Keep a choice for the next visit. */
export function keep(choice: Partial<Prefs>): void {
  try {
    localStorage.setItem(NAME, JSON.stringify({ ...preferred(), ...choice }));
  } catch {
    // A browser that keeps nothing: then it lasts until the page is left.
  }
}

export function asPrefs(given: unknown): Prefs {
  const { theme, millimetres, degrees, width, language } = (
    typeof given === "object" && given !== null ? given : {}
  ) as Partial<Prefs>;
  return {
    theme: asTheme(theme) ?? USUAL.theme,
    millimetres: typeof millimetres === "boolean" ? millimetres : USUAL.millimetres,
    degrees: typeof degrees === "boolean" ? degrees : USUAL.degrees,
    width: typeof width === "number" && width > 0 ? width : USUAL.width,
    language: LANGUAGES.find((one) => one === language) ?? USUAL.language,
  };
}

export function asTheme(given: unknown): Theme | null {
  return THEMES.find((theme) => theme === given) ?? null;
}

function kept(): unknown {
  try {
    return JSON.parse(localStorage.getItem(NAME) ?? "null");
  } catch {
    return null;
  }
}
