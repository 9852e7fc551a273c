/** Base and tool of a DH table: where frame 0 stands in the base, and the tool in the last frame. */

import { asMatrix, asPose, position } from "../../robot/pose.ts";
import { t, within } from "../../texts/index.ts";
import type { DhTable, Pose } from "../../types.ts";
import { Choice, element } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import { NumberField } from "../../ui/number.ts";
import { type Units, unitOf } from "../../ui/quantity.ts";
import type { Place } from "./rows.ts";

type Angles = "rpy" | "zyz";
type Cell = "position" | Angles;

const NOTATIONS: readonly { value: Angles; text: string }[] = [
  { value: "rpy", text: t("Roll pitch yaw") },
  { value: "zyz", text: t("Euler ZYZ") },
];
const NAMES: Record<Cell, readonly string[]> = {
  position: ["x", "y", "z"],
  rpy: ["roll", "pitch", "yaw"],
  zyz: ["φ", "ϑ", "ψ"],
};
const ENDS = [
  { end: "base", title: t("Base"), latex: "T^{\\mathrm{base}}_{0}" },
  { end: "tool", title: t("Tool"), latex: "T^{n}_{\\mathrm{tool}}" },
] as const;

export class Places {
  readonly host: HTMLElement;
  #places: readonly PlaceFields[];

  /** @param edited is told of the new pose of an end; undefined for the identity. */
  constructor(edited: (end: "base" | "tool", pose: Pose | undefined) => void, units: () => Units) {
    this.#places = ENDS.map(
      ({ end, title, latex }) => new PlaceFields(title, latex, units, (pose) => edited(end, pose)),
    );
    this.host = element(
      "details",
      { class: "places" },
      element("summary", {}, t("Base and tool")),
      ...this.#places.map(({ host }) => host),
    );
  }

  build(table: DhTable): void {
    for (const [index, { end }] of ENDS.entries()) this.#places[index]!.build(table[end] ?? {});
    if (table.base || table.tool) this.host.setAttribute("open", "");
  }

  /** Show what the service says at the cells it speaks of; returns what is at neither end. */
  fail(places: readonly Place[]): Place[] {
    const at = (end: string) => places.filter(({ pointer }) => pointer.startsWith(`#/dh/${end}`));
    for (const [index, { end }] of ENDS.entries()) this.#places[index]!.fail(at(end));
    const found = ENDS.flatMap(({ end }) => at(end));
    if (found.length) this.host.setAttribute("open", "");
    return places.filter((place) => !found.includes(place));
  }
}

class PlaceFields {
  readonly host: HTMLElement;
  #pose: Pose = {};
  #angles: Angles = "rpy";
  #fields = new Map<string, NumberField>();
  #unread = new Map<string, string>();
  #refused = new Map<string, string>();
  #grid = element("div", { class: "table-place-fields" });
  #error = element("div", { class: "table-place-error", role: "alert", hidden: true });
  #notation: Choice<Angles>;

  constructor(
    private readonly title: string,
    latex: string,
    private readonly units: () => Units,
    private readonly edited: (pose: Pose | undefined) => void,
  ) {
    this.#notation = new Choice(t("Orientation of the {title}", { title: within(title) }), NOTATIONS, (chosen) => {
      this.#angles = chosen;
      this.#fill();
    });
    this.host = element(
      "div",
      { class: "table-place" },
      element(
        "div",
        { class: "bar" },
        element("span", {}, `${title} `, formula(latex)),
        element("span", { class: "spring" }),
        this.#notation.host,
      ),
      this.#grid,
      this.#error,
    );
  }

  build(pose: Pose): void {
    this.#pose = pose;
    if (pose.zyz || pose.rpy) this.#angles = pose.zyz ? "zyz" : "rpy";
    this.#fill();
  }

  fail(places: readonly Place[]): void {
    this.#refused = new Map(
      places.map(({ pointer, detail }) => [pointer.split("/").slice(3).join(" "), detail] as const),
    );
    this.#showErrors();
  }

  #fill(): void {
    this.#notation.show(this.#angles);
    this.#fields.clear();
    this.#unread.clear();
    this.#refused.clear();
    this.#grid.replaceChildren(...this.#row("position"), ...this.#row(this.#angles));
    this.#showErrors();
  }

  #row(cell: Cell): HTMLElement[] {
    const kind = cell === "position" ? "length" : "angle";
    const values = valuesOf(this.#pose, cell);
    const fields = NAMES[cell].map((name, index) => {
      const key = `${cell} ${index}`;
      const field = new NumberField({
        label: `${this.title}, ${name}`,
        kind,
        units: this.units,
        live: true,
        change: (value) => this.#change(cell, index, value!),
        invalid: (reason) => {
          if (reason === null) this.#unread.delete(key);
          else this.#unread.set(key, reason);
          this.#showErrors();
        },
      });
      field.set(values[index]!);
      this.#fields.set(key, field);
      return element("span", { class: "detail" }, name, field.input);
    });
    return [...fields, element("span", { class: "unit" }, unitOf(kind, this.units()))];
  }

  #change(cell: Cell, index: number, value: number): void {
    const values = [...valuesOf(this.#pose, cell)];
    values[index] = value;
    this.#pose =
      cell === "position" ? moved(this.#pose, values) : { position: position(asMatrix(this.#pose)), [cell]: values };
    if (this.#unread.size === 0) this.edited(isIdentity(this.#pose) ? undefined : this.#pose);
  }

  #showErrors(): void {
    const found = new Map([...this.#refused, ...this.#unread]);
    for (const [key, field] of this.#fields) field.fail(found.get(key) ?? null);
    this.#error.hidden = found.size === 0;
    const nameOf = (key: string) => this.#fields.get(key)?.input.getAttribute("aria-label") ?? this.title;
    this.#error.replaceChildren(...[...found].map(([key, text]) => element("p", {}, `${nameOf(key)}: ${text}`)));
  }
}

/** The three numbers of a pose, to the last digit where it is written in them. */
function valuesOf(pose: Pose, cell: Cell): readonly number[] {
  const own = pose[cell];
  if (own) return own;
  const T = asMatrix(pose);
  return cell === "position" ? position(T) : asPose(T, cell)[cell]!;
}

/** The same orientation elsewhere. */
function moved(pose: Pose, to: number[]): Pose {
  if (pose.matrix) return { matrix: pose.matrix.map((row, i) => (i < 3 ? [...row.slice(0, 3), to[i]!] : row)) };
  const isTurned = Object.keys(pose).some((key) => key !== "position");
  return { ...(isTurned ? pose : { rpy: [0, 0, 0] }), position: to };
}

function isIdentity(pose: Pose): boolean {
  return asMatrix(pose).elements.every((value, index) => value === (index % 5 === 0 ? 1 : 0));
}
