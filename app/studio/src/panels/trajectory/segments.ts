/** The start and the segments in their order: each a line that opens into what can be changed about it. */

import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { chosenOf, measured } from "../../ui/quantity.ts";
import type { Draft } from "./draft.ts";
import { Editor } from "./editor.ts";
import { icon, placeFields, told } from "./fields.ts";
import { isIn, type Refused } from "./folded.ts";
import { added, isOpen, type Place, places, type Segment, type SegmentType, TYPES } from "./motion.ts";

const START = -1;

interface Line {
  host: HTMLElement;
  /** As the motion is now. */
  show(): void;
  /** What the service has against it; nothing where empty. */
  fail(text: string): void;
}

export class SegmentList {
  readonly host: HTMLElement;
  #list = element("ol", { class: "segments" });
  #add = new Map<SegmentType, HTMLButtonElement>();
  #lines: Line[] = [];
  #open: number | null = null;
  #shape = "";

  /** @param opened is told that another segment is open. */
  constructor(
    private readonly draft: Draft,
    private readonly opened: () => void,
  ) {
    for (const { value } of TYPES) {
      this.#add.set(
        value,
        button("", () => this.#append(value), { class: "button add" }),
      );
    }
    this.host = element(
      "div",
      { class: "part" },
      this.#list,
      element(
        "div",
        { class: "bar adds", role: "group", "aria-label": t("Add the present pose as") },
        element("span", { class: "field" }, t("Add the present pose as")),
        ...this.#add.values(),
      ),
    );
  }

  /** Which segment is open, −1 for the start, null for none. */
  get open(): number | null {
    return this.#open;
  }

