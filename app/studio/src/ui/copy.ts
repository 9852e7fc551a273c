/** A button that copies a text; `face` is what it says. */

import { t } from "../texts/index.ts";
import { button } from "./dom.ts";

export function copyButton(text: () => string, what: string, face = t("Copy")): HTMLButtonElement {
  const made = button(face, () => void copy(), {
    class: "button small",
    title: t("Copy {what}", { what }),
    "aria-label": t("Copy {what}", { what }),
  });
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text());
      made.textContent = t("Copied");
    } catch {
      made.textContent = t("Not allowed");
    }
    setTimeout(() => (made.textContent = face), 1500);
  };
  return made;
}
