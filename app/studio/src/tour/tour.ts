/** Leads through the page: a card with a step at a time, beside what it speaks of. */

import { goTo } from "../address.ts";
import type { Studio } from "../panels/panel.ts";
import { shownChain } from "../robot/chain.ts";
import { t } from "../texts/index.ts";
import { button, element } from "../ui/dom.ts";
import { keepSeen } from "./seen.ts";
import { ROBOT, STEPS } from "./steps.ts";

/** On what a step points at. */
const MARK = "data-toured";

export class Tour {
  #at = 0;
  /** Of the step that is shown. */
  #step = new AbortController();
  #before = location.hash;
  #panel = document.getElementById("panel")!;
  #place = element("span", { class: "muted small" });
  #title = element("h2", { id: "tour-title" });
  #text = element("p");
  #back = button(t("Back"), () => this.#go(this.#at - 1));
  #next = button(t("Next"), () => this.#on(), { class: "button primary" });
  #return = button(t("Back to where I was"), () => this.#close(true), { hidden: true });
  #card: HTMLElement;

  /** @param from the button that has begun it, and that has the focus afterwards. */
  constructor(
    private readonly studio: Studio,
    private readonly from: HTMLElement,
  ) {
    const skip = button(t("Skip"), () => this.#close(), { class: "button", title: t("Leave the tour (Escape)") });
    this.#card = element(
      "section",
      {
        class: "tour",
        role: "dialog",
        "aria-labelledby": "tour-title",
        onkeydown: (event: KeyboardEvent) => this.#key(event),
      },
      element("div", { "aria-live": "polite" }, this.#place, this.#title, this.#text),
      element(
        "div",
        { class: "bar" },
        this.#back,
        this.#next,
        this.#return,
        element("span", { class: "spring" }),
        skip,
      ),
    );
    document.body.append(this.#card);
    keepSeen();
    this.#go(0);
  }

  #on(): void {
    if (this.#at + 1 < STEPS.length) this.#go(this.#at + 1);
    else this.#close();
  }

  #go(at: number): void {
    const step = STEPS[at];
    if (!step) return;
    this.#at = at;
    this.#step.abort();
    const { signal } = (this.#step = new AbortController());
    this.#place.textContent = t("{at} of {length}", { at: at + 1, length: STEPS.length });
    this.#title.textContent = step.title;
    this.#text.textContent = step.text;
    this.#back.setAttribute("aria-disabled", String(at === 0));
    const isLast = at + 1 === STEPS.length;
    this.#next.textContent = isLast ? t("Done") : t("Next");
    this.#return.hidden = !(isLast && this.#before.length > 1);
    void this.#show(at, signal);
    this.#next.focus();
  }

  async #show(at: number, signal: AbortSignal): Promise<void> {
    const { store } = this.studio;
    await this.#robot(signal);
    const chain = shownChain(store.value);
    if (signal.aborted || chain?.model.name !== ROBOT) return;
    const { does, points } = STEPS[at]!;
    const doing = does(store, chain, signal);
    this.#point(points, signal);
    await doing;
    if (!signal.aborted) this.studio.view?.fit();
  }

  /** Have the robot of the tour on the screen, or the reason why it is not. */
  #robot(signal: AbortSignal): Promise<void> {
    const { store } = this.studio;
    if (store.value.robot !== ROBOT || store.value.starting)
      store.set({ starting: false, robot: ROBOT, draft: null, base: null, tip: null, target: null, panel: "robot" });
    this.#next.focus();
    return new Promise((done) => {
      const stop = store.watch(["model", "loading", "failure"], ({ model, loading, failure }) => {
        if (!loading && (failure || model?.name === ROBOT)) done();
      });
      signal.addEventListener("abort", () => {
        stop();
        done();
      });
    });
  }

  /** Mark what comes there, as often as the panel makes it anew, and bring the first into sight. */
  #point(selector: string, signal: AbortSignal): void {
    let marked: HTMLElement | null = null;
    const look = () => {
      if (marked?.isConnected) return;
      const found = [...this.#panel.querySelectorAll<HTMLElement>(selector)].find((place) => place.offsetHeight > 0);
      if (!found) return;
      if (!marked) found.scrollIntoView({ block: "start" });
      marked = found;
      found.setAttribute(MARK, "");
    };
    const observer = new MutationObserver(look);
    observer.observe(this.#panel, { childList: true, subtree: true, attributeFilter: ["hidden"] });
    signal.addEventListener("abort", () => {
      observer.disconnect();
      marked?.removeAttribute(MARK);
    });
    look();
  }

  #key(event: KeyboardEvent): void {
    const does = { ArrowRight: () => this.#on(), ArrowLeft: () => this.#go(this.#at - 1), Escape: () => this.#close() };
    const wanted = does[event.key as keyof typeof does];
    if (!wanted) return;
    event.preventDefault();
    if (event.key === "ArrowRight" && this.#at + 1 === STEPS.length) return; // held too long, it would end it
    wanted();
  }

  /** @param back whether what was on the screen before is to be there again. */
  #close(back = false): void {
    this.#step.abort();
    this.#card.remove();
    this.studio.store.set({ lit: null });
    if (back) goTo(this.#before);
    if (this.from.isConnected && this.from.offsetHeight > 0) this.from.focus();
    else this.#panel.focus();
  }
}
