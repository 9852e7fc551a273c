/** Settings with their titles, and the fields of a place. */

import { asMatrix, isPose, orientation, position } from "../../robot/pose.ts";
import { type Joint, kindOf } from "../../robot/model.ts";
import { t } from "../../texts/index.ts";
import { button, element, explained } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { format, type Kind, kindOfUnit, shownUnit, type Units, unitOf, withUnit } from "../../ui/quantity.ts";
import type { Place } from "./motion.ts";

/** Something to fill in that can show another value without being built anew, so that the focus stays. */
export interface Field<T> {
  host: HTMLElement;
  show(value: T): void;
}

/** A title above a control, and its unit behind it. */
export function titled(title: string, control: HTMLElement, unit = ""): HTMLElement {
  const made = element(
    "label",
    { class: "setting" },
    element("span", { class: "field" }, title, unit && element("span", { class: "unit" }, ` [${unit}]`)),
    control,
  );
  return explained(made, title);
}

export function choice<T extends string>(
  title: string,
  label: string,
  options: readonly { value: T; text: string }[],
  change: (value: T) => void,
): Field<T> {
  const select = element(
    "select",
    { class: "select", "aria-label": label, onchange: () => change(select.value as T) },
    ...options.map(({ value, text }) => element("option", { value }, text)),
  );
  return { host: titled(title, select), show: (value) => (select.value = value) };
}

/**
 * A number that may be left out: the placeholder then says what holds.
 *
 * @param unit of the service; a function where that changes.
 * @param left what holds then: a number in that unit, or words.
 * @param name the field of the request, where the service's word on it is shown.
 */
export function optional(
  title: string,
  label: string,
  unit: string | (() => string),
  left: string | number,
  units: () => Units,
  change: (value: number | undefined) => void,
  name = "",
): Field<number | undefined> {
  const unitNow = () => (typeof unit === "function" ? unit() : unit);
  const field = new NumberField({
    label,
    kind: () => kindOfUnit(unitNow()),
    units,
    optional: true,
    change: (value) => change(value ?? undefined),
  });
  field.input.name = name;
  const host = titled(title, field.input, unitNow());
  const show = (value: number | undefined) => {
    const shown = shownUnit(unitNow(), units());
    const place = host.querySelector(".unit");
    if (place) place.textContent = ` [${shown}]`;
    field.input.placeholder = typeof left === "string" ? left : format(left, kindOfUnit(unitNow()), units(), 6);
    field.set(value ?? null);
  };
  return { host, show };
}

/** A row for each joint, and in each column a control of it. */
export function jointTable(
  title: string,
  joints: readonly Joint[],
  columns: readonly { title: string; unit: string; control: (joint: Joint, index: number) => HTMLElement }[],
): HTMLElement {
  const head = columns.map(({ title, unit }) =>
    element("th", { scope: "col" }, title, element("span", { class: "unit" }, ` [${unit}]`)),
  );
  const rows = joints.map((joint, index) =>
    element(
      "tr",
      {},
      element("th", { scope: "row", title: joint.name }, joint.name),
      ...columns.map(({ control }) => element("td", {}, control(joint, index))),
    ),
  );
  return element(
    "table",
    { class: "joint-table" },
    element("thead", {}, element("tr", {}, element("th", { scope: "col" }, title), ...head)),
    element("tbody", {}, ...rows),
  );
}

/** The units of some joints, per a power of the second. */
export function unitsOf(joints: readonly Joint[], units: Units, per: string): string {
  return [...new Set(joints.map((joint) => unitOf(kindOf(joint), units) + per))].join(t(" or "));
}

/** Of what a joint's motor gives. */
export function effortUnit({ type }: Joint): string {
  return type === "prismatic" ? "N" : "N m";
}

export interface PlaceOptions {
  /** What a screen reader says in front of each field. */
  label: string;
  joints: readonly Joint[];
  units: () => Units;
  change: (place: Place) => void;
}

/** The numbers of a configuration or of a pose, each in a field; which of the two it is stays. */
export function placeFields(place: Place, options: PlaceOptions): Field<Place> {
  return isPose(place) ? poseFields(options) : configurationFields(options);
}

function configurationFields({ label, joints, units, change }: PlaceOptions): Field<Place> {
  let shown: number[] = [];
  const fields = joints.map((joint, index) => {
    const kind = kindOf(joint);
    const title = `${label}, ${joint.name}`;
    return numberField(title, kind, units, (value) => change(shown.map((old, i) => (i === index ? value : old))));
  });
  const cells = fields.map((field, i) =>
    element(
      "label",
      { class: "number-cell", title: joints[i]!.name },
      element("span", { class: "field" }, `q${i + 1}`),
      field.input,
    ),
  );
  return {
    host: element("div", { class: "place" }, ...cells),
    show: (place) => {
      shown = place as number[];
      for (const [index, field] of fields.entries()) field.set(shown[index] ?? 0);
    },
  };
}

function poseFields({ label, units, change }: PlaceOptions): Field<Place> {
  let shown: number[] = [];
  const fields = COORDINATES.map(({ name, kind }, index) =>
    numberField(`${label}, ${name}`, kind, units, (value) => {
      const numbers = shown.map((old, i) => (i === index ? value : old));
      change({ position: numbers.slice(0, 3), rpy: numbers.slice(3) });
    }),
  );
  const cells = fields.map((field, i) =>
    element("label", { class: "number-cell" }, element("span", { class: "field" }, COORDINATES[i]!.name), field.input),
  );
  return {
    host: element("div", { class: "place pose-place" }, ...cells),
    show: (place) => {
      shown = coordinates(place);
      for (const [index, field] of fields.entries()) field.set(shown[index]!);
    },
  };
}

const COORDINATES: readonly { name: string; kind: Kind }[] = [
  { name: "x", kind: "length" },
  { name: "y", kind: "length" },
  { name: "z", kind: "length" },
  { name: "roll", kind: "angle" },
  { name: "pitch", kind: "angle" },
  { name: "yaw", kind: "angle" },
];

/** x y z and roll pitch yaw; the very numbers where the pose is written so. */
function coordinates(place: Place): number[] {
  if (!isPose(place)) return [];
  if (place.position && place.rpy) return [...place.position, ...place.rpy];
  const T = asMatrix(place);
  return [...position(T), ...(orientation(T, "rpy") as number[])];
}

function numberField(label: string, kind: Kind, units: () => Units, change: (value: number) => void): NumberField {
  return new NumberField({
    label,
    kind,
    units,
    change: (value) => {
      if (value !== null) change(value);
    },
  });
}

/** A place in a line: a configuration in its joints' units, of a pose where it is. */
export function told(place: Place, joints: readonly Joint[], units: Units): string {
  if (isPose(place)) {
    const numbers = coordinates(place).slice(0, 3);
    return withUnit(numbers.map((value) => format(value, "length", units, 3)).join(", "), "length", units);
  }
  const unit = new Set(joints.map((joint) => unitOf(kindOf(joint), units)));
  const numbers = place.map((value, i) => format(value, kindOf(joints[i]!), units, 2));
  return unit.size === 1 ? `${numbers.join(", ")} ${[...unit][0]}` : numbers.join(", ");
}

export function icon(text: string, label: string, press: () => void, isOff = false): HTMLButtonElement {
  return button(text, press, { class: "icon", "aria-label": label, title: label, disabled: isOff });
}
