/** One row of a DH table as fields: what the convention needs, and below it name and limits of rate and effort. */

import { jointName, PARAMETERS, type Parameter as Part, variableOf } from "../../robot/dh.ts";
import { t } from "../../texts/index.ts";
import type { DhRow } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { format, type Kind, measured, SI, type Units, unitOf } from "../../ui/quantity.ts";

export type Parameter = "a" | "alpha" | "d" | "theta" | "lower" | "upper" | "velocity" | "effort";

/** The columns of the table. */
export const COLUMNS: readonly { name: Parameter; latex: string; kind: Kind | "joint"; term: string }[] = [
  { name: "a", latex: "a_i", kind: "length", term: t("Length a") },
  { name: "alpha", latex: "\\alpha_i", kind: "angle", term: t("Twist α") },
  { name: "d", latex: "d_i", kind: "length", term: t("Offset d") },
  { name: "theta", latex: "\\theta_i", kind: "angle", term: t("Angle θ") },
  { name: "lower", latex: "q_{\\min}", kind: "joint", term: t("Lower limit") },
  { name: "upper", latex: "q_{\\max}", kind: "joint", term: t("Upper limit") },
];
const SIGNS: Record<Parameter | "name", string> = {
  a: "a",
  alpha: "α",
  d: "d",
  theta: "θ",
  lower: t("lower limit"),
  upper: t("upper limit"),
  velocity: t("velocity limit"),
  effort: t("effort limit"),
  name: "name",
};
const OPTIONAL: ReadonlySet<Parameter> = new Set(["lower", "upper", "velocity", "effort"]);
const DETAILS: readonly string[] = ["name", "velocity", "effort"];

export interface RowOptions {
  units: () => Units;
  isOnly: boolean;
  /** A number of the row has changed. */
  edited: () => void;
  /** Its type has changed, and with it what its limits mean. */
  retyped: () => void;
  /** The name wanted; empty for the usual one. */
  rename: (name: string) => void;
  remove: () => void;
  /** The pointer or the focus is on the row, on one of its parameters or on none of them; null where it has left. */
  pointed: (at: { part: Part | null } | null) => void;
  /** The colour of its joint. */
  tone: string;
}

export class Row {
  /** Rows of the table: the parameters, the details, the errors. */
  readonly hosts: readonly HTMLElement[];
  #fields = new Map<Parameter, NumberField>();
  #cells = new Map<Part, HTMLElement>();
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
      "aria-label": t("Row {number}, name", { number }),
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

  /** Whether nothing in it waits for the one who types. */
  get isSettled(): boolean {
    return this.isRead && this.#doubts.size === 0;
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
      const isVariable = name === variableOf(this.row);
      const part = PARAMETERS.find((parameter) => parameter === name) ?? null;
      const title = isVariable ? t("The joint's position is added to this") : null;
      const classes = [isVariable && "variable", part].filter(Boolean).join(" ");
      const cell = element("td", { class: classes || null, title, ...this.#pointing(part) }, field.input);
      if (part) this.#cells.set(part, cell);
      return cell;
    });
    const remove = button("×", this.options.remove, {
      class: "icon",
      "aria-label": t("Remove row {number}", { number }),
      title: t("Remove"),
      disabled: this.options.isOnly,
    });
    return element(
      "tr",
      { class: this.options.tone },
      element("th", { scope: "row", class: "tinted", ...this.#pointing(null) }, String(number)),
      element("td", {}, this.#type(number)),
      ...cells,
      element("td", {}, remove),
    );
  }

  #pointing(part: Part | null) {
    const { pointed } = this.options;
    const [enter, leave] = [() => pointed({ part }), () => pointed(null)];
    return { onpointerenter: enter, onpointerleave: leave, onfocusin: enter, onfocusout: leave };
  }

  /** Show which parameter is pointed at in the picture. */
  light(part: Part | null): void {
    for (const [name, cell] of this.#cells) cell.classList.toggle("lit", name === part);
  }

  /** Numbers that have been changed in the picture. */
  update(row: DhRow): void {
    for (const key of Object.keys(this.row)) delete this.row[key as "name"];
    Object.assign(this.row, row);
    for (const [name, field] of this.#fields) field.set(row[name] ?? null);
  }

  #detailsRow(number: number): HTMLElement {
    const isTurning = this.row.type === "revolute";
    const rate = `${unitOf(this.#jointKind, this.options.units())}/s`;
    const titled = (title: string, field: HTMLElement, unit: string) =>
      element("span", { class: "detail" }, title, field, unit && element("span", { class: "unit" }, unit));
    const cell = element(
      "td",
      { colspan: COLUMNS.length + 2 },
      element(
        "div",
        { class: "details" },
        titled(t("Name"), this.#name, ""),
        titled(t("Velocity"), this.#field("velocity", this.#jointKind, number).input, rate),
        titled(t("Effort"), this.#field("effort", "number", number).input, isTurning ? "N m" : "N"),
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
        "aria-label": t("Row {number}, type", { number }),
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
      label: t("Row {number}, {SIGNS}", { number, SIGNS: SIGNS[name] }),
      kind,
      units: this.options.units,
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
    const usual = { lower: -1, upper: 1 }[name as "lower"];
    if (usual) field.input.placeholder = format(usual * (kind === "angle" ? Math.PI : 1), kind, this.options.units());
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
    const text = measured(radians, "angle", { ...SI, degrees: true }, 6);
    const take = () => {
      const field = this.#fields.get(name)!;
      this.row[name] = radians;
      this.#doubt(name, null);
      field.set(radians);
      field.input.focus();
      this.options.edited();
    };
    const turns = t("{radians} turns", {
      radians: format((Math.abs(radians) * 180) / Math.PI / (2 * Math.PI), "number", SI, 1),
    });
    const typed = format((radians * 180) / Math.PI, "number", SI, 4);
    return element(
      "p",
      {},
      t("{SIGNS} = {typed} rad is {turns}. ", { SIGNS: SIGNS[name], typed, turns }),
      button(`${text}?`, take, {
        class: "button small",
        "aria-label": t("Take {SIGNS} as {text}", { SIGNS: SIGNS[name], text }),
      }),
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
