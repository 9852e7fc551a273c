/** What can be changed about one segment: its type, where it leads, how it goes there. */

import { isPose } from "../../robot/pose.ts";
import { t, within } from "../../texts/index.ts";
import { Choice, button, element } from "../../ui/dom.ts";
import type { Draft } from "./draft.ts";
import { NumberField } from "../../ui/number.ts";
import { shownUnit, type Units } from "../../ui/quantity.ts";
import { choice, type Field, icon, optional, placeFields } from "./fields.ts";
import {
  asPoseOf,
  type Boundary,
  converted,
  LAWS,
  type Law,
  type OrientationLaw,
  type Place,
  presentPose,
  type Segment,
  type SegmentType,
  TYPES,
} from "./motion.ts";

const PASSED = [
  { value: "soon", text: t("As soon as limits allow") },
  { value: "timed", text: t("At given times") },
] as const;

const WAYS = [
  { value: "spline", text: t("A cubic spline") },
  { value: "blends", text: t("Lines with blends") },
] as const;

type Blend = "blend_radius" | "blend_time" | "blend_acceleration";

const BLENDS: readonly { value: Blend; text: string; unit: string }[] = [
  { value: "blend_radius", text: t("Radius"), unit: "m" },
  { value: "blend_time", text: t("Time"), unit: "s" },
  { value: "blend_acceleration", text: t("Acceleration"), unit: "m/s²" },
];
const ORIENTATIONS: readonly { value: OrientationLaw; text: string }[] = [
  { value: "axis_angle", text: t("One axis") },
  { value: "zyz", text: t("Euler ZYZ") },
  { value: "zyz_other", text: t("ZYZ, other") },
];
const BOUNDARIES: readonly { value: Boundary; text: string }[] = [
  { value: "clamped", text: t("At rest (clamped)") },
  { value: "natural", text: t("No acceleration (natural)") },
  { value: "not_a_knot", text: t("Not a knot") },
  { value: "periodic", text: t("Periodic") },
  { value: "assigned", text: t("At rest, no acceleration") },
];

export class Editor {
  readonly host = element("div", { class: "segment-body" });
  #shows: ((segment: Segment) => void)[] = [];

