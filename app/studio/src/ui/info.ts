/** The "i" beside a term: what it means, in one sentence, and where the handbook says more. */

import { t } from "../texts/index.ts";
import { element } from "./dom.ts";
import { TERMS } from "./terms.ts";

const GAP = 6; // px
/** By the title as it stands on the page. */
const EXPLAINED = new Map(Object.entries(TERMS).map(([title, term]) => [t(title), term]));

/** The button for a title or label; null for one that needs no explanation. */
export function info(title: string): HTMLElement | null {
  const term = EXPLAINED.get(title);
  if (!term) return null;
  const link = element("a", { href: `handbook/${term.page}`, target: "_blank", rel: "noopener" }, t("Handbook"));
  const bubble = element("div", { class: "info-bubble", popover: "auto" }, element("p", {}, term.text), link);
  const made = element(
    "button",
    { type: "button", class: "info", "aria-label": t("What is: {title}", { title }) },
    "i",
  );
  made.popoverTargetElement = bubble;
  bubble.addEventListener("toggle", () => {
    if (bubble.matches(":popover-open")) beside(made, bubble);
  });
  return element("span", { class: "info-place" }, made, bubble);
}

/** Below what it explains, within the window. */
function beside(made: HTMLElement, bubble: HTMLElement): void {
  const { left, bottom, top } = made.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = bubble;
  const below = bottom + GAP + height <= window.innerHeight;
  bubble.style.left = `${Math.max(GAP, Math.min(left, window.innerWidth - width - GAP))}px`;
  bubble.style.top = `${below ? bottom + GAP : Math.max(GAP, top - GAP - height)}px`;
}
