/** The line between picture and panel: dragged, or moved by the arrow keys; a double click or Home puts it back. */

import { prefer } from "./prefs.ts";
import type { State } from "./state.ts";
import type { Store } from "./store.ts";
import { t } from "./texts/index.ts";

const USUAL = 480; // px, as in the style sheet
const LEAST = 360; // px, of the panel and of the picture
const STEP = 24; // px

export function divide(line: HTMLElement, main: HTMLElement, store: Store<State>): void {
  const most = () => Math.max(main.clientWidth - LEAST, LEAST);
  const clamped = (width: number) => Math.round(Math.min(Math.max(width, LEAST), most()));
  const shown = () => clamped(store.value.width ?? USUAL);
  const show = () => {
    const width = shown();
    main.style.setProperty("--panel-width", `${width}px`);
    line.setAttribute("aria-valuemin", String(LEAST));
    line.setAttribute("aria-valuemax", String(most()));
    line.setAttribute("aria-valuenow", String(width));
    line.setAttribute("aria-valuetext", t("Panel {width} pixels wide", { width }));
  };
  let dragged: number | null = null;
  line.addEventListener("pointerdown", (event) => {
    line.setPointerCapture(event.pointerId);
    dragged = event.clientX;
    event.preventDefault();
    line.focus();
  });
  line.addEventListener("pointermove", (event) => {
    if (dragged === null || event.clientX === dragged) return;
    dragged = event.clientX;
    store.set({ width: clamped(main.getBoundingClientRect().right - event.clientX) });
  });
  line.addEventListener("lostpointercapture", () => {
    dragged = null;
    prefer(store, { width: store.value.width });
  });
  line.addEventListener("dblclick", () => prefer(store, { width: null }));
  line.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: STEP, ArrowRight: -STEP }[event.key];
    if (by === undefined && event.key !== "Home") return;
    event.preventDefault();
    prefer(store, { width: by === undefined ? null : clamped(shown() + by) });
  });
  store.watch(["width"], show);
  window.addEventListener("resize", show);
}
