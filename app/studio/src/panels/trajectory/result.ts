/** What came of a plan: the player, the audit, and the motion in the picture. */

import { element } from "../../ui/dom.ts";
import type { Plan } from "./answer.ts";
import { Curve } from "./curve.ts";
import type { Draft } from "./draft.ts";
import { belongs } from "./motion.ts";
import { Player } from "./player.ts";
import { type MotionMarks, tipPath } from "./scene.ts";
import { auditTable, failureBox, percent } from "./verdict.ts";

export class Result {
  readonly host: HTMLElement;
  #plan: Plan | null = null;
  #degrees = false;
  #curve: Curve | null = null;
  #player = new Player((time) => this.#move(time));
  #title = element("h2");
  #body = element("div", { class: "part" });

  constructor(
    private readonly draft: Draft,
    private readonly marks: MotionMarks | null,
  ) {
    this.host = element("section", { class: "section", hidden: true }, this.#title, this.#player.host, this.#body);
  }

  /** The plan of the chain on the screen, if there is one. */
  update(): void {
    const { store, chain } = this.draft;
    const { plan } = store.value;
    const shown = plan && belongs(plan.motion, chain) ? plan : null;
    this.host.hidden = shown === null;
    const isOther = shown !== this.#plan;
    if (isOther) {
      this.#plan = shown;
      this.#curve = shown && new Curve(shown.answer);
      this.#player.load(this.#curve?.duration ?? 0);
      this.draw();
    }
    if (isOther || store.value.degrees !== this.#degrees) this.#tell();
    this.#degrees = store.value.degrees;
  }

  /** The way of the tip, in the colours of the page. */
  draw(): void {
    const { chain, store } = this.draft;
    const failure = this.#plan?.answer.failure ?? null;
    this.marks?.showWay(this.#curve && tipPath(chain, this.#curve), failure, store.value.unit);
  }

  /** The robot goes to the beginning. */
  begin(): void {
    this.#player.seek(0);
  }

  stop(): void {
    this.#player.pause();
  }

  #tell(): void {
    if (!this.#plan) return this.#body.replaceChildren();
    const { answer } = this.#plan;
    const { chain, degrees } = this.draft;
    const go = (time: number) => this.#player.seek(time);
    const done = answer.completed_fraction < 1 ? `, ${percent(answer.completed_fraction)} of it` : "";
    this.#title.textContent = `Motion of ${answer.duration.toFixed(3)} s${done}`;
    const failure = failureBox(answer, go);
    const notes = [
      ...answer.notes,
      ...answer.segments.flatMap(({ index, notes }) => notes.map((note) => `Segment ${index + 1}: ${note}`)),
    ];
    this.#body.replaceChildren(
      ...(failure ? [failure] : []),
      auditTable(answer, chain.joints, degrees, go),
      ...(notes.length ? [remarks(notes)] : []),
    );
  }

  #move(time: number): void {
    this.draft.goTo(this.#curve!.at(time));
  }
}

function remarks(notes: string[]): HTMLElement {
  return element(
    "details",
    {},
    element("summary", {}, `Notes (${notes.length})`),
    element("ul", { class: "remarks" }, ...notes.map((note) => element("li", {}, note))),
  );
}
