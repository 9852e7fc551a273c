/** The rows of a DH table as fields. */

import { t } from "../../texts/index.ts";
import type { DhRow } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { info } from "../../ui/info.ts";
import { formula } from "../../ui/mathematics.ts";
import type { Lit } from "../../state.ts";
import { jointHue } from "../../view/colours.ts";
import { type Units, unitOf } from "../../ui/quantity.ts";
import { jointName, places } from "../../robot/dh.ts";
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

  /**
   * @param edited is told of all rows, whenever each of them can be read.
   * @param pointed is told what the pointer or the focus is on.
   */
  constructor(
    private readonly edited: (rows: DhRow[]) => void,
    private readonly units: () => Units,
    private readonly pointed: (lit: Lit | null) => void,
  ) {
    this.host = element("table", { class: "dh" }, element("thead", {}, this.#head), this.#body);
  }

  get isEmpty(): boolean {
    return this.#lines.length === 0;
  }

  build(rows: readonly DhRow[]): void {
    this.#rows = structuredClone([...rows]);
    const titles = COLUMNS.map(({ latex, kind, term }) => {
      const unit = kind === "joint" ? "" : unitOf(kind, this.units());
      const named = [formula(latex), unit && element("span", { class: "unit" }, unit)];
      return element("th", { scope: "col" }, ...named, info(term));
    });
    const hidden = (text: string) => element("th", { scope: "col" }, element("span", { class: "unseen" }, text));
    this.#head.replaceChildren(hidden(t("Row")), hidden(t("Type")), ...titles, hidden(t("Remove")));
    const hues = places(this.#rows).map(jointHue);
    this.#lines = this.#rows.map((row, index) => this.#line(row, index, hues[index]!));
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

  /** Show what is pointed at in the picture. */
  light(lit: Lit | null): void {
    for (const [index, line] of this.#lines.entries()) line.light(lit?.row === index ? lit.part : null);
  }

  /** The same rows with other numbers: what is typed in stays; whether they are the same. */
  update(rows: readonly DhRow[]): boolean {
    const kinds = (all: readonly DhRow[]) => all.map((row, i) => `${jointName(row, i)} ${row.type}`).join();
    const isSame = kinds(rows) === kinds(this.#rows) && this.#lines.every(({ isSettled }) => isSettled);
    if (!isSame || this.isEmpty) return false;
    for (const [i, row] of rows.entries()) this.#lines[i]!.update(structuredClone(row));
    return true;
  }

  #line(row: DhRow, index: number, tone: string): Row {
    const line = new Row(row, index, {
      units: this.units,
      isOnly: this.#rows.length === 1,
      edited: () => this.#tell(),
      retyped: () => this.#rebuild(this.#rows),
      rename: (name) => this.#rename(index, name.trim()),
      pointed: (at) => this.pointed(at && { row: index, ...at }),
      tone,
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
