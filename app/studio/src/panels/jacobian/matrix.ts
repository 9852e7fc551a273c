/** The Jacobian as a table: each column belongs to a joint, and is marked together with it. */

import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { JacobianAnswer, Representation } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { matrixCopies } from "../../ui/matrices.ts";
import { fixed, rounded, subscript } from "../../ui/quantity.ts";
import { jointHue } from "../../view/colours.ts";
import type { Form } from "./choices.ts";

const LINEAR = ["vx", "vy", "vz"];
const ANGULAR: Record<Representation, string[]> = {
  geometric: ["ωx", "ωy", "ωz"],
  zyz: ["φ̇", "ϑ̇", "ψ̇"],
  rpy: ["roll", "pitch", "yaw"],
};

export class MatrixView {
  readonly host = element("div", { class: "jacobian" });
  #summary = element("p", { class: "muted small" });
  #scroll = element("div", {
    class: "jacobian-scroll",
    tabindex: "0",
    role: "region",
    "aria-label": t("The Jacobian"),
  });
  #names: string[] = [];
  #cells: HTMLElement[][] = [];
  #columns: HTMLElement[][] = [];

  /** @param visit is told the joint whose column was chosen. */
  constructor(
    private readonly store: Store<State>,
    private readonly visit: (joint: string) => void,
  ) {
    const rows = () => JSON.parse(this.host.dataset["jacobian"] ?? "[]") as number[][];
    this.host.append(this.#scroll, matrixCopies(rows, t("the Jacobian")), this.#summary);
  }

  /** The element carries the matrix to the last digit as `data-jacobian`. */
  show(answer: JacobianAnswer, { representation, hint }: Form): void {
    const J = answer.jacobians[0]!;
    if (answer.joint_names.join() !== this.#names.join() || !this.#cells.length) this.#build(answer.joint_names);
    for (const [i, head] of [...this.#scroll.querySelectorAll("tbody th")].entries())
      head.textContent = [...LINEAR, ...ANGULAR[representation]][i]!;
    for (const [i, row] of this.#cells.entries())
      for (const [j, cell] of row.entries()) cell.textContent = fixed(J[i]![j]!, 3);
    this.host.dataset["jacobian"] = JSON.stringify(J);
    const condition = answer.condition_numbers[0];
    const full = Math.min(6, answer.joint_names.length);
    this.#summary.textContent = t(
      "{hint} Rank {ranks} of {full}; condition number {condition}, metres and radians mixed. Pinocchio differs by {max_error} at most.",
      {
        hint,
        ranks: answer.ranks[0],
        full,
        condition: condition == null ? t("unbounded") : rounded(condition),
        max_error: rounded(answer.certificate.max_error),
      },
    );
    this.mark();
  }

  /** Nothing to show: what was there before would be another configuration's. */
  clear(): void {
    for (const cell of this.#cells.flat()) cell.textContent = "·";
    delete this.host.dataset["jacobian"];
    this.#summary.textContent = "";
  }

  /** Mark the column of the joint that the pointer or the focus is on. */
  mark(): void {
    const { joint } = this.store.value;
    for (const [j, column] of this.#columns.entries())
      for (const cell of column) cell.classList.toggle("marked", this.#names[j] === joint);
  }

  #build(names: string[]): void {
    this.#names = names;
    const heads = names.map((name, j) => this.#head(name, j));
    this.#cells = [0, 1, 2, 3, 4, 5].map(() => names.map((name) => element("td", this.#pointing(name))));
    this.#columns = heads.map((head, j) => [head, ...this.#cells.map((row) => row[j]!)]);
    this.#scroll.replaceChildren(
      element(
        "table",
        {},
        element("thead", {}, element("tr", {}, element("td"), ...heads)),
        element(
          "tbody",
          {},
          ...this.#cells.map((row, i) =>
            element("tr", { class: i === 3 ? "angular" : "" }, element("th", { scope: "row" }), ...row),
          ),
        ),
      ),
    );
  }

  #head(name: string, j: number): HTMLElement {
    const point = this.#pointing(name);
    const text = `q${subscript(j + 1)}`;
    return element(
      "th",
      { scope: "col", ...point },
      element(
        "button",
        {
          type: "button",
          class: `column tinted ${jointHue(j)}`,
          title: t("{name}: go to its slider", { name }),
          "aria-label": t("{text}, {name}: go to its slider", { text, name }),
          onfocus: point.onpointerenter,
          onblur: point.onpointerleave,
          onclick: () => this.visit(name),
        },
        text,
      ),
    );
  }

  #pointing(name: string) {
    return {
      onpointerenter: () => this.store.set({ joint: name }),
      onpointerleave: () => this.store.set({ joint: null }),
    };
  }
}