  constructor(
    private readonly draft: Draft,
    private readonly index: number,
  ) {
    const { type } = this.#segment;
    this.host.append(
      element("div", { class: "settings" }, this.#type(), this.#law()),
      ...this.#places(),
      ...(type === "line" || type === "circle" ? [this.#path(type)] : []),
      type === "spline"
        ? element("div", { class: "settings" }, ...this.#spline(), ...this.#pace())
        : element("div", { class: "settings thirds" }, ...this.#pace()),
    );
  }

  show(): void {
    for (const show of this.#shows) show(this.#segment);
  }

  get #segment(): Segment {
    return this.draft.motion.segments[this.index]!;
  }

  get #name(): string {
    return t("Segment {index}", { index: this.index + 1 });
  }

  #edit(patch: { [K in keyof Segment]?: Segment[K] | undefined }): void {
    this.draft.edit(this.index, (segment) => ({ ...segment, ...patch }) as Segment);
  }

  #follow<T>(field: Field<T>, value: (segment: Segment) => T): HTMLElement {
    this.#shows.push((segment) => field.show(value(segment)));
    return field.host;
  }

  #type(): HTMLElement {
    const change = (type: SegmentType) =>
      this.draft.edit(this.index, (segment) => converted(segment, type, this.draft.chain));
    return this.#follow(choice(t("Type"), t("{name}, type", { name: this.#name }), TYPES, change), ({ type }) => type);
  }

  #law(): HTMLElement {
    const options = [{ value: "" as Law | "", text: t("As the motion") }, ...LAWS];
    const change = (law: Law | "") => this.#edit({ law: law || undefined });
    return this.#follow(
      choice(t("Law"), t("{name}, law", { name: this.#name }), options, change),
      ({ law }) => law ?? "",
    );
  }

  #pace(): HTMLElement[] {
    const fields = [
      { name: "duration", title: t("Duration"), unit: "s", left: t("shortest") },
      { name: "velocity_scale", title: t("Velocity scale"), unit: "", left: 1 },
      { name: "acceleration_scale", title: t("Acceleration scale"), unit: "", left: 1 },
    ] as const;
    return fields.map(({ name, title, unit, left }) => {
      const label = `${this.#name}, ${within(title)}`;
      const field = optional(
        title,
        label,
        unit,
        left,
        () => this.draft.units,
        (value) => this.#edit({ [name]: value }),
      );
      return this.#follow(field, (segment) => segment[name]);
    });
  }

  #places(): HTMLElement[] {
    const { type, waypoints } = this.#segment;
    if (waypoints) return waypoints.map((_, i) => this.#waypoint(i, waypoints.length));
    const target = this.#place(
      t("Target"),
      (segment) => segment.target,
      (place) => this.#edit({ target: place }),
    );
    if (type !== "circle") return [target];
    const via = this.#place(
      t("Via"),
      (segment) => segment.via,
      (place) => this.#edit({ via: asPoseOf(place, this.draft.chain) }),
    );
    return [via, target];
  }

  #waypoint(i: number, count: number): HTMLElement {
    const remove = () => {
      const { waypoints, times } = this.#segment;
      const others = <T>(list: T[]) => list.filter((_, other) => other !== i);
      this.#edit({ waypoints: others(waypoints!), times: times && others(times) });
    };
    return this.#place(
      t("Waypoint {i}", { i: i + 1 }),
      (segment) => segment.waypoints?.[i],
      (place) => this.#edit({ waypoints: this.#segment.waypoints!.map((old, other) => (other === i ? place : old)) }),
      this.#segment.times !== undefined && this.#time(i),
      count > 1 && icon("×", t("{name}, remove waypoint {i}", { name: this.#name, i: i + 1 }), remove),
    );
  }

  /** When a waypoint is passed. */
  #time(i: number): HTMLElement {
    const field = new NumberField({
      label: t("{name}, waypoint {i}, time", { name: this.#name, i: i + 1 }),
      kind: "number",
      units: () => this.draft.units,
      change: (value) => this.#edit({ times: this.#segment.times!.map((old, other) => (other === i ? value! : old)) }),
    });
    this.#shows.push(({ times }) => field.set(times?.[i] ?? null));
    return element(
      "label",
      { class: "passed" },
      element("span", { class: "unit" }, t("at")),
      field.input,
      element("span", { class: "unit" }, "s"),
    );
  }

  /** A place with its numbers; a configuration can be gone to, and either be set to where the robot is. */
  #place(
    title: string,
    read: (segment: Segment) => Place | undefined,
    write: (place: Place) => void,
    ...tools: (HTMLElement | false)[]
  ): HTMLElement {
    const { draft } = this;
    const place = read(this.#segment);
    const label = `${this.#name}, ${within(title)}`;
    const wantsPose = this.#segment.type === "line" || this.#segment.type === "circle";
    const isTip = place ? isPose(place) : wantsPose;
    const set = () => write(isTip ? presentPose(draft.chain) : draft.chain.configuration);
    const go = () => draft.goTo(read(this.#segment) as number[]);
    const small = (text: string, explained: string, press: () => void) =>
      button(text, press, { class: "button small", title: explained, "aria-label": `${text}: ${label}` });
    const head = element(
      "div",
      { class: "bar place-head" },
      element("h3", {}, title),
      this.#segment.times === undefined && element("span", { class: "unit" }, isTip ? t("tip in base") : t("joints")),
      element("span", { class: "spring" }),
      small(t("Set here"), t("Set it to the present pose"), set),
      place && !isTip && small(t("Go"), t("Move the arm there"), go),
      ...tools,
    );
    if (!place) return element("div", { class: "part" }, head);
    const fields = placeFields(place, {
      label,
      joints: draft.chain.joints,
      units: () => draft.units,
      change: write,
    });
    return element(
      "div",
      { class: "part" },
      head,
      this.#follow(fields, (segment) => read(segment) ?? place),
    );
  }

  /** The blend of a line or a circle into the next segment, and how it turns. A circle's blend is given by its radius. */
  #path(type: "line" | "circle"): HTMLElement {
    let kind: Blend = blendOf(this.#segment);
    const write = (value: number | undefined) =>
      this.#edit({ ...Object.fromEntries(BLENDS.map(({ value: name }) => [name, undefined])), [kind]: value });
    const units = () => this.draft.units;
    const unit = () => BLENDS.find(({ value }) => value === kind)!.unit;
    const size = optional(
      t("Blend into the next"),
      t("{name}, blend", { name: this.#name }),
      unit,
      t("none"),
      units,
      write,
    );
    const by = choice(t("by"), t("{name}, blend by", { name: this.#name }), blends(units()), (chosen) => {
      const value = this.#segment[kind];
      kind = chosen;
      if (value !== undefined) write(value);
    });
    this.#shows.push((segment) => {
      if (BLENDS.some(({ value }) => segment[value] !== undefined)) kind = blendOf(segment);
      size.show(segment[kind]);
      by.show(kind);
    });
    const turns = choice(
      t("Orientation"),
      t("{name}, orientation", { name: this.#name }),
      ORIENTATIONS,
      (orientation) => this.#edit({ orientation }),
    );
    const orientation = this.#follow(turns, (segment) => segment.orientation ?? "axis_angle");
    return element("div", { class: "settings thirds" }, size.host, ...(type === "line" ? [by.host] : []), orientation);
  }

  /** Of what, how it ends, and when its waypoints are passed. */
  #spline(): HTMLElement[] {
    const through = new Choice<"joints" | "tip">(
      t("{name}, through", { name: this.#name }),
      [
        { value: "joints", text: t("Joints") },
        { value: "tip", text: t("Tip") },
      ],
      (chosen) => {
        if (chosen === "tip")
          this.#edit({ waypoints: this.#segment.waypoints!.map((place) => asPoseOf(place, this.draft.chain)) });
      },
    );
    const [joints] = through.host.querySelectorAll("button");
    this.#shows.push(({ waypoints }) => {
      const isTip = waypoints!.some(isPose);
      through.show(isTip ? "tip" : "joints");
      joints!.disabled = isTip;
      joints!.title = isTip ? t("A pose can be reached in several ways: add configurations as a new spline") : "";
    });
    const ends = choice(t("At its ends"), t("{name}, at its ends", { name: this.#name }), BOUNDARIES, (boundary) =>
      this.#edit({ boundary }),
    );
    const boundary = this.#follow(ends, (segment) => segment.boundary ?? "clamped");
    const way = choice(t("Between waypoints"), t("{name}, between waypoints", { name: this.#name }), WAYS, (chosen) =>
      this.#edit({ blends: chosen === "blends" || undefined, ...(chosen === "blends" && { boundary: undefined }) }),
    );
    const between = this.#follow(way, ({ blends }) => (blends ? "blends" : "spline"));
    this.#shows.push(({ blends, waypoints }) => {
      boundary.hidden = blends === true;
      between.hidden = !blends && waypoints!.some(isPose); // blends are of the joints
    });
    const passed = choice(
      t("Waypoints are passed"),
      t("{name}, waypoints are passed", { name: this.#name }),
      PASSED,
      (when) => this.#edit({ times: when === "timed" ? this.#segment.waypoints!.map((_, i) => i + 1) : undefined }),
    );
    return [
      element("div", { class: "setting" }, element("span", { class: "field" }, t("A spline of")), through.host),
      between,
      boundary,
      this.#follow(passed, ({ times }) => (times ? "timed" : "soon")),
    ];
  }
}

/** The quantities that a blend is given by, with their units. */
function blends(units: Units): { value: Blend; text: string }[] {
  return BLENDS.map(({ value, text, unit }) => ({ value, text: `${text} [${shownUnit(unit, units)}]` }));
}

function blendOf(segment: Segment): Blend {
  return BLENDS.find(({ value }) => segment[value] !== undefined)?.value ?? "blend_radius";
}
