/** Has the motion planned: the button, how long it has been at it, how to end that, and what is wrong. */

import { asProblem, Latest } from "../../api.ts";
import { button, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { RequestView } from "../../ui/request.ts";
import type { TrajectoryAnswer } from "../../types.ts";
import type { Draft } from "./draft.ts";
import type { Refused } from "./folded.ts";
import { missing, request } from "./motion.ts";

export class Planner {
  readonly host: HTMLElement;
  #latest = new Latest();
  #timer = 0;
  #begun = 0;
  #status = element("p", { class: "muted small plan-status", role: "status" });
  #problem = new ProblemView();
  #plan: HTMLButtonElement;
  #cancel = button("Cancel", () => this.#latest.cancel(), { hidden: true });

  /**
   * @param fail shows what the service has against fields of the motion, and returns what it has no field for.
   * @param planned is told when a plan that was pressed for is there, and whether the focus has stayed.
   */
  constructor(
    private readonly draft: Draft,
    private readonly asked: RequestView,
    private readonly fail: (places: readonly Refused[]) => readonly Refused[],
    planned: (isFocusFree: boolean) => void,
  ) {
    const press = async () => {
      const answered = this.plan();
      this.#cancel.focus();
      // Whoever has gone to another field meanwhile is left there.
      const isFree = () => document.activeElement === document.body || this.host.contains(document.activeElement);
      if (await answered) planned(isFree());
      else if (isFree()) this.#plan.focus();
    };
    this.#plan = button("Plan", () => void press(), { class: "button primary" });
    this.host = element(
      "div",
      { class: "part" },
      element("div", { class: "bar" }, this.#plan, this.#cancel, this.#status),
      this.#problem.host,
    );
  }

  /** Whether there is something to plan, and whether what is shown is of it. */
  update(): void {
    const { motion, store } = this.draft;
    const lacks = missing(motion);
    const isBusy = this.#timer !== 0;
    this.#plan.disabled = isBusy || lacks !== null;
    this.#plan.hidden = isBusy;
    this.#cancel.hidden = !isBusy;
    const { plan, scene } = store.value;
    if (isBusy) {
      const seconds = Math.floor((performance.now() - this.#begun) / 1000);
      this.#status.textContent = seconds < 1 ? "Planning …" : `Planning … ${seconds} s`;
    } else if (lacks) this.#status.textContent = lacks;
    else if (plan && JSON.stringify(plan.motion) !== JSON.stringify(motion))
      this.#status.textContent = "The motion has changed since it was planned.";
    else if (plan && JSON.stringify(plan.scene) !== JSON.stringify(scene))
      this.#status.textContent = "The scene has changed since it was planned.";
    else this.#status.textContent = "";
  }

  /** Ask the service; whether an answer came. */
  async plan(): Promise<boolean> {
    const { motion, chain, store } = this.draft;
    const { scene } = store.value;
    this.#begun = performance.now();
    this.#timer = window.setInterval(() => this.update(), 1000);
    this.update();
    // The polynomials are exact between the samples too.
    const call = { ...request(motion, scene), coefficients: true };
    try {
      const answer = await this.#latest.run((signal) =>
        this.asked.api.post<TrajectoryAnswer>(`${chain.path}/trajectory`, call, signal),
      );
      if (!answer) return false;
      this.#problem.show(null);
      this.fail([]);
      store.set({ plan: { motion, scene, answer } });
      return true;
    } catch (error) {
      const problem = asProblem(error);
      const elsewhere = this.fail(problem.places);
      this.#problem.show(elsewhere.length || problem.places.length === 0 ? problem : null);
      return false;
    } finally {
      clearInterval(this.#timer);
      this.#timer = 0;
      this.update();
    }
  }

  stop(): void {
    this.#latest.cancel();
  }
}
