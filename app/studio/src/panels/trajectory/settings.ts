/** Law and limits of the whole motion. */

import { type Joint, kindOf } from "../../robot/model.ts";
import { t, within } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import { DIRECTIONS } from "../../types.ts";
import { element, explained, toggle } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { chosenOf, format, type Kind } from "../../ui/quantity.ts";
import type { JointLimits } from "./answer.ts";
import type { Draft } from "./draft.ts";
import { choice, type Field, jointTable, optional, unitsOf } from "./fields.ts";
import { LAWS, type Motion, type NearSingularity, USUAL_LAW } from "./motion.ts";

const NEAR: readonly { value: NearSingularity; text: string }[] = [
  { value: "stop", text: t("Stop") },
  { value: "damp", text: t("Damp the joints") },
  { value: "slow_down", text: t("Slow down") },
];
const NUMBERS = [
  { name: "duration", title: t("Duration"), unit: "s", left: t("shortest") },
  { name: "velocity_scale", title: t("Velocity scale"), unit: "", left: 1 },
  { name: "acceleration_scale", title: t("Acceleration scale"), unit: "", left: 1 },
  { name: "sample_period", title: t("Sample period"), unit: "s", left: 0.01 },
  { name: "path_tolerance", title: t("Path tolerance"), unit: "m", left: 0.0001 },
  { name: "orientation_tolerance", title: t("Turn tolerance"), unit: "rad", left: 0.001 },
  { name: "min_singular_value", title: t("Singular below σ"), unit: "", left: 0.01 },
] as const;
const OF_THE_TIP = [
  { name: "tip_velocity", title: t("Tip velocity"), unit: "m/s" },
  { name: "tip_acceleration", title: t("Tip acceleration"), unit: "m/s²" },
  { name: "tip_angular_velocity", title: t("Tip turning"), unit: "rad/s" },
  { name: "tip_angular_acceleration", title: t("its acceleration"), unit: "rad/s²" },
] as const;
const OF_JOINTS = [
  { name: "joint_velocity", title: t("Velocity"), per: "/s" },
  { name: "joint_acceleration", title: t("Acceleration"), per: "/s²" },
  { name: "joint_jerk", title: t("Jerk"), per: "/s³" },
] as const;

/** Where a limit is from while no plan has told it. */
const UNKNOWN: Record<keyof JointLimits, string> = {
  joint_velocity: t("robot’s own"),
  joint_acceleration: t("assumed"),
  joint_jerk: t("assumed"),
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
      element("summary", {}, t("Law and limits "), this.#summary),
      this.#body,
    );
  }

  /** As the motion is; with the limits of the joints that the last answer went by, or null. */
  update(used: JointLimits | null): void {
    const { motion, chain, units } = this.draft;
    this.#used = used && unscaled(used, motion);
    const shape = JSON.stringify([
      chain.model.title,
      chain.joints.map(({ name }) => name),
      chosenOf(units),
      this.#used,
    ]);
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
    const field = choice(t("Law of time"), t("Law of time"), LAWS, (law) => this.draft.set({ law }));
    return this.#follow(field, ({ law }) => law ?? USUAL_LAW);
  }

  #near(): HTMLElement {
    const change = (near_singularity: NearSingularity) => this.draft.set({ near_singularity });
    const field = choice(t("Near a singularity"), t("Near a singularity"), NEAR, change);
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
      const made = toggle(direction, t("Whether the way counts in {direction}", { direction }), flip);
      this.#shows.push(() => made.setAttribute("aria-pressed", String(task().includes(direction))));
      return made;
    });
    return element(
      "div",
      { class: "bar", role: "group", "aria-label": t("Directions in which the way counts") },
      explained(element("span", { class: "field" }, t("The way counts in")), t("The way counts in")),
      ...toggles,
    );
  }

  #timing(): HTMLElement {
    const flip = () => this.draft.set({ compare_timing: this.draft.motion.compare_timing ? undefined : true });
    const made = toggle(
      t("Compare with time-optimal"),
      t("How long each way takes by its law, and how long at least within the same limits"),
      flip,
    );
    this.#shows.push(({ compare_timing }) => made.setAttribute("aria-pressed", String(compare_timing === true)));
    return element("div", { class: "bar" }, made);
  }

  #numbers(): HTMLElement[] {
    return NUMBERS.map(({ name, title, unit, left }) => {
      const field = optional(
        title,
        title,
        unit,
        left,
        () => this.draft.units,
        (value) => this.draft.set({ [name]: value }),
      );
      return this.#follow(field, (motion) => motion[name]);
    });
  }

  #tip(): HTMLElement[] {
    return OF_THE_TIP.map(({ name, title, unit }) => {
      const label = name === "tip_angular_acceleration" ? t("Acceleration of the tip's turning") : title;
      const field = optional(
        title,
        label,
        unit,
        t("none"),
        () => this.draft.units,
        (value) => this.draft.limit({ [name]: value }),
      );
      return this.#follow(field, ({ limits }) => limits?.[name]);
    });
  }

  /** The placeholders are what holds where nothing is written. */
  #joints(): HTMLElement {
    const { joints } = this.draft.chain;
    const columns = OF_JOINTS.map(({ name, title, per }) => ({
      ...{ title, unit: unitsOf(joints, this.draft.units, per) },
      control: (joint: Joint, index: number) =>
        this.#jointLimit(name, `${joint.name}, ${within(title)}`, joint.name, index, kindOf(joint)),
    }));
    return jointTable(t("Limits of joints"), joints, columns);
  }

  #jointLimit(name: keyof JointLimits, label: string, joint: string, index: number, kind: Kind): HTMLElement {
    const field = new NumberField({
      label,
      kind,
      units: () => this.draft.units,
      decimals: 3,
      optional: true,
      change: (value) => {
        const others = Object.entries(this.draft.motion.limits?.[name] ?? {}).filter(([other]) => other !== joint);
        const all = value === null ? others : [...others, [joint, value] as const];
        this.draft.limit({ [name]: all.length ? Object.fromEntries(all) : undefined });
      },
    });
    const used = this.#used?.[name][index];
    field.input.placeholder = used === undefined ? UNKNOWN[name] : format(used, kind, this.draft.units, 3);
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
    word(law),
    velocity_scale !== undefined && t("velocity × {velocity_scale}", { velocity_scale }),
    acceleration_scale !== undefined && t("acceleration × {acceleration_scale}", { acceleration_scale }),
    duration !== undefined && t("in {duration} s", { duration }),
    near_singularity &&
      near_singularity !== "stop" &&
      t("near a singularity {near_singularity}", { near_singularity: word(near_singularity) }),
    Object.keys(limits ?? {}).some((name) => name !== "joint_torque") && t("limits of its own"),
    motion.task && t("counts in {task}", { task: motion.task.join(" ") }),
  ];
  return said.filter(Boolean).join(" · ");
}
