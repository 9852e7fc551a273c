/** Has the motion planned: the button, how long it has been at it, how to end that, and what is wrong. */

import { asProblem, Latest } from "../../api.ts";
import { t } from "../../texts/index.ts";
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
  #cancel = button(t("Cancel"), () => this.#latest.cancel(), { hidden: true });

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
    this.#plan = button(t("Plan"), () => void press(), { class: "button primary" });
    this.host = element(
      "div",
      { class: "part" },
      element("div", { class: "bar" }, this.#plan, this.#cancel, this.#status),
      this.#problem.host,
    );
  }

  /** Whether there is something to plan, and whether what is shown is of it. */
  update(): void {
    const lacks = missing(this.draft.motion);
    const isBusy = this.#timer !== 0;
    this.#plan.disabled = isBusy || lacks !== null;
    this.#plan.hidden = isBusy;
    this.#cancel.hidden = !isBusy;
    const status = isBusy ? this.#elapsed() : (lacks ?? this.#outdated());
    // A screen reader says what is set, also where that is the same: the arm moves many times a second.
    if (this.#status.textContent !== status) this.#status.textContent = status;
  }

  #elapsed(): string {
    const seconds = Math.floor((performance.now() - this.#begun) / 1000);
    return seconds < 1 ? t("Planning …") : t("Planning … {seconds} s", { seconds });
  }

  /** What has changed since the plan was made; empty where that still holds. */
  #outdated(): string {
    const { motion, chain, store } = this.draft;
    const { plan, scene } = store.value;
    if (!plan) return "";
    if (!isSame(plan.motion, motion)) return t("The motion has changed since it was planned.");
    if (!isSame(plan.scene, scene)) return t("The scene has changed since it was planned.");
    const hasMoved = scene.objects.length > 0 && !isSame(plan.others, chain.others);
    return hasMoved ? t("A joint off the chain has moved since it was planned.") : "";
  }

  /** Ask the service; whether an answer came. */
  async plan(): Promise<boolean> {
    const { motion, chain, store } = this.draft;
    const { scene } = store.value;
    this.#begun = performance.now();
    this.#timer = window.setInterval(() => this.update(), 1000);
    this.update();
    // The polynomials are exact between the samples too.
    const call = { ...request(motion, scene, chain.others), coefficients: true };
    try {
      const answer = await this.#latest.run((signal) =>
        this.asked.api.post<TrajectoryAnswer>(`${chain.path}/trajectory`, call, signal),
      );
      if (!answer) return false;
      this.#problem.show(null);
      this.fail([]);
      store.set({ plan: { motion, scene, others: chain.others, answer } });
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

/** Whether two values say the same; while the arm moves, most are the same object. */
function isSame(a: unknown, b: unknown): boolean {
  return a === b || JSON.stringify(a) === JSON.stringify(b);
}
