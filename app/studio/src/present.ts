/** Presenting: large type, only what matters, the whole screen; a presenter's keys step through the panels. */

import { PANELS } from "./panels/index.ts";
import type { State } from "./state.ts";
import type { Store } from "./store.ts";
import { t } from "./texts/index.ts";
import { button, element } from "./ui/dom.ts";

const STEPS: Readonly<Record<string, number>> = { PageDown: 1, PageUp: -1 };

/** @returns the button that begins it. */
export function presenting(stage: HTMLElement, store: Store<State>): HTMLElement {
  const root = document.documentElement;
  const isOn = () => root.dataset["mode"] === "present";
  const title = element("span", { class: "present-title", role: "status" });
  const fold = button(t("Hide panel"), () => showPanel(root.hasAttribute("data-alone")), { title: "H" });
  const showPanel = (wanted: boolean) => {
    root.toggleAttribute("data-alone", !wanted);
    fold.textContent = wanted ? t("Hide panel") : t("Show panel");
  };
  const step = (by: number) => {
    const at = PANELS.findIndex(({ id }) => id === store.value.panel);
    store.set({ panel: PANELS[(at + by + PANELS.length) % PANELS.length]!.id });
  };
  const leave = () => {
    if (!isOn()) return;
    delete root.dataset["mode"];
    showPanel(true);
    bar.hidden = true;
    if (document.fullscreenElement) void document.exitFullscreen();
    begin.focus();
  };
  const enter = () => {
    root.dataset["mode"] = "present";
    bar.hidden = false;
    next.focus();
    root
      .requestFullscreen?.()
      .then(() => (isOn() ? undefined : document.exitFullscreen())) // whoever has left meanwhile
      .catch(() => {}); // a browser that has none presents in its window
  };
  const next = button("›", () => step(1), { title: t("Next (Page Down)"), "aria-label": t("Next panel") });
  const bar = element(
    "div",
    { class: "present-bar", role: "group", "aria-label": t("Presenting"), hidden: true },
    button("‹", () => step(-1), { title: t("Previous (Page Up)"), "aria-label": t("Previous panel") }),
    title,
    next,
    fold,
    button(t("Leave"), leave, { title: t("Escape") }),
  );
  const begin = button(t("Present"), enter, {
    class: "toggle",
    title: t("Large type on the whole screen, for a projector"),
  });
  stage.append(bar);
  store.watch(["panel"], ({ panel }) => (title.textContent = PANELS.find(({ id }) => id === panel)?.title ?? ""));
  store.watch(["starting"], ({ starting }) => {
    if (starting) leave();
  });
  document.addEventListener("fullscreenchange", () => {
    if (!document.fullscreenElement) leave();
  });
  document.addEventListener("keydown", (event) => {
    if (!isOn() || isTaken(event)) return;
    if (event.key === "Escape") leave();
    else if (event.key.toLowerCase() === "h") showPanel(root.hasAttribute("data-alone"));
    else if (STEPS[event.key]) step(STEPS[event.key]!);
    else return;
    event.preventDefault();
  });
  return begin;
}

/** Whether the key belongs to what has the focus, or to what is open in front of the page. */
function isTaken({ target, ctrlKey, altKey, metaKey, defaultPrevented }: KeyboardEvent): boolean {
  const isTyped = target instanceof Element && target.matches("input, select, textarea");
  return (
    ctrlKey ||
    altKey ||
    metaKey ||
    defaultPrevented ||
    isTyped ||
    !!document.querySelector("dialog[open], :popover-open")
  );
}
