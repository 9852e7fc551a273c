/** A tour of the page, offered and never forced; what leads it is loaded when it begins. */

import "../styles/tour.css";

import type { Studio } from "../panels/panel.ts";
import { t } from "../texts/index.ts";
import { button } from "../ui/dom.ts";

/** The button that begins it. */
export function tourButton(studio: Studio, text: string, look: string): HTMLButtonElement {
  const begin = async () => {
    const { Tour } = await import("./tour.ts");
    if (!document.querySelector(".tour")) new Tour(studio, made);
  };
  const made = button(text, () => void begin(), { class: look, title: t("Six steps, each of them live") });
  return made;
}
