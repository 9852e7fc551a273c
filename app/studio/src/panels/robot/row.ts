/** One row of a DH table as fields: what the convention needs, and below it name and limits of rate and effort. */

import { jointName } from "../../robot/dh.ts";
import type { DhRow } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { format, type Kind, unitOf } from "../../ui/quantity.ts";

export type Parameter = "a" | "alpha" | "d" | "theta" | "lower" | "upper" | "velocity" | "effort";

/** The columns of the table. */
export const COLUMNS: readonly { name: Parameter; latex: string; kind: Kind | "joint" }[] = [
  { name: "a", latex: "a_i", kind: "length" },
  { name: "alpha", latex: "\\alpha_i", kind: "angle" },
  { name: "d", latex: "d_i", kind: "length" },
  { name: "theta", latex: "\\theta_i", kind: "angle" },
  { name: "lower", latex: "q_{\\min}", kind: "joint" },
  { name: "upper", latex: "q_{\\max}", kind: "joint" },
];
const SIGNS: Record<Parameter | "name", string> = {
  a: "a",
  alpha: "α",
  d: "d",
  theta: "θ",
  lower: "lower limit",
  upper: "upper limit",
  velocity: "velocity limit",
  effort: "effort limit",
  name: "name",
};
const OPTIONAL: ReadonlySet<Parameter> = new Set(["lower", "upper", "velocity", "effort"]);
const DETAILS: readonly string[] = ["name", "velocity", "effort"];

export interface RowOptions {
  degrees: () => boolean;
  isOnly: boolean;
  /** A number of the row has changed. */
  edited: () => void;
  /** Its type has changed, and with it what its limits mean. */
  retyped: () => void;
  /** The name wanted; empty for the usual one. */
  rename: (name: string) => void;
  remove: () => void;
}

export class Row {
  /** Rows of the table: the parameters, the details, the errors. */
  readonly hosts: readonly HTMLElement[];
  #fields = new Map<Parameter, NumberField>();
  #name: HTMLInputElement;
  #details: HTMLElement;
  #errors: HTMLElement;
  /** Cells that hold no number. */
  #unread = new Map<string, string>();
  /** What the service says against cells. */
  #refused = new Map<string, string>();
  #isDetailed = false;
  /** Angles that look like degrees, typed where radians are meant, as what they then are, [rad]. */
  #doubts = new Map<Parameter, number>();
  #questions: HTMLElement;

  constructor(
    private readonly row: DhRow,
    index: number,
    private readonly options: RowOptions,
  ) {
    const number = index + 1;
    this.#name = element("input", {
      class: "text",
      type: "text",
      "aria-label": `Row ${number}, name`,
      autocomplete: "off",
      spellcheck: "false",
      placeholder: `joint_${number}`,
      onchange: () => options.rename(this.#name.value),
    });
    this.#name.value = jointName(row, index);
    this.#details = this.#detailsRow(number);
    this.#errors = element("tr", { class: "cell-error", hidden: true });
    this.#questions = element("tr", { class: "cell-question", hidden: true });
    this.hosts = [this.#parameters(number), this.#details, this.#errors, this.#questions];
  }

  get isRead(): boolean {
    return this.#unread.size === 0;
  }

  focus(): void {
    this.#fields.get("a")?.input.focus();
  }

  detail(isDetailed: boolean): void {
    this.#isDetailed = isDetailed;
    this.#showErrors();
  }

  /** What the service says against cells of this row; the empty name is the row itself. */
  refuse(reasons: ReadonlyMap<string, string>): void {
    this.#refused = new Map(reasons);
    this.#showErrors();
  }

