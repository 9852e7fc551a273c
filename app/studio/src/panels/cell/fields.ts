/** The numbers of the object that is being edited: sizes, place, and how near anything may come. */

import { asPose, position } from "../../robot/pose.ts";
import { placeOf, replaced, type Shape } from "../../scene/objects.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { SceneObject } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { type Kind, unitOf } from "../../ui/quantity.ts";
import { chosenObject } from "./handles.ts";

interface Row {
  title: string;
  kind: Kind;
  /** What stands before each number; a label is `${title} ${name}`. */
  names: readonly string[];
  read: (object: SceneObject) => readonly number[];
  write: (object: SceneObject, values: number[]) => SceneObject;
}

const shaped = (object: SceneObject, shape: Partial<Shape>) =>
  ({ ...object, shape: { ...object.shape, ...shape } }) as SceneObject;
const posed = (object: SceneObject, pose: SceneObject["pose"]): SceneObject => ({ ...object, pose: pose ?? null });
const place = (object: SceneObject) => asPose(placeOf(object), "rpy");

/** Numbers of a shape, by the field that has them. */
function sizes({ type }: Shape): Row[] {
  const one = (field: string, title: string): Row => ({
    title,
    kind: "length",
    names: [""],
    read: ({ shape }) => [Number((shape as unknown as Record<string, number>)[field] ?? 0)],
    write: (object, [value]) => shaped(object, { [field]: value } as Partial<Shape>),
  });
  switch (type) {
    case "box":
      return [
        {
          title: t("Size"),
          kind: "length",
          names: ["x", "y", "z"],
          read: ({ shape }) => (shape as { size: number[] }).size,
          write: (object, size) => shaped(object, { size } as Partial<Shape>),
        },
      ];
    case "sphere":
    case "points":
      return [one("radius", t("Radius"))];
    case "cylinder":
    case "capsule":
      return [one("radius", t("Radius")), one("length", t("Length"))];
    case "half_space":
      return [one("offset", t("Height"))];
    case "mesh":
    case "height_map":
      return [];
  }
}

const PLACE: readonly Row[] = [
  {
    title: t("Position"),
    kind: "length",
    names: ["x", "y", "z"],
    read: (object) => position(placeOf(object)),
    write: (object, values) => posed(object, { ...place(object), position: values }),
  },
  {
    title: t("Orientation"),
    kind: "angle",
    names: ["roll", "pitch", "yaw"],
    read: (object) => place(object).rpy!,
    write: (object, rpy) => posed(object, { ...place(object), rpy }),
  },
];
const CLEARANCE: Row = {
  title: t("Clearance"),
  kind: "length",
  names: [""],
  read: ({ clearance }) => [clearance ?? 0],
  write: (object, [clearance]) => ({ ...object, clearance: clearance! }),
};

export class ObjectFields {
  readonly host = element("div", { class: "target-rows" });
  #shown = "";
  #fields: { row: Row; fields: NumberField[]; unit: HTMLElement }[] = [];
  #frame = element("select", { class: "select", "aria-label": t("Attached to"), onchange: () => this.#attach() });

  constructor(private readonly store: Store<State>) {}

  /** Show the object that is being edited, if one is. */
  show(): void {
    const object = chosenObject(this.store.value);
    const { model } = this.store.value;
    const shown = object ? `${object.name} ${object.shape.type} ${model?.name}` : "";
    if (shown !== this.#shown) this.#build(object);
    this.#shown = shown;
    if (!object) return;
    this.#frame.value = object.attached_to ?? "";
    for (const { row, fields, unit } of this.#fields) {
      unit.textContent = unitOf(row.kind, this.store.value);
      for (const [i, value] of row.read(object).entries()) fields[i]!.set(value);
    }
  }

  #build(object: SceneObject | null): void {
    this.#fields = [];
    this.host.replaceChildren();
    if (!object) return;
    const places = object.shape.type === "half_space" ? [] : PLACE;
    for (const row of [...sizes(object.shape), ...places, CLEARANCE]) this.host.append(this.#row(row));
    const links = this.store.value.model?.links ?? [];
    const rest = element("option", { value: "" }, t("nothing: it is at rest"));
    this.#frame.replaceChildren(rest, ...links.map((link) => element("option", { value: link }, link)));
    this.host.append(
      element(
        "label",
        { class: "target-row" },
        element("span", { class: "target-title" }, t("Attached to")),
        this.#frame,
      ),
      element(
        "div",
        { class: "bar" },
        button(t("Remove"), () => this.#change(() => null), { class: "button danger" }),
      ),
    );
  }

  #row(row: Row): HTMLElement {
    const fields = row.names.map((name, i) => {
      const take = (value: number | null) => {
        if (value === null) return;
        this.#change((object) => row.write(object, [...row.read(object)].with(i, value)));
      };
      return new NumberField({
        label: `${row.title} ${name}`.trim(),
        kind: row.kind,
        units: () => this.store.value,
        change: take,
        step: { by: row.kind === "length" ? 0.01 : Math.PI / 180, take },
      });
    });
    const unit = element("span", { class: "unit" });
    this.#fields.push({ row, fields, unit });
    return element(
      "div",
      { class: "target-row" },
      element("span", { class: "target-title" }, row.title),
      element("span", { class: "target-fields" }, ...fields.map(({ input }) => input)),
      unit,
    );
  }

  /** What hangs on a link may touch it: it is the link that holds it. */
  #attach(): void {
    const { value: frame } = this.#frame;
    this.#change(({ attached_to: _, touch_links: __, ...object }) => ({
      ...object,
      ...(frame ? { attached_to: frame, touch_links: [frame] } : {}),
    }));
  }

  #change(by: (object: SceneObject) => SceneObject | null): void {
    const object = chosenObject(this.store.value);
    if (object) this.store.set({ scene: replaced(this.store.value.scene, object.name, by(object)) });
  }
}
