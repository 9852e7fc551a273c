/** What is to be computed: how many samples, and what is made of them. */

import { chosen, choosing, type State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { language, t } from "../../texts/index.ts";
import { Choice, element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { unitOf } from "../../ui/quantity.ts";

const KINDS = [
  { value: "cloud", text: t("Cloud"), hint: t("A point for each sample, coloured by manipulability.") },
  {
    value: "grid",
    text: t("Grid"),
    hint: t("A point for each voxel that samples fall into, with the best manipulability."),
  },
  {
    value: "dexterity",
    text: t("Dexterity"),
    hint: t("Of each voxel the share of 32 orientations that inverse kinematics reaches at its centre. Takes a while."),
  },
] as const;
const SAMPLES = ["100000", "10000", "30000", "300000", "1000000"] as const;
const SEQUENCES = [
  { value: "random", text: t("Random") },
  { value: "low_discrepancy", text: t("Even") },
] as const;

const values = <T extends string>(options: readonly { value: T }[]): T[] => options.map(({ value }) => value);

export class Settings {
  readonly kinds: Choice<(typeof KINDS)[number]["value"]>;
  readonly host: HTMLElement;
  #hint = element("p", { class: "muted small" });
  #samples: HTMLSelectElement;
  #sequences: Choice<(typeof SEQUENCES)[number]["value"]>;
  #voxel: NumberField;
  #unit = element("span", { class: "unit" });

  constructor(private readonly store: Store<State>) {
    const choose = (option: string, usual: string) => (value: string) =>
      store.set(choosing(store.value, option, value === usual ? null : value));
    this.kinds = new Choice(t("What is computed"), KINDS, choose("workspace.kind", "cloud"));
    this.#sequences = new Choice(t("Sequence of the samples"), SEQUENCES, choose("workspace.sequence", "random"));
    const options = [...SAMPLES]
      .sort((a, b) => Number(a) - Number(b))
      .map((value) => element("option", { value }, Number(value).toLocaleString(language)));
    const take = choose("workspace.samples", SAMPLES[0]);
    this.#samples = element(
      "select",
      { class: "select", id: "samples", onchange: () => take(this.#samples.value) },
      ...options,
    );
    this.#voxel = new NumberField({
      label: t("Edge of a voxel"),
      kind: "length",
      units: () => store.value,
      optional: true,
      change: (edge) => store.set(choosing(store.value, "workspace.voxel", edge === null ? null : String(edge))),
    });
    this.#voxel.input.placeholder = t("automatic");
    this.host = element(
      "div",
      { class: "part" },
      this.#hint,
      element(
        "div",
        { class: "sampling" },
        element("label", { for: "samples" }, t("Samples")),
        element("span", { class: "bar" }, this.#samples, this.#sequences.host),
        element("span", {}, t("Voxel edge")),
        element("span", { class: "entry" }, this.#voxel.input, this.#unit),
      ),
    );
  }

  /** What the state says. */
  update(): void {
    const { kind, sequence, samples, voxel } = this.#chosen;
    this.kinds.show(kind);
    this.#hint.textContent = KINDS.find(({ value }) => value === kind)!.hint;
    this.#sequences.show(sequence);
    this.#samples.value = samples;
    this.#unit.textContent = unitOf("length", this.store.value);
    this.#voxel.set(voxel);
  }

  /** The fields of a call. */
  get call(): Record<string, unknown> {
    const { kind, sequence, samples, voxel } = this.#chosen;
    return { kind, samples: Number(samples), sequence, ...(voxel === null ? {} : { voxel_size: voxel }) };
  }

  get #chosen() {
    const state = this.store.value;
    const voxel = Number(state.options["workspace.voxel"]);
    return {
      kind: chosen(state, "workspace.kind", values(KINDS)),
      sequence: chosen(state, "workspace.sequence", values(SEQUENCES)),
      samples: chosen(state, "workspace.samples", SAMPLES),
      voxel: Number.isFinite(voxel) && voxel > 0 ? voxel : null,
    };
  }
}
