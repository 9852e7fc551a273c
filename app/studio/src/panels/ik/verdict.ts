/** What became of the target: how many solutions there are, or why there is none and what comes nearest. */

import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { InverseResult } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { shownChain } from "../../robot/chain.ts";
import { findsAll, fullOptions } from "./call.ts";
import { distance } from "./distance.ts";
import { errors } from "./errors.ts";
import { MOST_GHOSTS } from "./picture.ts";
import { moved, type Outcome, type Solver } from "./solver.ts";

const TITLES: Record<Exclude<InverseResult["status"], "solved">, string> = {
  unreachable: t("Out of reach"),
  outside_limits: t("Only outside the limits of the joints"),
  singular: t("Stuck at a singularity"),
  not_converged: t("Not converged"),
  in_collision: t("Only in contact"),
};
const THERE = 1e-6; // rad or m; the robot is in the nearest configuration
const BUSY_AFTER = 200; // ms; what is quicker needs no word

export class Verdict {
  readonly host: HTMLElement;
  #summary = element("p", { class: "verdict-summary", role: "status" });
  #failure = element("div", { class: "verdict-failure", hidden: true });
  #cancel: HTMLButtonElement;
  /** Whether the robot is where the box would have it move; null without such a place. */
  #place: (() => void) | null = null;
  #timer = 0;

  constructor(
    private readonly store: Store<State>,
    private readonly solver: Solver,
  ) {
    this.#cancel = button(t("Cancel"), () => solver.cancel(), { class: "button small", hidden: true });
    this.host = element(
      "div",
      { class: "verdict" },
      element("div", { class: "bar" }, this.#summary, this.#cancel),
      this.#failure,
    );
  }

  show(): void {
    const outcome = this.solver.outcome.value;
    clearTimeout(this.#timer);
    if (outcome.isBusy && !outcome.isFollowing) {
      this.#timer = window.setTimeout(() => this.#wait(), BUSY_AFTER);
      return;
    }
    this.#cancel.hidden = true;
    this.#summary.textContent = summary(outcome);
    const { result } = outcome;
    const hasFailed = result !== null && result.status !== "solved";
    this.#failure.hidden = !hasFailed;
    this.#failure.replaceChildren(...(hasFailed ? this.#explain(result) : []));
  }

  /** The robot has moved: it may be in the nearest configuration by now, or no more. */
  follow(): void {
    this.#place?.();
  }

  close(): void {
    clearTimeout(this.#timer);
  }

  #wait(): void {
    this.#summary.textContent = t("Solving …");
    this.#cancel.hidden = false;
  }

  #explain(result: InverseResult): HTMLElement[] {
    const { nearest, reason } = result;
    this.#place = null;
    const parts = [element("strong", {}, TITLES[result.status as keyof typeof TITLES])];
    if (reason) parts.push(element("p", {}, `${reason[0]!.toUpperCase()}${reason.slice(1)}.`));
    if (nearest) parts.push(this.#nearest(nearest));
    return parts;
  }

  /** The way to the configuration that comes nearest, until the robot is there. */
  #nearest(nearest: NonNullable<InverseResult["nearest"]>): HTMLElement {
    const { joint_names: names, task } = this.solver.outcome.value.answer!;
    const { joint_positions: wanted } = nearest;
    const move = () => this.store.set({ positions: moved(this.store.value, names, wanted) });
    const go = button("", move, { class: "button" });
    this.#place = () => {
      const chain = shownChain(this.store.value);
      if (!chain) return;
      const isThere = distance(chain, wanted) < THERE;
      // A method from one start says where it stopped: others come nearer.
      const isNearest = findsAll(fullOptions(this.store.value.inverse, chain.joints.length).method);
      const place = isNearest ? t("Move to nearest") : t("Move to where it stopped");
      go.textContent = isThere ? t("The robot is there") : place;
      go.setAttribute("aria-disabled", String(isThere));
    };
    this.#place();
    return element(
      "div",
      { class: "bar" },
      go,
      element("span", { class: "small" }, t("{nearest} off", { nearest: errors(nearest, task, this.store.value) })),
    );
  }
}

function summary({ result, answer, isCancelled, isFollowing }: Outcome): string {
  if (isCancelled) return t("Cancelled.");
  if (!result || result.status !== "solved") return "";
  const count = result.solutions.length;
  const parts: string[] = [];
  if (result.complete === true)
    parts.push(count === 1 ? t("1 solution, the only one.") : t("{count} solutions: these are all.", { count }));
  else if (result.families?.length) parts.push(t("Infinitely many solutions, of which {count} are listed.", { count }));
  else if (result.complete === false)
    parts.push(
      count === 1 ? t("1 solution; there may be more.") : t("{count} solutions; there may be more.", { count }),
    );
  else parts.push(t("Solved."));
  const touching = result.solutions.filter(({ in_collision: isTouching }) => isTouching).length;
  if (touching) parts.push(t("In contact: {touching} of them.", { touching }));
  if (count > MOST_GHOSTS)
    parts.push(t("The first {MOST_GHOSTS} are in the picture, and any that you point at.", { MOST_GHOSTS }));
  if (answer?.closed_form && !isFollowing)
    parts.push(t("Closed form: {closed_form}.", { closed_form: answer.closed_form }));
  return parts.join(" ");
}
