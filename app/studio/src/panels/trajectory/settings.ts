/** Law and limits of the whole motion. */

import type { Joint } from "../../robot/model.ts";
import { DIRECTIONS } from "../../types.ts";
import { element, toggle } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { format, type Kind } from "../../ui/quantity.ts";
import type { JointLimits } from "./answer.ts";
import type { Draft } from "./draft.ts";
import { choice, type Field, jointTable, kindOf, optional, unitsOf } from "./fields.ts";
import { LAWS, type Motion, type NearSingularity, USUAL_LAW } from "./motion.ts";

const NEAR: readonly { value: NearSingularity; text: string }[] = [
  { value: "stop", text: "Stop" },
  { value: "damp", text: "Damp the joints" },
  { value: "slow_down", text: "Slow down" },
];
const NUMBERS = [
  { name: "duration", title: "Duration", unit: "s", left: "shortest" },
  { name: "velocity_scale", title: "Velocity scale", unit: "", left: "1" },
  { name: "acceleration_scale", title: "Acceleration scale", unit: "", left: "1" },
  { name: "sample_period", title: "Sample period", unit: "s", left: "0.01" },
  { name: "path_tolerance", title: "Path tolerance", unit: "m", left: "0.0001" },
  { name: "orientation_tolerance", title: "Turn tolerance", unit: "rad", left: "0.001" },
  { name: "min_singular_value", title: "Singular below σ", unit: "", left: "0.01" },
] as const;
const OF_THE_TIP = [
  { name: "tip_velocity", title: "Tip velocity", unit: "m/s" },
  { name: "tip_acceleration", title: "Tip acceleration", unit: "m/s²" },
  { name: "tip_angular_velocity", title: "Tip turning", unit: "rad/s" },
  { name: "tip_angular_acceleration", title: "its acceleration", unit: "rad/s²" },
] as const;
const OF_JOINTS = [
  { name: "joint_velocity", title: "Velocity", per: "/s" },
  { name: "joint_acceleration", title: "Acceleration", per: "/s²" },
  { name: "joint_jerk", title: "Jerk", per: "/s³" },
] as const;

/** Where a limit is from while no plan has told it. */
const UNKNOWN: Record<keyof JointLimits, string> = {
  joint_velocity: "robot’s own",
  joint_acceleration: "assumed",
  joint_jerk: "assumed",
};

export class Settings {
  readonly host: HTMLElement;
  #summary = element("span", { class: "muted small" });
  #body = element("div", { class: "settings-body" });
  #shows: ((motion: Motion) => void)[] = [];
  #shape = "";
  #used: JointLimits | null = null;

  constructor(private readonly draft: Draft) {
    this.host = element(
      "details",
      { class: "law" },
      element("summary", {}, "Law and limits ", this.#summary),
      this.#body,
    );
  }

  /** As the motion is; with the limits of the joints that the last answer went by, or null. */
  update(used: JointLimits | null): void {
    const { motion, chain, degrees } = this.draft;
    this.#used = used && unscaled(used, motion);
    const shape = JSON.stringify([chain.model.title, chain.joints.map(({ name }) => name), degrees, this.#used]);
    if (shape !== this.#shape && !this.#body.contains(document.activeElement)) {
      this.#shape = shape;
      this.#build();
    }
    for (const show of this.#shows) show(motion);
    this.#summary.textContent = summary(motion);
  }

  #build(): void {
    this.#shows = [];
    this.#body.replaceChildren(
      element("div", { class: "settings thirds" }, this.#law(), this.#near(), ...this.#numbers()),
      this.#task(),
      this.#timing(),
      element("div", { class: "settings" }, ...this.#tip()),
      this.#joints(),
    );
  }

  #follow<T>(field: Field<T>, value: (motion: Motion) => T): HTMLElement {
    this.#shows.push((motion) => field.show(value(motion)));
    return field.host;
  }

  #law(): HTMLElement {
    const field = choice("Law of time", "Law of time", LAWS, (law) => this.draft.set({ law }));
    return this.#follow(field, ({ law }) => law ?? USUAL_LAW);
  }

  #near(): HTMLElement {
    const change = (near_singularity: NearSingularity) => this.draft.set({ near_singularity });
    const field = choice("Near a singularity", "Near a singularity", NEAR, change);
    return this.#follow(field, ({ near_singularity }) => near_singularity ?? "stop");
  }

  /** The directions in which a way of the tip counts: with fewer the arm has freedom. */
  #task(): HTMLElement {
    const task = () => this.draft.motion.task ?? DIRECTIONS;
    const toggles = DIRECTIONS.map((direction) => {
      const flip = () => {
        const wanted = DIRECTIONS.filter((one) => (one === direction) !== task().includes(one));
        if (wanted.length) this.draft.set({ task: wanted.length < DIRECTIONS.length ? wanted : undefined });
      };
      const made = toggle(direction, `Whether the way counts in ${direction}`, flip);
      this.#shows.push(() => made.setAttribute("aria-pressed", String(task().includes(direction))));
      return made;
    });
    return element(
      "div",
      { class: "bar", role: "group", "aria-label": "Directions in which the way counts" },
      element("span", { class: "field" }, "The way counts in"),
      ...toggles,
    );
  }

