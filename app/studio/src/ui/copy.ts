/** A button that copies a text. */

import { button } from "./dom.ts";

export function copyButton(text: () => string, what: string): HTMLButtonElement {
  const made = button("Copy", () => void copy(), {
    class: "button small",
    title: `Copy ${what}`,
    "aria-label": `Copy ${what}`,
  });
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text());
      made.textContent = "Copied";
    } catch {
      made.textContent = "Not allowed";
    }
    setTimeout(() => (made.textContent = "Copy"), 1500);
  };
  return made;
}
