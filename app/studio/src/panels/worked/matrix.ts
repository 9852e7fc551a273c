/** A matrix of numbers between brackets, or a single number; a change writes only what differs. */

import { element } from "../../ui/dom.ts";
import { rounded } from "../../ui/matrices.ts";

export class NumberMatrix {
  readonly host: HTMLElement;
  #cells: HTMLElement[][] = [];

  /** @param name what a screen reader says. */
  constructor(name: string) {
    this.host = element("span", { class: "matrix", role: "group", "aria-label": name });
  }

  set(values: readonly (readonly number[])[]): void {
    this.write(values.map((row) => row.map(rounded)));
  }

  /** The same with numbers that are written already. */
  write(texts: readonly (readonly string[])[]): void {
    if (texts.length !== this.#cells.length || texts[0]?.length !== this.#cells[0]?.length) this.#build(texts);
    for (const [i, row] of texts.entries()) {
      for (const [j, text] of row.entries()) {
        const cell = this.#cells[i]![j]!;
        if (cell.textContent !== text) cell.textContent = text;
      }
    }
  }

  #build(texts: readonly (readonly string[])[]): void {
    this.host.classList.toggle("bracketed", texts.flat().length > 1);
    this.#cells = texts.map((row) => row.map(() => element("span", { class: "matrix-cell" })));
    this.host.replaceChildren(...this.#cells.map((row) => element("span", { class: "matrix-row" }, ...row)));
  }
}
