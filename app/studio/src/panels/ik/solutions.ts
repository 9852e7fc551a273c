/** The solutions as a list, to point at and to choose from. */

import { type ShownChain, shownChain } from "../../robot/chain.ts";
import { kindOf } from "../../robot/model.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import type { Direction, InverseResult, InverseSolution } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { column, type Units, withUnit } from "../../ui/quantity.ts";
import { jointHue } from "../../view/colours.ts";
import { errors } from "./errors.ts";
import { distance, distanceText } from "./distance.ts";
import { moved, type Outcome } from "./solver.ts";

const HERE = 1e-6; // rad or m; the robot is in a solution

interface Row {
  solution: InverseSolution;
  host: HTMLButtonElement;
  numbers: HTMLElement;
  distance: HTMLElement;
  facts: HTMLElement;
}

export class SolutionList {
  readonly host = element("ul", { class: "solutions", "aria-label": t("Solutions") });
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
    for (const row of this.#rows) update(row, chain, this.store.value, this.outcome.value.answer!.task);
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
    const about = element("span", { class: "solution-facts" });
    const host = element(
      "button",
      {
        type: "button",
        class: "solution",
        title: t("Move the robot here"),
        "data-tone": solution.in_collision ? "bad" : null,
        onclick: () => this.#choose(solution),
        onpointerenter: point(index),
        onpointerleave: point(null),
        onfocus: point(index),
        onblur: point(null),
      },
      element(
        "span",
        { class: "solution-name" },
        element("span", { class: `solution-mark ${jointHue(index)}`, "aria-hidden": "true" }, String(index + 1)),
        nameOf(solution, index),
      ),
      apart,
      numbers,
      about,
    );
    return { solution, host, numbers, distance: apart, facts: about };
  }

  #choose({ joint_positions }: InverseSolution): void {
    const names = this.outcome.value.answer!.joint_names;
    this.store.set({ positions: moved(this.store.value, names, joint_positions) });
  }
}

function update(row: Row, chain: ShownChain, units: Units, task: readonly Direction[]): void {
  const { solution, host, numbers, distance: cell } = row;
  const apart = distance(chain, solution.joint_positions);
  const isHere = apart < HERE;
  host.setAttribute("aria-current", String(isHere));
  host.dataset["distance"] = String(apart);
  cell.textContent = isHere
    ? t("the robot is here")
    : t("{joints} away", { joints: distanceText(chain.joints, apart, units) });
  const text = facts(solution, task, units);
  if (row.facts.textContent !== text) row.facts.textContent = text;
  numbers.replaceChildren(
    ...solution.joint_positions.map((value, i) => {
      const joint = chain.joints[i];
      const kind = joint ? kindOf(joint) : "number";
      const shown = column(value, kind, units, 3);
      return element("span", { title: joint?.name }, kind === "angle" && units.degrees ? `${shown}°` : shown);
    }),
  );
}

/** The branch where it has one: `shoulder front · elbow up`. */
function nameOf({ branch, free_joints }: InverseSolution, index: number): string {
  const parts = Object.entries(branch ?? {}).map(([part, side]) => `${word(part)} ${word(String(side))}`);
  if (free_joints?.length) parts.push(t("free: {free_joints}", { free_joints: free_joints.join(", ") }));
  return parts.length ? parts.join(" · ") : t("Solution {index}", { index: index + 1 });
}

function facts(solution: InverseSolution, task: readonly Direction[], units: Units): string {
  const { method, iterations, restarts, position_error, orientation_error } = solution;
  const contact = contactOf(solution, units);
  const way = [word(method)];
  if (iterations) way.push(iterations === 1 ? t("1 iteration") : t("{iterations} iterations", { iterations }));
  if (restarts) way.push(restarts === 1 ? t("1 start before") : t("{restarts} starts before", { restarts }));
  return t("{way} · {task} off{contact}", {
    way: way.join(", "),
    task: errors({ position_error, orientation_error }, task, units),
    contact: contact && ` · ${contact}`,
  });
}

/** How far the nearest pair is apart, or how deep it overlaps; nothing where there is no scene. */
function contactOf({ in_collision: isTouching, pair }: InverseSolution, units: Units): string {
  if (!pair) return "";
  const distance = withUnit(column(Math.abs(pair.distance), "length", units, 4), "length", units);
  const names = t("{a} and {b}", { a: pair.a, b: pair.b });
  return isTouching
    ? t("in contact: {names}, by {distance}", { names, distance })
    : t("{distance} between {names}", { distance, names });
}