  #timing(): HTMLElement {
    const flip = () => this.draft.set({ compare_timing: this.draft.motion.compare_timing ? undefined : true });
    const made = toggle(
      "Compare with time-optimal",
      "How long each way takes by its law, and how long at least within the same limits",
      flip,
    );
    this.#shows.push(({ compare_timing }) => made.setAttribute("aria-pressed", String(compare_timing === true)));
    return element("div", { class: "bar" }, made);
  }

  #numbers(): HTMLElement[] {
    return NUMBERS.map(({ name, title, unit, left }) => {
      const field = optional(title, title, unit, left, (value) => this.draft.set({ [name]: value }));
      return this.#follow(field, (motion) => motion[name]);
    });
  }

  #tip(): HTMLElement[] {
    return OF_THE_TIP.map(({ name, title, unit }) => {
      const label = name === "tip_angular_acceleration" ? "Acceleration of the tip's turning" : title;
      const field = optional(title, label, unit, "none", (value) => this.draft.limit({ [name]: value }));
      return this.#follow(field, ({ limits }) => limits?.[name]);
    });
  }

  /** The placeholders are what holds where nothing is written. */
  #joints(): HTMLElement {
    const { joints } = this.draft.chain;
    const columns = OF_JOINTS.map(({ name, title, per }) => ({
      ...{ title, unit: unitsOf(joints, this.draft.degrees, per) },
      control: (joint: Joint, index: number) =>
        this.#jointLimit(name, `${joint.name}, ${title.toLowerCase()}`, joint.name, index, kindOf(joint)),
    }));
    return jointTable("Limits of joints", joints, columns);
  }

  #jointLimit(name: keyof JointLimits, label: string, joint: string, index: number, kind: Kind): HTMLElement {
    const field = new NumberField({
      label,
      kind,
      degrees: () => this.draft.degrees,
      decimals: 3,
      optional: true,
      change: (value) => {
        const others = Object.entries(this.draft.motion.limits?.[name] ?? {}).filter(([other]) => other !== joint);
        const all = value === null ? others : [...others, [joint, value] as const];
        this.draft.limit({ [name]: all.length ? Object.fromEntries(all) : undefined });
      },
    });
    const used = this.#used?.[name][index];
    field.input.placeholder = used === undefined ? UNKNOWN[name] : format(used, kind, this.draft.degrees, 3);
    this.#shows.push(({ limits }) => field.set(limits?.[name]?.[joint] ?? null));
    return field.input;
  }
}

/** The limits of an answer without the scales of the motion, which are told in fields of their own. */
function unscaled(limits: JointLimits, { velocity_scale = 1, acceleration_scale = 1 }: Motion): JointLimits {
  const by = (scale: number) => (value: number) => value / scale;
  return {
    joint_velocity: limits.joint_velocity.map(by(velocity_scale)),
    joint_acceleration: limits.joint_acceleration.map(by(acceleration_scale)),
    joint_jerk: limits.joint_jerk.map(by(acceleration_scale)),
  };
}

function summary(motion: Motion): string {
  const { law = USUAL_LAW, velocity_scale, acceleration_scale, duration, limits, near_singularity } = motion;
  const said = [
    LAWS.find(({ value }) => value === law)!.text.toLowerCase(),
    velocity_scale !== undefined && `velocity × ${velocity_scale}`,
    acceleration_scale !== undefined && `acceleration × ${acceleration_scale}`,
    duration !== undefined && `in ${duration} s`,
    near_singularity && near_singularity !== "stop" && `near a singularity ${near_singularity.replace("_", " ")}`,
    Object.keys(limits ?? {}).some((name) => name !== "joint_torque") && "limits of its own",
    motion.task && `counts in ${motion.task.join(" ")}`,
  ];
  return said.filter(Boolean).join(" · ");
}
