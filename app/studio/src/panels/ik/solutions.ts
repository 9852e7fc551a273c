/** The solutions as a list, to point at and to choose from. */

import { type ShownChain, shownChain } from "../../robot/chain.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import type { Direction, InverseResult, InverseSolution } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { fixed } from "../../ui/quantity.ts";
import { errors } from "./errors.ts";
import { distance, unitOfDistance } from "./distance.ts";
import { moved, type Outcome } from "./solver.ts";

const HERE = 1e-6; // rad or m; the robot is in a solution

interface Row {
  solution: InverseSolution;
  host: HTMLButtonElement;
  numbers: HTMLElement;
  distance: HTMLElement;
}

export class SolutionList {
  readonly host = element("ul", { class: "solutions", "aria-label": "Solutions" });
  #rows: Row[] = [];
  #result: InverseResult | null = null;

  constructor(
    private readonly store: Store<State>,
    private readonly outcome: Store<Outcome>,
  ) {}

  show(): void {
    const { result } = this.outcome.value;
    const chain = shownChain(this.store.value);
    if (result !== this.#result) this.#build(result);
    if (!chain) return;
    for (const row of this.#rows) update(row, chain, this.store.value.degrees);
  }

  #build(result: InverseResult | null): void {
    this.#result = result;
    this.#rows = (result?.solutions ?? []).map((solution, index) => this.#row(solution, index));
    this.host.hidden = this.#rows.length === 0;
    this.host.replaceChildren(...this.#rows.map(({ host }) => element("li", {}, host)));
  }

  #row(solution: InverseSolution, index: number): Row {
    const point = (pointed: number | null) => () => this.outcome.set({ pointed });
    const numbers = element("span", { class: "solution-joints" });
    const apart = element("span", { class: "solution-distance" });
    const host = element(
      "button",
      {
        type: "button",
        class: "solution",
        title: "Move the robot here",
        "data-tone": solution.in_collision ? "bad" : null,
        onclick: () => this.#choose(solution),
        onpointerenter: point(index),
        onpointerleave: point(null),
        onfocus: point(index),
        onblur: point(null),
      },
      element("span", { class: "solution-name" }, nameOf(solution, index)),
      apart,
      numbers,
      element("span", { class: "solution-facts" }, facts(solution, this.outcome.value.answer!.task)),
    );
    return { solution, host, numbers, distance: apart };
  }

  #choose({ joint_positions }: InverseSolution): void {
    const names = this.outcome.value.answer!.joint_names;
    this.store.set({ positions: moved(this.store.value, names, joint_positions) });
  }
}

function update({ solution, host, numbers, distance: cell }: Row, chain: ShownChain, degrees: boolean): void {
  const apart = distance(chain, solution.joint_positions);
  const isHere = apart < HERE;
  host.setAttribute("aria-current", String(isHere));
  host.dataset["distance"] = String(apart);
  cell.textContent = isHere ? "the robot is here" : `${fixed(apart, 2)} ${unitOfDistance(chain)} away`;
  numbers.replaceChildren(
    ...solution.joint_positions.map((value, i) => {
      const isLength = chain.joints[i]?.type === "prismatic";
      const shown = isLength || !degrees ? fixed(value, 3) : `${fixed((value * 180) / Math.PI, 1)}°`;
      return element("span", { title: chain.joints[i]?.name }, shown);
    }),
  );
}

/** The branch where it has one: `shoulder front · elbow up`. */
function nameOf({ branch, free_joints }: InverseSolution, index: number): string {
  const parts = Object.entries(branch ?? {}).map(([part, side]) => `${part} ${String(side).replaceAll("_", " ")}`);
  if (free_joints?.length) parts.push(`free: ${free_joints.join(", ")}`);
  return parts.length ? parts.join(" · ") : `Solution ${index + 1}`;
}

function facts(solution: InverseSolution, task: readonly Direction[]): string {
  const { method, iterations, restarts, position_error, orientation_error } = solution;
  const contact = contactOf(solution);
  const way = [method.replaceAll("_", " ")];
  if (iterations) way.push(`${iterations} ${iterations === 1 ? "iteration" : "iterations"}`);
  if (restarts) way.push(`${restarts} ${restarts === 1 ? "start" : "starts"} before`);
  return `${way.join(", ")} · ${errors({ position_error, orientation_error }, task)} off${contact && ` · ${contact}`}`;
}

/** How far the nearest pair is apart, or how deep it overlaps; nothing where there is no scene. */
function contactOf({ in_collision: isTouching, pair }: InverseSolution): string {
  if (!pair) return "";
  const distance = `${fixed(1000 * Math.abs(pair.distance), 1)} mm`;
  const names = `${pair.a} and ${pair.b}`;
  return isTouching ? `in contact: ${names}, by ${distance}` : `${distance} between ${names}`;
}
