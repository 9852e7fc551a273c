/** The rows of a DH table as fields. */

import type { DhRow, DhTable } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import { NumberField } from "../../ui/number.ts";
import { type Kind, unitOf } from "../../ui/quantity.ts";

type Parameter = "a" | "alpha" | "d" | "theta" | "lower" | "upper";

const PARAMETERS: readonly { name: Parameter; latex: string; kind: Kind | "joint" }[] = [
  { name: "a", latex: "a_i", kind: "length" },
  { name: "alpha", latex: "\\alpha_i", kind: "angle" },
  { name: "d", latex: "d_i", kind: "length" },
  { name: "theta", latex: "\\theta_i", kind: "angle" },
  { name: "lower", latex: "q_{\\min}", kind: "joint" },
  { name: "upper", latex: "q_{\\max}", kind: "joint" },
];
const SIGNS: Record<Parameter, string> = {
  a: "a",
  alpha: "α",
  d: "d",
  theta: "θ",
  lower: "lower limit",
  upper: "upper limit",
};

interface Line {
  host: HTMLElement;
  error: HTMLElement;
  fields: Map<Parameter, NumberField>;
  /** Cells that hold no number. */
  unread: Map<Parameter, string>;
  /** What the service says against cells. */
  refused: Map<string, string>;
}

export class TableRows {
  readonly host: HTMLElement;
  #body = element("tbody");
  #head = element("tr");
  #lines: Line[] = [];
  #table: DhTable = { convention: "standard", joints: [] };

  /** @param edited is told of every table that can be read. */
  constructor(
    private readonly edited: (table: DhTable) => void,
    private readonly degrees: () => boolean,
  ) {
    this.host = element("table", { class: "dh" }, element("thead", {}, this.#head), this.#body);
  }

  get isEmpty(): boolean {
    return this.#lines.length === 0;
  }

  build(table: DhTable): void {
    this.#table = structuredClone(table);
    const titles = PARAMETERS.map(({ latex, kind }) => {
      const unit = kind === "joint" ? "" : unitOf(kind, this.degrees());
      return element("th", { scope: "col" }, formula(latex), unit && element("span", { class: "unit" }, unit));
    });
    const hidden = (text: string) => element("th", { scope: "col" }, element("span", { class: "unseen" }, text));
    this.#head.replaceChildren(hidden("Row"), hidden("Type"), ...titles, hidden("Remove"));
    this.#lines = this.#table.joints.map((row, index) => this.#line(row, index));
    this.#body.replaceChildren(...this.#lines.flatMap(({ host, error }) => [host, error]));
  }

  add(): void {
    const names = new Set(this.#table.joints.map((row) => row.name));
    let number = this.#table.joints.length + 1;
    while (names.has(`joint_${number}`)) number += 1;
    const row: DhRow = { name: `joint_${number}`, type: "revolute", a: 0.3, alpha: 0, d: 0, theta: 0 };
    this.build({ ...this.#table, joints: [...this.#table.joints, row] });
    this.#tell();
    this.#lines.at(-1)?.fields.get("a")?.input.focus();
  }

  /** Show what the service says at the cells it speaks of; true where a place is not in a row. */
  fail(places: readonly { pointer: string; detail: string }[]): boolean {
    for (const line of this.#lines) line.refused.clear();
    let isElsewhere = false;
    for (const { pointer, detail } of places) {
      const [, row, cell = ""] = /^#\/dh\/joints\/(\d+)(?:\/([^/]+))?/.exec(pointer) ?? [];
      const line = this.#lines[Number(row)];
      if (row !== undefined && line) line.refused.set(cell, detail.replace(/^joint \d+ of the table: (?:\w+: )?/, ""));
      else isElsewhere = true;
    }
    for (const line of this.#lines) showErrors(line);
    return isElsewhere;
  }

  #line(row: DhRow, index: number): Line {
    const line: Line = {
      host: element("tr"),
      error: element("tr", { class: "cell-error", hidden: true }),
      fields: new Map(),
      unread: new Map(),
      refused: new Map(),
    };
    const number = index + 1;
    line.host.append(element("th", { scope: "row" }, String(number)), element("td", {}, this.#type(row, number)));
    for (const { name, kind } of PARAMETERS) {
      const field = this.#field(
        line,
        row,
        name,
        kind === "joint" ? (row.type === "revolute" ? "angle" : "length") : kind,
        number,
      );
      const isVariable = name === (row.type === "revolute" ? "theta" : "d");
      const cell = element(
        "td",
        { class: isVariable ? "variable" : null, title: isVariable ? "The joint's position is added to this" : null },
        field.input,
      );
      line.host.append(cell);
    }
    const remove = button("×", () => this.#remove(index), {
      class: "icon",
      "aria-label": `Remove row ${number}`,
      title: "Remove",
      disabled: this.#table.joints.length === 1,
    });
    line.host.append(element("td", {}, remove));
    return line;
  }

  #type(row: DhRow, number: number): HTMLElement {
    const select = element(
      "select",
      {
        class: "select",
        "aria-label": `Row ${number}, type`,
        onchange: () => {
          row.type = select.value as DhRow["type"];
          delete row.lower;
          delete row.upper;
          this.build(this.#table);
          this.#tell();
        },
      },
      element("option", { value: "revolute", selected: row.type === "revolute" }, "R"),
      element("option", { value: "prismatic", selected: row.type === "prismatic" }, "P"),
    );
    return select;
  }

  #field(line: Line, row: DhRow, name: Parameter, kind: Kind, number: number): NumberField {
    const optional = name === "lower" || name === "upper";
    const field = new NumberField({
      label: `Row ${number}, ${SIGNS[name]}`,
      kind,
      degrees: this.degrees,
      decimals: 3,
      live: true,
      optional,
      change: (value) => {
        if (value !== null) row[name] = value;
        else if (optional) delete row[name];
        this.#tell();
      },
      invalid: (reason) => {
        if (reason === null) line.unread.delete(name);
        else line.unread.set(name, reason);
        showErrors(line);
      },
    });
    field.set(row[name] ?? null);
    if (optional)
      field.input.placeholder = kind === "angle" ? (name === "lower" ? "−π" : "π") : name === "lower" ? "−1" : "1";
    line.fields.set(name, field);
    return field;
  }

  #remove(index: number): void {
    this.build({ ...this.#table, joints: this.#table.joints.filter((_, i) => i !== index) });
    this.#tell();
  }

  #tell(): void {
    if (this.#lines.some((line) => line.unread.size > 0)) return;
    this.edited(structuredClone(this.#table));
  }
}

function showErrors(line: Line): void {
  const found = new Map<string, string>([...line.refused, ...line.unread]);
  for (const [name, field] of line.fields) field.fail(found.get(name) ?? null);
  line.error.hidden = found.size === 0;
  const texts = [...found].map(([name, text]) =>
    element("p", {}, name in SIGNS ? `${SIGNS[name as Parameter]}: ${text}` : text),
  );
  line.error.replaceChildren(element("td", { colspan: PARAMETERS.length + 3, role: "alert" }, ...texts));
}
