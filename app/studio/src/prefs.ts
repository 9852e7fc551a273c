/** What a person prefers on this device, whatever robot or link is opened: kept by the browser. */

import type { State } from "./state.ts";
import type { Store } from "./store.ts";

const NAME = "gelenk.preferences";
const THEMES = ["auto", "light", "dark"] as const;

export type Theme = (typeof THEMES)[number];

export interface Prefs {
  theme: Theme;
  /** Whether angles are shown and typed in degrees; calls are always in radians. */
  degrees: boolean;
  /** Width of the panel beside the picture, [px]; null for the usual one. */
  width: number | null;
}

export const USUAL: Prefs = { theme: "auto", degrees: false, width: null };

/** What is kept; the usual where that is nothing, or nothing that makes sense. */
export function preferred(): Prefs {
  return asPrefs(kept());
}

/** A choice of the person at the page: shown now, and kept. A link that says otherwise changes what is shown alone. */
export function prefer(store: Store<State>, choice: Partial<Prefs>): void {
  store.set(choice);
  try {
    localStorage.setItem(NAME, JSON.stringify({ ...preferred(), ...choice }));
  } catch {
    // A browser that keeps nothing: then it lasts until the page is left.
  }
}

export function asPrefs(given: unknown): Prefs {
  const { theme, degrees, width } = (typeof given === "object" && given !== null ? given : {}) as Partial<Prefs>;
  return {
    theme: asTheme(theme) ?? USUAL.theme,
    degrees: typeof degrees === "boolean" ? degrees : USUAL.degrees,
    width: typeof width === "number" && width > 0 ? width : USUAL.width,
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
