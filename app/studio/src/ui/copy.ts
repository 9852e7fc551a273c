/** A button that copies a text; `face` is what it says. */

import { button } from "./dom.ts";

export function copyButton(text: () => string, what: string, face = "Copy"): HTMLButtonElement {
  const made = button(face, () => void copy(), {
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
    setTimeout(() => (made.textContent = face), 1500);
  };
  return made;
}
