/** One answer of an exercise: cells to type in, or words to choose from; what it earned, and what is right. */

import type { ExerciseField, FieldGrade } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { NumberMatrix } from "../worked/matrix.ts";
import { DH_COLUMNS, type Grid, answerOf, emptyGrid, hasRows, isSet, rowsOf, unitAt, written } from "./answer.ts";
import type { Texts } from "./texts.ts";

export class FieldView {
  readonly host: HTMLElement;
  #body = element("div", { class: "answer-body" });
  #earned: HTMLElement;
  #right = element("p", { class: "answer-right", hidden: true });
  #cells: HTMLInputElement[][] = [];

  /** @param grid what is typed: it is written into. */
  constructor(
    readonly field: ExerciseField,
    private readonly grid: Grid,
    private readonly texts: Texts,
    private readonly points: (value: number) => string,
  ) {
    const { kind, label, name, points: most, unit } = field;
    this.#earned = element("p", { class: "earned", id: `earned-${name}`, hidden: true });
    const worth = element("span", { class: "muted small" }, texts.worth(points(most)));
    this.host = element(
      "fieldset",
      { class: "answer" },
      element("legend", {}, `${label}${unit && (hasRows(field.shape) || isSet(field)) ? ` [${unit}]` : ""} `, worth),
      this.#body,
      isSet(field) && button(texts.add, () => this.#add(), { class: "button small" }),
      this.#earned,
      this.#right,
    );
    if (kind === "choice") this.#offer();
    else this.#build();
  }

  /** What is typed, as the service takes it. */
  get answer(): unknown {
    return answerOf(this.field, this.grid);
  }

  /** Say what the answer earned; null takes that away. */
  grade(grade: FieldGrade | null): void {
    const { texts, points, field } = this;
    this.#earned.hidden = grade === null;
    for (const cell of this.#inputs()) {
      if (grade) cell.setAttribute("aria-invalid", String(!grade.correct));
      else cell.removeAttribute("aria-invalid");
    }
    if (!grade) return;
    const earned =
      !grade.correct && grade.points > 0 && ` (${texts.points(points(grade.points), points(field.points))})`;
    this.#earned.dataset["tone"] = grade.correct ? "good" : "bad";
    this.#earned.textContent = `${grade.correct ? texts.right : (grade.mistake?.text ?? texts.wrong)}${earned || ""}`;
  }

  /** Show the right answer. */
  solve(answer: unknown): void {
    this.#right.hidden = false;
    this.#right.replaceChildren(element("span", {}, this.texts.answer), this.#readable(answer));
  }

  #readable(answer: unknown): HTMLElement | string {
    const { field, texts } = this;
    if (field.kind === "choice") return field.choices.find(({ value }) => value === answer)?.text ?? String(answer);
    const rows = written(rowsOf(field, answer), texts.point);
    if (hasRows(field.shape)) {
      const matrix = new NumberMatrix(field.label);
      matrix.write(rows);
      return matrix.host;
    }
    const items = rows.map((row) => (field.shape.length ? `(${row.join(texts.between)})` : row[0]!));
    return `${items.join(texts.between)} ${field.unit ?? ""}`.trim();
  }

  #inputs(): HTMLInputElement[] {
    return [...this.#body.querySelectorAll("input")];
  }

  /** Words to choose from. */
  #offer(): void {
    const { choices, name } = this.field;
    const options = choices.map(({ value, text }) => {
      const radio = element("input", {
        type: "radio",
        name: `answer-${name}`,
        value,
        checked: this.grid[0]![0] === value,
        "aria-describedby": this.#earned.id,
        onchange: () => this.#typed(0, 0, value),
      });
      return element("label", { class: "answer-choice" }, radio, text);
    });
    this.#body.replaceChildren(...options);
  }

  /** Cells for all numbers. */
  #build(): void {
    const { field, grid } = this;
    this.#cells = grid.map((row, i) => row.map((_, j) => this.#cell(i, j)));
    const rows = this.#cells.map((cells, i) => this.#row(cells, i));
    const table = element("div", { class: "answer-rows" }, ...rows);
    table.classList.toggle("bracketed", hasRows(field.shape) && field.kind !== "dh_table");
    this.#body.replaceChildren(...(field.kind === "dh_table" ? [this.#head()] : []), table);
  }

  #head(): HTMLElement {
    const titles = DH_COLUMNS.map((name, j) => element("span", {}, `${name} [${unitAt(this.field, j)}]`));
    return element("div", { class: "answer-row answer-head", "aria-hidden": "true" }, ...titles);
  }

  #row(cells: readonly HTMLElement[], i: number): HTMLElement {
    const { field, texts } = this;
    const unit = !hasRows(field.shape) && !isSet(field) && field.unit;
    const remove = isSet(field) && this.grid.length > 1;
    return element(
      "div",
      { class: "answer-row" },
      ...cells,
      unit && element("span", { class: "unit" }, unit),
      remove && button("×", () => this.#remove(i), { class: "icon", "aria-label": texts.remove(i + 1) }),
    );
  }

  #cell(i: number, j: number): HTMLInputElement {
    const made = element("input", {
      class: "number",
      type: "text",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": this.#name(i, j),
      "aria-describedby": this.#earned.id,
      oninput: () => this.#typed(i, j, made.value),
      onkeydown: (event: KeyboardEvent) => {
        const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
        this.#cells[i + (step ?? 0)]?.[j]?.focus();
      },
    });
    made.value = this.grid[i]![j]!;
    return made;
  }

  /** What a screen reader says: `Jacobian, row 2, column 1`, `All (ϑ1, ϑ2), solution 1, 2`. */
  #name(i: number, j: number): string {
    const { field, texts } = this;
    const item = `${isSet(field) ? texts.solution : texts.row} ${i + 1}`;
    const place = field.kind === "dh_table" ? DH_COLUMNS[j]! : `${texts.column} ${j + 1}`;
    if (hasRows(field.shape)) return `${field.label}, ${item}, ${place}`;
    const parts = [field.label, isSet(field) && item, field.shape.length > 0 && String(j + 1)];
    return parts.filter(Boolean).join(", ");
  }

  #typed(i: number, j: number, text: string): void {
    this.grid[i]![j] = text;
    this.grade(null);
  }

  #add(): void {
    this.grid.push(...emptyGrid(this.field));
    this.#build();
    this.#cells.at(-1)?.[0]?.focus();
  }

  #remove(i: number): void {
    this.grid.splice(i, 1);
    this.#build();
    this.grade(null);
    this.#cells[Math.min(i, this.grid.length - 1)]?.[0]?.focus();
  }
}