  /** As the motion is now; lines that stay are not built anew, so that the focus stays too. */
  update(): void {
    const { motion, chain, units } = this.draft;
    const shape = JSON.stringify([
      motion.segments.map((segment) => [
        segment.type,
        places(segment).map((place) => Array.isArray(place)),
        segment.times !== undefined,
      ]),
      [motion.robot, motion.base_frame, motion.tip_frame, this.#open, chosenOf(units)],
    ]);
    if (shape !== this.#shape) {
      this.#shape = shape;
      this.#lines = [this.#startLine(), ...motion.segments.map((_, index) => this.#segmentLine(index))];
      this.#list.replaceChildren(...this.#lines.map(({ host }) => host));
    }
    for (const line of this.#lines) line.show();
    const last = motion.segments.at(-1);
    const titles: Record<SegmentType, string> = {
      joint: t("Joint target"),
      line: t("Line"),
      circle: isOpen(last) ? t("Circle target") : t("Circle via"),
      spline: last?.type === "spline" ? t("Waypoint") : t("Spline"),
    };
    for (const [type, made] of this.#add) {
      made.textContent = titles[type];
      made.disabled = chain.joints.length === 0 || (isOpen(last) && type !== "circle");
    }
  }

  /** Show what the service has against the start and segments; returns the rest. */
  fail(places: readonly Refused[]): Refused[] {
    for (const line of this.#lines) line.fail("");
    return places.filter(({ pointer, detail }) => {
      const [, index] = /^#\/segments\/(\d+)/.exec(pointer) ?? [];
      const line = isIn(pointer, "start") ? this.#lines[0] : index && this.#lines[Number(index) + 1];
      if (line) line.fail(detail.replace(/^'?#?\/?(segments|start)[^:]*: /, ""));
      return !line;
    });
  }

  #append(type: SegmentType): void {
    const { chain, motion } = this.draft;
    this.draft.set({ segments: added(motion.segments, type, chain) });
  }

  #toggle(index: number): void {
    this.#open = this.#open === index ? null : index;
    this.update();
    this.opened();
    this.#focus(index);
  }

  #move(index: number, by: -1 | 1): void {
    const segments = [...this.draft.motion.segments];
    const [segment] = segments.splice(index, 1);
    segments.splice(index + by, 0, segment!);
    if (this.#open === index) this.#open = index + by;
    else if (this.#open === index + by) this.#open = index;
    this.draft.set({ segments });
    this.#focus(index + by);
  }

  #remove(index: number): void {
    this.#open = null;
    this.draft.set({ segments: this.draft.motion.segments.filter((_, i) => i !== index) });
    this.#focus(Math.min(index, this.draft.motion.segments.length - 1));
  }

  #focus(index: number): void {
    this.#list.querySelectorAll<HTMLElement>(".segment-head")[index + 1]?.focus();
  }

  #startLine(): Line {
    const { draft } = this;
    const fields = placeFields(draft.motion.start, {
      label: t("Start"),
      joints: draft.chain.joints,
      units: () => draft.units,
      change: (place) => draft.set({ start: place as number[] }),
    });
    const small = { class: "button small" };
    const actions = element(
      "div",
      { class: "bar" },
      button(t("Set to the present pose"), () => draft.set({ start: draft.chain.configuration }), small),
      button(t("Go there"), () => draft.goTo(draft.motion.start), small),
    );
    const show = () => {
      fields.show(draft.motion.start);
      return told(draft.motion.start, draft.chain.joints, draft.units);
    };
    return this.#line(START, t("Start"), element("div", { class: "segment-body" }, fields.host, actions), [], show);
  }

  #segmentLine(index: number): Line {
    const { draft } = this;
    const { type } = draft.motion.segments[index]!;
    const last = draft.motion.segments.length - 1;
    const editor = this.#open === index ? new Editor(draft, index) : null;
    const number = index + 1;
    const tools = [
      icon("↑", t("Move segment {number} up", { number }), () => this.#move(index, -1), index === 0),
      icon("↓", t("Move segment {number} down", { number }), () => this.#move(index, 1), index === last),
      icon("×", t("Remove segment {number}", { number }), () => this.#remove(index)),
    ];
    const show = () => {
      editor?.show();
      return summary(draft.motion.segments[index]!, draft);
    };
    return this.#line(index, TYPES.find(({ value }) => value === type)!.text, editor?.host ?? null, tools, show);
  }

  /** @param show brings the body up to date, and says the whole in a few words. */
  #line(index: number, title: string, body: HTMLElement | null, tools: HTMLElement[], show: () => string): Line {
    const isOpen = this.#open === index;
    const text = element("span", { class: "segment-text" });
    const error = element("p", { class: "segment-error", role: "alert", hidden: true });
    const head = button("", () => this.#toggle(index), { class: "segment-head", "aria-expanded": String(isOpen) });
    head.append(
      element("span", { class: "segment-number" }, index === START ? "" : String(index + 1)),
      element("span", { class: "segment-type" }, title),
      text,
    );
    const line = element("div", { class: "segment-line" }, head, ...tools);
    return {
      host: element("li", { class: "segment" }, line, isOpen && body, error),
      show: () => (text.textContent = show()),
      fail: (found) => {
        error.hidden = found === "";
        error.textContent = found;
      },
    };
  }
}

/** A segment in a line. */
function summary(segment: Segment, { chain, units }: Draft): string {
  const say = (place: Place) => told(place, chain.joints, units);
  const { via, target, waypoints, blends, blend_radius, blend_time, blend_acceleration } = segment;
  if (waypoints)
    return waypoints.length === 1
      ? t("to {waypoints}", { waypoints: say(waypoints[0]!) })
      : blends
        ? t("{length} waypoints, blended, to {waypoints}", {
            length: waypoints.length,
            waypoints: say(waypoints.at(-1)!),
          })
        : t("{length} waypoints, to {waypoints}", { length: waypoints.length, waypoints: say(waypoints.at(-1)!) });
  if (via) return target ? t("to {target}", { target: say(target) }) : t("its target is missing");
  const blend = [
    blend_radius && t(", blended at {blend_radius}", { blend_radius: measured(blend_radius, "length", units, 6) }),
    blend_time && t(", blended in {blend_time} s", { blend_time }),
    blend_acceleration &&
      t(", blended with {blend_acceleration}/s²", {
        blend_acceleration: measured(blend_acceleration, "length", units, 6),
      }),
  ].find(Boolean);
  return t("to {target}{blend}", { target: say(target!), blend: blend ?? "" });
}
