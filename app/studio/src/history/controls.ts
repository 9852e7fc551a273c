/** Undo and redo by keys and buttons, and what of it is said. */

import { t } from "../texts/index.ts";
import { button, element } from "../ui/dom.ts";
import { Acts } from "./acts.ts";
import type { Steps } from "./steps.ts";

/** @returns the two buttons. */
export function undoing(steps: Steps, stage: HTMLElement): HTMLElement {
  const acts = new Acts(() => steps.begin());
  const told = element("p", { class: "told", role: "status" });
  stage.append(told);
  const tell = (text: string) => told.replaceChildren(element("span", {}, text));
  const undo = () => {
    const name = steps.undo();
    tell(name === null ? t("There is nothing to undo.") : t("Undone: {name}", { name }));
  };
  const redo = () => {
    const name = steps.redo();
    tell(name === null ? t("There is nothing to redo.") : t("Redone: {name}", { name }));
  };
  const [back, on] = [made(t("Undo"), "↶", undo), made(t("Redo"), "↷", redo)];
  document.addEventListener("keydown", (event) => {
    const wanted = wantedBy(event);
    if (!wanted || event.defaultPrevented || acts.isTyping(event.target)) return;
    if (document.querySelector("dialog[open]") || document.documentElement.hasAttribute("data-starting")) return;
    event.preventDefault();
    if (wanted === "undo") undo();
    else redo();
  });
  steps.offered.watch(["undo", "redo"], (offered) => {
    show(back, offered.undo, t("Undo"), t("Ctrl Z"));
    show(on, offered.redo, t("Redo"), t("Ctrl Shift Z"));
  });
  return element("span", { class: "undoing" }, back, on);
}

/** A button with its word, or where there is little room with a sign. */
function made(word: string, sign: string, react: () => void): HTMLElement {
  const tool = button("", react, { class: "tool undo" });
  tool.append(element("span", { class: "sign" }, sign), element("span", { class: "word" }, word));
  return tool;
}

/** It keeps the focus when there is nothing left to do. */
function show(made: HTMLElement, name: string | null, does: string, keys: string): void {
  made.setAttribute("aria-disabled", String(name === null));
  made.setAttribute("aria-label", name ? `${does}: ${name}` : does);
  made.title = name ? `${does}: ${name} (${keys})` : `${does} (${keys})`;
}

function wantedBy({ key, ctrlKey, metaKey, altKey, shiftKey }: KeyboardEvent): "undo" | "redo" | null {
  if (!(ctrlKey || metaKey) || altKey) return null;
  if (key.toLowerCase() === "z") return shiftKey ? "redo" : "undo";
  return key.toLowerCase() === "y" && !shiftKey && !metaKey ? "redo" : null;
}
