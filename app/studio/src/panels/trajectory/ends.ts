/** How fast the joints are where the motion begins and ends; at rest where nothing is written. */

import { type Joint, kindOf } from "../../robot/model.ts";
import { t } from "../../texts/index.ts";
import { NumberField } from "../../ui/number.ts";
import { chosenOf, type Units } from "../../ui/quantity.ts";
import type { Draft } from "./draft.ts";
import { jointTable, unitsOf } from "./fields.ts";
import { Folded } from "./folded.ts";
import { type Motion, RATES, type Rates } from "./motion.ts";

type Rate = keyof Rates;

const COLUMNS: Record<Rate, { title: string; words: string; per: string }> = {
  start_velocities: { title: t("Start q̇"), words: t("start velocity"), per: "/s" },
  start_accelerations: { title: t("Start q̈"), words: t("start acceleration"), per: "/s²" },
  end_velocities: { title: t("End q̇"), words: t("end velocity"), per: "/s" },
  end_accelerations: { title: t("End q̈"), words: t("end acceleration"), per: "/s²" },
};

export class Ends extends Folded {
  #shows: ((motion: Motion) => void)[] = [];
  #shape = "";

  constructor(private readonly draft: Draft) {
    super(t("Moving ends"), RATES);
  }

  update(): void {
    const { motion, chain, units } = this.draft;
    const shape = JSON.stringify([chain.model.title, chain.joints.map(({ name }) => name), chosenOf(units)]);
    if (shape !== this.#shape) {
      this.#shape = shape;
      this.#build(chain.joints, units);
    }
    for (const show of this.#shows) show(motion);
    const moves = (end: "start" | "end") => RATES.some((rate) => rate.startsWith(end) && motion[rate]);
    const start = moves("start") ? t("at its start") : t("at rest");
    this.summarise(!moves("end") ? start : moves("start") ? t("at its start and end") : t("at its end"));
  }

  #build(joints: readonly Joint[], units: Units): void {
    this.#shows = [];
    const columns = RATES.map((rate) => {
      const { title, words, per } = COLUMNS[rate];
      const control = (joint: Joint, index: number) => this.#field(rate, `${joint.name}, ${words}`, index);
      return { title, unit: unitsOf(joints, units, per), control };
    });
    this.body.replaceChildren(jointTable(t("Joint"), joints, columns));
  }

  #field(rate: Rate, label: string, index: number): HTMLElement {
    const { joints } = this.draft.chain;
    const field = new NumberField({
      label,
      kind: kindOf(joints[index]!),
      units: () => this.draft.units,
      decimals: 3,
      optional: true,
      change: (value) => {
        const values = joints.map((_, i) => (i === index ? (value ?? 0) : (this.draft.motion[rate]?.[i] ?? 0)));
        this.draft.set({ [rate]: values.some((one) => one !== 0) ? values : undefined });
      },
    });
    field.input.name = rate;
    field.input.placeholder = "0";
    this.#shows.push((motion) => field.set(motion[rate]?.[index] || null));
    return field.input;
  }
}
