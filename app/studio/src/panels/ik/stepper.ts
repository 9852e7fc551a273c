/** Walks along iterations: play, step, scrub. */

import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";

const TICK = 120; // ms
/** The part of the way so far that a tick adds: five thousand steps are played in ten seconds too. */
const HASTE = 0.08;

export class Stepper {
  readonly host: HTMLElement;
  #slider: HTMLInputElement;
  #play: HTMLButtonElement;
  #count = element("output", { class: "stepper-count" });
  #last = 0;
  #at = 0;
  #timer = 0;

  /** @param show is told the iteration that is to be shown. */
  constructor(private readonly show: (index: number) => void) {
    this.#slider = element("input", {
      type: "range",
      min: 0,
      step: 1,
      "aria-label": t("Iteration"),
      oninput: () => this.go(Number(this.#slider.value)),
    });
    this.#play = button(t("Play"), () => (this.#timer ? this.pause() : this.#start()), { class: "button" });
    this.host = element(
      "div",
      { class: "stepper slide" },
      this.#play,
      button("−", () => this.go(this.#at - 1), { class: "button", "aria-label": t("− one iteration") }),
      button("+", () => this.go(this.#at + 1), { class: "button", "aria-label": t("+ one iteration") }),
      this.#slider,
      this.#count,
    );
  }

  /** Start anew, with so many steps. */
  load(last: number): void {
    this.pause();
    this.#last = last;
    this.#slider.max = String(last);
    this.#put(0);
  }

  /** Stop, and show an iteration. */
  go(index: number): void {
    this.pause();
    this.#put(index);
  }

  pause(): void {
    clearInterval(this.#timer);
    this.#timer = 0;
    this.#play.textContent = t("Play");
  }

  #start(): void {
    if (this.#at >= this.#last) this.#put(0);
    this.#play.textContent = t("Pause");
    this.#timer = window.setInterval(() => {
      this.#put(this.#at + Math.max(1, Math.round(this.#at * HASTE)));
      if (this.#at >= this.#last) this.pause();
    }, TICK);
  }

  #put(index: number): void {
    this.#at = Math.max(0, Math.min(this.#last, index));
    this.#slider.value = String(this.#at);
    this.#count.textContent = t("{at} of {last}", { at: this.#at, last: this.#last });
    this.show(this.#at);
  }
}
