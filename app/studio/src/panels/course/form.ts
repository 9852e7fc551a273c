/** The form of a calculator: a widget for each of its fields, kept while the field is there. */

import { t } from "../../texts/index.ts";
import { Choice, element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { unitOf, type Units } from "../../ui/quantity.ts";
import { type Field, type Inputs, valueAt, withValue } from "./calculator.ts";
import { parsedList, writtenList } from "./lists.ts";

const DECIMALS = 9;
const SLIDER_STEP = Math.PI / 180;
/** Of a choice, as buttons; more are a list to open. */
const MOST_BUTTONS = 3;

interface Widget {
  host: HTMLElement;
  show(value: unknown): void;
  fail(reason: string | null): void;
}

export class Form {
  readonly host = element("div", { class: "course-form" });
  #widgets = new Map<string, Widget>();
  #inputs: Inputs = {};
  #shape = "";

  constructor(
    private readonly units: () => Units,
    private readonly changed: (inputs: Inputs) => void,
  ) {}

  show(fields: readonly Field[], inputs: Inputs): void {
    this.#inputs = inputs;
    const shape = JSON.stringify([fields, this.units()]);
    if (shape !== this.#shape) this.#build(fields);
    this.#shape = shape;
    for (const { pointer, chosen } of fields) this.#widgets.get(pointer)!.show(chosen ?? valueAt(inputs, pointer));
  }

  /** Say at the fields what is wrong; whether one of them has the place. */
  fail(pointer: string, reason: string): boolean {
    const place = pointer.replace(/^#?\//, "");
    const found = [...this.#widgets].find(([own]) => place === own || place.startsWith(`${own}/`));
    found?.[1].fail(reason);
    return found !== undefined;
  }

  clear(): void {
    for (const widget of this.#widgets.values()) widget.fail(null);
  }

  #build(fields: readonly Field[]): void {
    const focused = (document.activeElement as HTMLElement | null)?.getAttribute("aria-label");
    const hadFocus = this.host.contains(document.activeElement);
    this.#widgets = new Map(fields.map((field) => [field.pointer, this.#widget(field)]));
    this.host.replaceChildren(...[...this.#widgets.values()].map(({ host }) => host));
    if (hadFocus && focused) this.host.querySelector<HTMLElement>(`[aria-label="${CSS.escape(focused)}"]`)?.focus();
  }

  #widget(field: Field): Widget {
    switch (field.kind) {
      case "choice":
        return this.#choice(field);
      case "switch":
        return this.#switch(field);
      case "list":
      case "text":
        return this.#text(field);
      default:
        return this.#number(field, field.kind);
    }
  }

  #change({ pointer }: Field, value: unknown): void {
    this.changed(withValue(this.#inputs, pointer, value));
  }

  #number(field: Field, kind: "number" | "angle" | "length"): Widget {
    const take = (value: number | null) => this.#change(field, value);
    const { optional = false, step } = field;
    const made = new NumberField({
      label: field.label,
      kind,
      units: this.units,
      ...(kind !== "angle" && { decimals: DECIMALS }),
      optional,
      live: true,
      change: take,
      ...(step !== undefined && { step: { by: step, take } }),
    });
    const slider = field.slides ? this.#slider(field) : null;
    const row = line(field, made.input, field.unit ?? unitOf(kind, this.units()), slider);
    return {
      host: row.host,
      show: (value) => {
        made.set(typeof value === "number" ? value : null);
        if (slider && typeof value === "number") slider.value = String(value);
      },
      fail: (reason) => {
        made.fail(reason);
        row.fail(reason);
      },
    };
  }

  #slider(field: Field): HTMLInputElement {
    const slider = element("input", {
      type: "range",
      min: -Math.PI,
      max: Math.PI,
      step: SLIDER_STEP,
      "aria-label": t("{label}, slider", { label: field.label }),
      oninput: () => this.#change(field, Number(slider.value)),
    });
    return slider;
  }

  #text(field: Field): Widget {
    const isList = field.kind === "list";
    const typed = () => {
      const text = input.value.trim();
      const value = text === "" && field.optional ? null : isList ? parsedList(text) : text;
      const isWrong = isList && value === null && text !== "";
      widget.fail(isWrong || (text === "" && !field.optional) ? t("Write numbers such as 0, π/2, 1.5") : null);
      if (!isWrong && (text !== "" || field.optional)) this.#change(field, value);
    };
    const input = element("input", {
      class: "number list",
      type: "text",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": field.label,
      oninput: typed,
      onblur: () => write(),
    });
    let shown: unknown;
    const write = () => {
      if (document.activeElement !== input) input.value = isList ? writtenList(shown) : String(shown ?? "");
    };
    const row = line(field, input, field.unit ?? "");
    const widget = {
      host: row.host,
      show: (value: unknown) => {
        shown = value;
        write();
      },
      fail: (reason: string | null) => {
        input.setAttribute("aria-invalid", String(reason !== null));
        row.fail(reason);
      },
    };
    return widget;
  }

  #choice(field: Field): Widget {
    const options = field.options ?? [];
    const take = (value: string) => (field.choose ? this.changed(field.choose(value)) : this.#change(field, value));
    if (options.length <= MOST_BUTTONS) {
      const choice = new Choice(field.label, options, take);
      const row = line(field, choice.host, "");
      return { host: row.host, show: (value) => choice.show(String(value)), fail: row.fail };
    }
    const select = element(
      "select",
      { class: "select", "aria-label": field.label, onchange: () => take(select.value) },
      ...options.map(({ value, text }) => element("option", { value }, text)),
    );
    const row = line(field, select, "");
    return { host: row.host, show: (value) => (select.value = String(value)), fail: row.fail };
  }

  #switch(field: Field): Widget {
    const box = element("input", {
      type: "checkbox",
      "aria-label": field.label,
      onchange: () => this.#change(field, box.checked || null),
    });
    const row = line(field, box, "");
    return { host: row.host, show: (value) => (box.checked = value === true), fail: row.fail };
  }
}

/** A row of the form: what it is called, what is typed in, in which unit, and what is wrong with it. */
function line(field: Field, input: HTMLElement, unit: string, below: HTMLElement | null = null) {
  const wrong = element("p", { class: "course-wrong", role: "alert", hidden: true });
  const host = element(
    "div",
    { class: "course-field" },
    element("span", { class: "course-label", "aria-hidden": "true" }, field.label),
    input,
    element("span", { class: "unit" }, unit),
    below,
    wrong,
  );
  const fail = (reason: string | null) => {
    wrong.hidden = reason === null;
    wrong.textContent = reason ?? "";
  };
  return { host, fail };
}
