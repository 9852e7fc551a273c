/** How fast the joints are where the motion begins and ends; at rest where nothing is written. */

import type { Joint } from "../../robot/model.ts";
import { NumberField } from "../../ui/number.ts";
import type { Draft } from "./draft.ts";
import { jointTable, kindOf, unitsOf } from "./fields.ts";
import { Folded } from "./folded.ts";
import { type Motion, RATES, type Rates } from "./motion.ts";

type Rate = keyof Rates;

const COLUMNS: Record<Rate, { title: string; words: string; per: string }> = {
  start_velocities: { title: "Start q̇", words: "start velocity", per: "/s" },
  start_accelerations: { title: "Start q̈", words: "start acceleration", per: "/s²" },
  end_velocities: { title: "End q̇", words: "end velocity", per: "/s" },
  end_accelerations: { title: "End q̈", words: "end acceleration", per: "/s²" },
};

export class Ends extends Folded {
  #shows: ((motion: Motion) => void)[] = [];
  #shape = "";

  constructor(private readonly draft: Draft) {
    super("Moving ends", RATES);
  }

  update(): void {
    const { motion, chain, degrees } = this.draft;
    const shape = JSON.stringify([chain.model.title, chain.joints.map(({ name }) => name), degrees]);
    if (shape !== this.#shape) {
      this.#shape = shape;
      this.#build(chain.joints, degrees);
    }
    for (const show of this.#shows) show(motion);
    const moving = ["start", "end"].filter((end) => RATES.some((rate) => rate.startsWith(end) && motion[rate]));
    this.summarise(moving.length ? `at its ${moving.join(" and ")}` : "at rest");
  }

  #build(joints: readonly Joint[], degrees: boolean): void {
    this.#shows = [];
    const columns = RATES.map((rate) => {
      const { title, words, per } = COLUMNS[rate];
      const control = (joint: Joint, index: number) => this.#field(rate, `${joint.name}, ${words}`, index);
      return { title, unit: unitsOf(joints, degrees, per), control };
    });
    this.body.replaceChildren(jointTable("Joint", joints, columns));
  }

  #field(rate: Rate, label: string, index: number): HTMLElement {
    const { joints } = this.draft.chain;
    const field = new NumberField({
      label,
      kind: kindOf(joints[index]!),
      degrees: () => this.draft.degrees,
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
