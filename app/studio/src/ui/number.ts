/** A field for a number: shows it rounded, edits it exactly, and says when what is typed is none. */

import { t } from "../texts/index.ts";
import { element } from "./dom.ts";
import { exact, format, fromUnit, ifDegrees, inUnit, type Kind, parse, type Units } from "./quantity.ts";

const PLAIN = t("Write a number such as 0.35");
const WRITE: Record<Kind, string> = { length: PLAIN, number: PLAIN, angle: "Write a number such as 0.35, pi/2 or 90°" };

export interface NumberOptions {
  /** What a screen reader says. */
  label: string;
  /** What is typed; a function where that changes. */
  kind: Kind | (() => Kind);
  units: () => Units;
  decimals?: number;
  /** Whether an empty field is fine: it stands for null. */
  optional?: boolean;
  /** What was typed, as soon as it is a number; with `live` at every key, else when the field is left. */
  change: (value: number | null) => void;
  live?: boolean;
  /** What the arrow keys up and down do: add so much or take it away, ten times as much with Shift. */
  step?: { by: number; take: (value: number) => void };
  /** The field holds no number, or again one. */
  invalid?: (reason: string | null) => void;
  /** What was typed looks like degrees, which are so many radians; null where it no longer does. */
  doubt?: (asDegrees: number | null) => void;
}

export class NumberField {
  readonly input: HTMLInputElement;
  #value: number | null = null;
  #isEdited = false;

  constructor(private readonly options: NumberOptions) {
    this.input = element("input", {
      class: "number",
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": options.label,
      onfocus: () => this.#begin(),
      onblur: () => this.#end(),
      oninput: () => this.#typed(),
      onkeydown: (event: KeyboardEvent) => {
        if (event.key === "Enter") this.#commit();
        if (event.key === "Escape") this.#forget();
        if (event.key === "ArrowUp" || event.key === "ArrowDown") this.#step(event);
      },
    });
  }

  get value(): number | null {
    return this.#value;
  }

  /** Show a number; what is being typed stays. */
  set(value: number | null): void {
    this.#value = value;
    if (this.#isEdited) return;
    this.#write(document.activeElement === this.input ? exact : format);
  }

  get #kind(): Kind {
    const { kind } = this.options;
    return typeof kind === "function" ? kind() : kind;
  }

  fail(reason: string | null): void {
    this.input.setAttribute("aria-invalid", String(reason !== null));
    this.input.title = reason ?? "";
  }

  #write(how: typeof format): void {
    const { units, decimals } = this.options;
    this.input.dataset["kind"] = this.#kind;
    this.input.value = this.#value === null ? "" : how(this.#value, this.#kind, units(), decimals);
  }

  #begin(): void {
    this.#write(exact);
    this.input.select();
  }

  #end(): void {
    this.#commit();
    if (!this.#isEdited) this.#write(format);
  }

  #typed(): void {
    this.#isEdited = true;
    const value = this.#read();
    if (this.options.live && value !== undefined) this.#take(value);
  }

  #commit(): void {
    if (!this.#isEdited) return;
    const value = this.#read();
    if (value === undefined) return;
    this.#isEdited = false;
    this.#take(value);
    if (document.activeElement === this.input) this.#write(exact);
  }

  #step(event: KeyboardEvent): void {
    const { step } = this.options;
    const value = this.#isEdited ? this.#read() : this.#value;
    if (!step || value === null || value === undefined) return;
    event.preventDefault();
    this.#isEdited = false;
    const sign = (event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : 1);
    const units = this.options.units();
    // Rounded as it is shown: without the dust of adding 0.1 and 0.2.
    const shown = Number(inUnit(value + sign * step.by, this.#kind, units).toPrecision(15));
    this.#value = fromUnit(shown, this.#kind, units);
    this.#write(exact);
    step.take(this.#value);
  }

  #forget(): void {
    this.#isEdited = false;
    this.fail(null);
    this.options.invalid?.(null);
    this.#write(exact);
    this.input.select();
  }

  #take(value: number | null): void {
    this.#value = value;
    this.options.change(value);
  }

  /** What is typed; undefined, with the reason at the field, where it is no number. */
  #read(): number | null | undefined {
    const { units, optional, invalid, doubt } = this.options;
    const text = this.input.value;
    const value = optional && text.trim() === "" ? null : parse(text, this.#kind, units());
    const reason = value === null && !(optional && text.trim() === "") ? WRITE[this.#kind] : null;
    this.fail(reason);
    invalid?.(reason);
    if (this.#kind === "angle") doubt?.(ifDegrees(text, units()));
    return reason === null ? value : undefined;
  }
}