  get #jointKind(): Kind {
    return this.row.type === "revolute" ? "angle" : "length";
  }

  #parameters(number: number): HTMLElement {
    const cells = COLUMNS.map(({ name, kind }) => {
      const field = this.#field(name, kind === "joint" ? this.#jointKind : kind, number);
      const isVariable = name === (this.row.type === "revolute" ? "theta" : "d");
      const title = isVariable ? "The joint's position is added to this" : null;
      return element("td", { class: isVariable ? "variable" : null, title }, field.input);
    });
    const remove = button("×", this.options.remove, {
      class: "icon",
      "aria-label": `Remove row ${number}`,
      title: "Remove",
      disabled: this.options.isOnly,
    });
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, String(number)),
      element("td", {}, this.#type(number)),
      ...cells,
      element("td", {}, remove),
    );
  }

  #detailsRow(number: number): HTMLElement {
    const isTurning = this.row.type === "revolute";
    const rate = `${unitOf(this.#jointKind, this.options.degrees())}/s`;
    const titled = (title: string, field: HTMLElement, unit: string) =>
      element("span", { class: "detail" }, title, field, unit && element("span", { class: "unit" }, unit));
    const cell = element(
      "td",
      { colspan: COLUMNS.length + 2 },
      element(
        "div",
        { class: "details" },
        titled("Name", this.#name, ""),
        titled("Velocity", this.#field("velocity", this.#jointKind, number).input, rate),
        titled("Effort", this.#field("effort", "number", number).input, isTurning ? "N m" : "N"),
      ),
    );
    return element("tr", { class: "row-details", hidden: true }, element("td"), cell);
  }

  #type(number: number): HTMLElement {
    const { row } = this;
    const select = element(
      "select",
      {
        class: "select",
        "aria-label": `Row ${number}, type`,
        onchange: () => {
          row.type = select.value as DhRow["type"];
          for (const limit of OPTIONAL) delete row[limit as "lower"];
          this.options.retyped();
        },
      },
      element("option", { value: "revolute", selected: row.type === "revolute" }, "R"),
      element("option", { value: "prismatic", selected: row.type === "prismatic" }, "P"),
    );
    return select;
  }

  #field(name: Parameter, kind: Kind, number: number): NumberField {
    const { row } = this;
    const optional = OPTIONAL.has(name);
    const field = new NumberField({
      label: `Row ${number}, ${SIGNS[name]}`,
      kind,
      degrees: this.options.degrees,
      decimals: 3,
      live: true,
      optional,
      change: (value) => {
        if (value !== null) row[name] = value;
        else if (optional) delete row[name as "lower"];
        this.options.edited();
      },
      invalid: (reason) => {
        if (reason === null) this.#unread.delete(name);
        else this.#unread.set(name, reason);
        this.#showErrors();
      },
      // A joint may well turn faster than a turn a second.
      ...(name !== "velocity" && { doubt: (asDegrees) => this.#doubt(name, asDegrees) }),
    });
    field.set(row[name] ?? null);
    if (name === "lower") field.input.placeholder = kind === "angle" ? "−π" : "−1";
    if (name === "upper") field.input.placeholder = kind === "angle" ? "π" : "1";
    this.#fields.set(name, field);
    return field;
  }

  /** Ask whether degrees are meant; the same question stays as it is, or a press on it would go astray. */
  #doubt(name: Parameter, asDegrees: number | null): void {
    if ((this.#doubts.get(name) ?? null) === asDegrees) return;
    if (asDegrees === null) this.#doubts.delete(name);
    else this.#doubts.set(name, asDegrees);
    const asked = [...this.#doubts].map(([of, radians]) => this.#question(of, radians));
    this.#questions.hidden = asked.length === 0;
    this.#questions.replaceChildren(element("td", { colspan: COLUMNS.length + 3, role: "status" }, ...asked));
  }

  #question(name: Parameter, radians: number): HTMLElement {
    const text = `${format(radians, "angle", true, 6)}°`;
    const take = () => {
      const field = this.#fields.get(name)!;
      this.row[name] = radians;
      this.#doubt(name, null);
      field.set(radians);
      field.input.focus();
      this.options.edited();
    };
    const turns = `${format((Math.abs(radians) * 180) / Math.PI / (2 * Math.PI), "number", false, 1)} turns`;
    const typed = format((radians * 180) / Math.PI, "number", false, 4);
    return element(
      "p",
      {},
      `${SIGNS[name]} = ${typed} rad is ${turns}. `,
      button(`${text}?`, take, { class: "button small", "aria-label": `Take ${SIGNS[name]} as ${text}` }),
    );
  }

  #showErrors(): void {
    const found = new Map<string, string>([...this.#refused, ...this.#unread]);
    for (const [name, field] of this.#fields) field.fail(found.get(name) ?? null);
    this.#name.setAttribute("aria-invalid", String(found.has("name")));
    this.#details.hidden = !this.#isDetailed && !DETAILS.some((name) => found.has(name));
    this.#errors.hidden = found.size === 0;
    const texts = [...found].map(([name, text]) =>
      element("p", {}, name in SIGNS ? `${SIGNS[name as Parameter]}: ${text}` : text),
    );
    this.#errors.replaceChildren(element("td", { colspan: COLUMNS.length + 3, role: "alert" }, ...texts));
  }
}
