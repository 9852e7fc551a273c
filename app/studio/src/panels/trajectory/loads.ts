/** What the tip carries, whether the motion keeps to the motors' effort, and whether the torques are shown. */

import { t } from "../../texts/index.ts";
import { element, toggle } from "../../ui/dom.ts";
import type { Draft } from "./draft.ts";
import { optional } from "./fields.ts";
import { Folded } from "./folded.ts";
import { defined, type Motion, type Payload } from "./motion.ts";

const ORIGIN = [0, 0, 0];

export class Loads extends Folded {
  #shows: ((motion: Motion) => void)[] = [];

  constructor(private readonly draft: Draft) {
    super(t("Torques and payload"), ["payload", "limits/joint_torque", "torques"]);
    this.body.append(
      element("div", { class: "settings quarters" }, this.#mass(), ...["x", "y", "z"].map((_, i) => this.#centre(i))),
      element("div", { class: "bar" }, this.#effort(), this.#torques()),
    );
  }

  update(): void {
    const { motion } = this.draft;
    for (const show of this.#shows) show(motion);
    const { payload, limits, torques } = motion;
    const said = [payload && `${payload.mass} kg`, limits?.joint_torque && t("within the motors’ effort")];
    this.summarise(said.filter(Boolean).join(" · ") || (torques ? t("shown") : ""));
  }

  #mass(): HTMLElement {
    const change = (mass: number | undefined) =>
      this.draft.set({ payload: mass === undefined ? undefined : { ...this.draft.motion.payload, mass } });
    const field = optional(
      t("Payload"),
      t("Payload, mass"),
      "kg",
      t("none"),
      () => this.draft.units,
      change,
      "payload/mass",
    );
    this.#shows.push(({ payload }) => field.show(payload?.mass));
    return field.host;
  }

  /** In the tip's frame, once there is something to have a centre. */
  #centre(index: number): HTMLElement {
    const name = "xyz"[index]!;
    const change = (value: number | undefined) => {
      const { center = ORIGIN, ...rest } = this.draft.motion.payload!;
      const moved = center.map((old, i) => (i === index ? (value ?? 0) : old));
      this.draft.set({ payload: defined<Payload>({ ...rest, center: moved.some(Boolean) ? moved : undefined }) });
    };
    const field = optional(
      ...([t("Centre {name}", { name }), t("Payload, centre {name}", { name }), "m", "0"] as const),
      () => this.draft.units,
      change,
      "payload/center",
    );
    const input = field.host.querySelector("input")!;
    this.#shows.push(({ payload }) => {
      field.show(payload?.center?.[index] || undefined);
      input.disabled = !payload;
    });
    return field.host;
  }

  /** Who asks for the limits wants to see how near the torques come to them. */
  #effort(): HTMLElement {
    return this.#switch(
      t("Within the motors’ effort"),
      t("Keep the effort limits of the robot’s description: no faster than the motors’ torques allow"),
      ({ limits }) => limits?.joint_torque !== undefined,
      (isOn) => {
        this.draft.limit({ joint_torque: isOn ? "effort" : undefined });
        if (isOn) this.draft.set({ torques: true });
      },
    );
  }

  #torques(): HTMLElement {
    return this.#switch(
      t("Show torques"),
      t("The motors’ torques during the motion, to be drawn among the profiles"),
      ({ torques }) => torques === true,
      (isOn) => this.draft.set({ torques: isOn || undefined }),
    );
  }

  #switch(text: string, title: string, isOn: (motion: Motion) => boolean, set: (isOn: boolean) => void): HTMLElement {
    const made = toggle(text, title, () => set(!isOn(this.draft.motion)));
    this.#shows.push((motion) => made.setAttribute("aria-pressed", String(isOn(motion))));
    return made;
  }
}
