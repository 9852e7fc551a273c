/** The rows of a DH table as fields. */

import type { DhRow } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import { unitOf } from "../../ui/quantity.ts";
import { jointName } from "../../robot/dh.ts";
import { COLUMNS, Row } from "./row.ts";

/** A place in the payload, and what is wrong there. */
export interface Place {
  pointer: string;
  detail: string;
}

export class TableRows {
  readonly host: HTMLElement;
  #body = element("tbody");
  #head = element("tr");
  #lines: Row[] = [];
  #rows: DhRow[] = [];
  #isDetailed = false;

  /** @param edited is told of all rows, whenever each of them can be read. */
  constructor(
    private readonly edited: (rows: DhRow[]) => void,
    private readonly degrees: () => boolean,
  ) {
    this.host = element("table", { class: "dh" }, element("thead", {}, this.#head), this.#body);
  }

  get isEmpty(): boolean {
    return this.#lines.length === 0;
  }

  build(rows: readonly DhRow[]): void {
    this.#rows = structuredClone([...rows]);
    const titles = COLUMNS.map(({ latex, kind }) => {
      const unit = kind === "joint" ? "" : unitOf(kind, this.degrees());
      return element("th", { scope: "col" }, formula(latex), unit && element("span", { class: "unit" }, unit));
    });
    const hidden = (text: string) => element("th", { scope: "col" }, element("span", { class: "unseen" }, text));
    this.#head.replaceChildren(hidden("Row"), hidden("Type"), ...titles, hidden("Remove"));
    this.#lines = this.#rows.map((row, index) => this.#line(row, index));
    this.#body.replaceChildren(...this.#lines.flatMap(({ hosts }) => hosts));
  }

  add(): void {
    const names = new Set(this.#rows.map(jointName));
    let number = this.#rows.length + 1;
    while (names.has(`joint_${number}`)) number += 1;
    const row: DhRow = { name: `joint_${number}`, type: "revolute", a: 0.3, alpha: 0, d: 0, theta: 0 };
    this.#rebuild([...this.#rows, row]);
    this.#lines.at(-1)?.focus();
  }

  /** Whether names and limits of rate and effort are shown too. */
  detail(isDetailed: boolean): void {
    this.#isDetailed = isDetailed;
    for (const line of this.#lines) line.detail(isDetailed);
  }

  /** Show what the service says at the cells it speaks of; returns what is not in a row. */
  fail(places: readonly Place[]): Place[] {
    const found = this.#lines.map(() => new Map<string, string>());
    const elsewhere: Place[] = [];
    for (const place of places) {
      const [, row, cell = ""] = /^#\/dh\/joints\/(\d+)(?:\/([^/]+))?/.exec(place.pointer) ?? [];
      const reasons = row === undefined ? undefined : found[Number(row)];
      if (reasons) reasons.set(cell, place.detail.replace(/^joint \d+ of the table: (?:\w+: )?/, ""));
      else elsewhere.push(place);
    }
    for (const [index, line] of this.#lines.entries()) line.refuse(found[index]!);
    return elsewhere;
  }

  #line(row: DhRow, index: number): Row {
    const line = new Row(row, index, {
      degrees: this.degrees,
      isOnly: this.#rows.length === 1,
      edited: () => this.#tell(),
      retyped: () => this.#rebuild(this.#rows),
      rename: (name) => this.#rename(index, name.trim()),
      remove: () => this.#rebuild(this.#rows.filter((_, i) => i !== index)),
    });
    line.detail(this.#isDetailed);
    return line;
  }

  /** Another name for a joint, also where another row follows it. */
  #rename(index: number, name: string): void {
    const row = this.#rows[index]!;
    const before = jointName(row, index);
    if (name) row.name = name;
    else delete row.name;
    for (const { mimic } of this.#rows) {
      if (mimic?.joint === before) mimic.joint = jointName(row, index);
    }
    this.#tell();
  }

  #rebuild(rows: readonly DhRow[]): void {
    this.build(rows);
    this.#tell();
  }

  #tell(): void {
    if (this.#lines.every((line) => line.isRead)) this.edited(structuredClone(this.#rows));
  }
}
