/** What people read, in their language: English stands in the sources, and is the key to the German in `de.json`. */

import { preferred } from "../prefs.ts";
import type { Language } from "../types.ts";

type Values = Readonly<Record<string, unknown>>;

/** A number as the page writes it: with a point, and perhaps a unit behind it. */
const NUMBER = /^([-−]?\d+)\.(\d+(?:e[-+]?\d+)?(?:\s\S+)?)$/;

/** As chosen at the page, or else that of the browser; another one takes a reload. */
export const language: Language = preferred().language ?? ofBrowser();

// Modules that use it wait, so that their tables of texts are in the language as well.
const texts: Readonly<Record<string, string>> = language === "de" ? await german() : {};

/**
 * A text in the language of the page; in English where it has no other.
 *
 * @param text a whole sentence as far as possible, constant, with `{name}` for each value.
 * @param values numbers get the decimal mark of the language. Fields, matrices and lists of numbers keep the point.
 */
export function t(text: string, values: Values = {}): string {
  const found = texts[text] || text;
  return found.replace(/\{(\w+)\}/g, (whole, name: string) =>
    Object.hasOwn(values, name) ? written(String(values[name])) : whole,
  );
}

/** A title within a sentence: in English in lower case, while German nouns keep their capital. */
export function within(title: string): string {
  return language === "en" ? title.toLowerCase() : title;
}

/** Put what the page has before its script runs into the language: names for screen readers, and `data-text`. */
export function translatePage(): void {
  document.documentElement.lang = language;
  for (const named of document.querySelectorAll("[aria-label]")) named.ariaLabel = t(named.ariaLabel!);
  for (const marked of document.querySelectorAll("[data-text]")) marked.textContent = t(marked.textContent);
}

function written(value: string): string {
  return language === "en" ? value : value.replace(NUMBER, "$1,$2");
}

/** English where there is none, as in a test without a page. */
function ofBrowser(): Language {
  return globalThis.navigator?.language.startsWith("de") ? "de" : "en";
}

async function german(): Promise<Readonly<Record<string, string>>> {
  try {
    return (await import("./de.json")).default;
  } catch {
    return {}; // the service has gone since it sent the page, which then works in English
  }
}
