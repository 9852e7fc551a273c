/** The construction of a DH table, motion by motion, in both conventions beside each other. */

import { Box3, Sphere } from "three";

import type { Api } from "../api.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import type { Convention, DhTable } from "../types.ts";
import { dialog } from "../ui/dialogs.ts";
import { button, element } from "../ui/dom.ts";
import { Build } from "./build.ts";
import type { Room, Sight } from "./drawing.ts";

const BOTH: readonly Convention[] = ["standard", "modified"];
/** How long a motion takes, [ms]. */
const MOTION = 700;
/** A turn of the picture to a pixel, [rad]. */
const TURN = 0.01;
const STILL = matchMedia("(prefers-reduced-motion: reduce)");

/** Show it, until it is closed; the table of the other convention is the service's. */
export async function construct(api: Api, store: Store<State>, dh: DhTable): Promise<void> {
  const tables = await Promise.all(BOTH.map((convention) => inConvention(api, dh, convention)));
  // It may have been asked for twice before the tables came.
  if (document.querySelector("dialog[open]")) return;
  new Construction(tables, store.value);
}

async function inConvention(api: Api, dh: DhTable, convention: Convention): Promise<DhTable> {
  if (dh.convention === convention) return dh;
  return (await api.post<{ dh: DhTable }>("v1/dh/convert", { dh, convention })).dh;
}

class Construction {
  #builds: Build[];
  #last: number;
  #step = 0;
  #sight: Sight = { yaw: -0.6, pitch: 0.45 };
  #room: Room;
  #frame = 0;
  #timer = 0;
  #isPlaying = false;
  #dialog: HTMLDialogElement;
  #play = button(t("Play"), () => this.#flip());
  #place = element("output", { class: "construction-place" });
  #slider: HTMLInputElement;
  #yaw: HTMLInputElement;

  constructor(tables: readonly DhTable[], state: Readonly<State>) {
    const turned = (dx: number, dy: number) => this.#turn(dx * TURN, dy * TURN);
    this.#builds = tables.map((table) => new Build(table, state.positions, state, turned));
    this.#last = this.#builds[0]!.course.screws.length;
    const sphere = new Box3()
      .setFromPoints(this.#builds.flatMap(({ points }) => points))
      .getBoundingSphere(new Sphere());
    this.#room = { centre: sphere.center, radius: sphere.radius || 1 };
    this.#slider = range(t("Step"), 0, this.#last, 1, (value) => this.#go(value));
    this.#yaw = range(t("Turn the pictures"), -Math.PI, Math.PI, 0.05, (value) =>
      this.#turn(value - this.#sight.yaw, 0),
    );
    const controls = element(
      "div",
      { class: "bar" },
      button(t("First"), () => this.#go(0)),
      button(t("Back"), () => this.#go(this.#at - 1)),
      this.#play,
      button(t("Next"), () => this.#go(this.#at + 1), { class: "button primary" }),
      button(t("Last"), () => this.#go(this.#last)),
      this.#slider,
      this.#place,
    );
    this.#dialog = dialog(
      t("Construction of the DH table"),
      () => this.#stop(),
      controls,
      element("div", { class: "construction" }, ...this.#builds.map(({ host }) => host)),
      element(
        "div",
        { class: "bar construction-foot" },
        element("label", { class: "construction-turn" }, element("span", {}, t("Turn the pictures")), this.#yaw),
        element("span", { class: "muted small spring" }, t("Keys: ← → a step, Home and End, Space plays.")),
        button(t("Close"), () => this.#dialog.close()),
      ),
    );
    this.#dialog.classList.add("building");
    this.#dialog.addEventListener("keydown", (event) => this.#key(event));
    this.#show(0);
    this.#play.focus();
  }

  /** The step that is shown, or the one that a motion under way leads to. */
  get #at(): number {
    return Number(this.#slider.value);
  }

  /** To a step: the next ones by their motion, others at once. */
  #go(wanted: number): void {
    this.#stop();
    this.#lead(wanted);
  }

  #lead(wanted: number): void {
    const to = Math.max(0, Math.min(this.#last, wanted));
    const from = this.#step;
    this.#name(to);
    if (Math.abs(to - from) > 1 || STILL.matches) {
      this.#show(to);
      this.#timer = window.setTimeout(() => this.#goOn(), MOTION);
      return;
    }
    const start = performance.now();
    const draw = (now: number) => {
      const share = Math.min(1, Math.max(0, (now - start) / MOTION));
      this.#show(share === 1 ? to : from + (to - from) * share);
      if (share < 1) this.#frame = requestAnimationFrame(draw);
      else this.#goOn();
    };
    this.#frame = requestAnimationFrame(draw);
  }

  #goOn(): void {
    if (!this.#isPlaying) return;
    if (this.#at < this.#last) this.#lead(this.#at + 1);
    else this.#stop();
  }

  #flip(): void {
    if (this.#isPlaying) return this.#stop();
    this.#stop();
    if (this.#at === this.#last) this.#show(0);
    this.#isPlaying = true;
    this.#play.textContent = t("Pause");
    this.#lead(Math.floor(this.#step) + 1);
  }

  #stop(): void {
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#timer);
    this.#isPlaying = false;
    this.#play.textContent = t("Play");
  }

  #turn(yaw: number, pitch: number): void {
    const around = this.#sight.yaw + yaw;
    this.#sight = {
      yaw: Math.atan2(Math.sin(around), Math.cos(around)),
      pitch: Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.#sight.pitch + pitch)),
    };
    this.#show(this.#step);
  }

  #show(step: number): void {
    this.#step = step;
    if (Number.isInteger(step)) this.#name(step);
    this.#yaw.value = String(this.#sight.yaw);
    for (const build of this.#builds) build.show(step, this.#sight, this.#room);
  }

  #name(step: number): void {
    const place = t("Step {step} of {last}", { step, last: this.#last });
    this.#slider.value = String(step);
    this.#slider.setAttribute("aria-valuetext", `${place}. ${this.#builds[0]!.sentence(step)}`);
    if (this.#place.textContent !== place) this.#place.textContent = place;
  }

  #key(event: KeyboardEvent): void {
    const { target } = event;
    const steps: Record<string, number> = {
      ArrowRight: this.#at + 1,
      ArrowLeft: this.#at - 1,
      Home: 0,
      End: this.#last,
    };
    const wanted = steps[event.key];
    const isPressed = event.key === " " && !(target instanceof HTMLButtonElement);
    if (target === this.#yaw || (wanted === undefined && !isPressed)) return;
    event.preventDefault();
    if (isPressed) this.#flip();
    else this.#go(wanted!);
  }
}

function range(name: string, min: number, max: number, step: number, take: (value: number) => void): HTMLInputElement {
  const made = element("input", { type: "range", min, max, step, "aria-label": name });
  made.addEventListener("input", () => take(Number(made.value)));
  return made;
}
