/** Plays a motion: at a speed, over and over, or wherever the slider is put. */

import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { fixed } from "../../ui/quantity.ts";

const SPEEDS = [0.25, 0.5, 1, 2];
const STEPS = 100;

export class Player {
  readonly host: HTMLElement;
  #duration = 0;
  #time = 0;
  #speed = 1;
  #isLooping = false;
  #frame = 0;
  #play = button(t("Play"), () => (this.#frame ? this.pause() : this.#start()), { class: "button play" });
  #slider: HTMLInputElement;
  #clock = element("output", { class: "clock", "aria-label": t("Time") });

  /** @param reached is told of every time that is played or gone to, [s]. */
  constructor(private readonly reached: (time: number) => void) {
    this.#slider = element("input", {
      type: "range",
      min: 0,
      max: 0,
      step: "any",
      "aria-label": t("Time in the motion"),
      oninput: () => this.seek(Number(this.#slider.value)),
      onkeydown: (event: KeyboardEvent) => this.#key(event),
    });
    const speed = element(
      "select",
      { class: "select", "aria-label": t("Speed"), onchange: () => (this.#speed = Number(speed.value)) },
      ...SPEEDS.map((value) => element("option", { value, selected: value === 1 }, `${value}×`)),
    );
    const loop = button(t("Loop"), () => (this.#isLooping = flip(loop)), { class: "toggle", "aria-pressed": "false" });
    this.host = element(
      "div",
      { class: "player" },
      this.#play,
      element("span", { class: "slide" }, this.#slider),
      this.#clock,
      speed,
      loop,
    );
  }

  get time(): number {
    return this.#time;
  }

  /** Another motion, from its beginning; nobody is told of it. */
  load(duration: number): void {
    this.pause();
    this.#duration = duration;
    this.#slider.max = String(duration);
    this.#show(0);
  }

  /** Go to a time, and stay there. */
  seek(time: number): void {
    this.pause();
    this.#reach(time);
  }

  pause(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#play.textContent = t("Play");
  }

  #start(): void {
    if (this.#time >= this.#duration) this.#time = 0;
    this.#play.textContent = t("Pause");
    let before = performance.now();
    const step = (now: number) => {
      this.#frame = requestAnimationFrame(step);
      const next = this.#time + (Math.max(0, now - before) / 1000) * this.#speed;
      before = now;
      if (next < this.#duration) return this.#reach(next);
      if (this.#isLooping && this.#duration > 0) return this.#reach(next % this.#duration);
      this.pause();
      this.#reach(this.#duration);
    };
    this.#frame = requestAnimationFrame(step);
  }

  #reach(time: number): void {
    this.#show(Math.max(0, Math.min(this.#duration, time)));
    this.reached(this.#time);
  }

  #show(time: number): void {
    this.#time = time;
    this.#slider.value = String(time);
    this.#clock.textContent = `${fixed(time, 2)} / ${fixed(this.#duration, 2)} s`;
  }

  /** By a hundredth, and the space bar plays: a slider without steps would leave the keys to the browser. */
  #key(event: KeyboardEvent): void {
    if (event.key === " ") {
      event.preventDefault();
      this.#play.click();
      return;
    }
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    this.seek(this.#time + (by * this.#duration) / STEPS);
  }
}

function flip(toggle: HTMLButtonElement): boolean {
  const isOn = toggle.getAttribute("aria-pressed") !== "true";
  toggle.setAttribute("aria-pressed", String(isOn));
  return isOn;
}
