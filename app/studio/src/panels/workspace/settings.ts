/** What is to be computed: how many samples, and what is made of them. */

import { chosen, choosing, type State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { Choice, element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";

const KINDS = [
  { value: "cloud", text: "Cloud", hint: "A point for each sample, coloured by manipulability." },
  { value: "grid", text: "Grid", hint: "A point for each voxel that samples fall into, with the best manipulability." },
  {
    value: "dexterity",
    text: "Dexterity",
    hint: "Of each voxel the share of 32 orientations that inverse kinematics reaches at its centre. Takes a while.",
  },
] as const;
const SAMPLES = ["100000", "10000", "30000", "300000", "1000000"] as const;
const SEQUENCES = [
  { value: "random", text: "Random" },
  { value: "low_discrepancy", text: "Even" },
] as const;

const values = <T extends string>(options: readonly { value: T }[]): T[] => options.map(({ value }) => value);

export class Settings {
  readonly kinds: Choice<(typeof KINDS)[number]["value"]>;
  readonly host: HTMLElement;
  #hint = element("p", { class: "muted small" });
  #samples: HTMLSelectElement;
  #sequences: Choice<(typeof SEQUENCES)[number]["value"]>;
  #voxel: NumberField;

  constructor(private readonly store: Store<State>) {
    const choose = (option: string, usual: string) => (value: string) =>
      store.set(choosing(store.value, option, value === usual ? null : value));
    this.kinds = new Choice("What is computed", KINDS, choose("workspace.kind", "cloud"));
    this.#sequences = new Choice("Sequence of the samples", SEQUENCES, choose("workspace.sequence", "random"));
    const options = [...SAMPLES]
      .sort((a, b) => Number(a) - Number(b))
      .map((value) => element("option", { value }, Number(value).toLocaleString("en")));
    const take = choose("workspace.samples", SAMPLES[0]);
    this.#samples = element(
      "select",
      { class: "select", id: "samples", onchange: () => take(this.#samples.value) },
      ...options,
    );
    this.#voxel = new NumberField({
      label: "Edge of a voxel",
      kind: "length",
      degrees: () => false,
      optional: true,
      change: (edge) => store.set(choosing(store.value, "workspace.voxel", edge === null ? null : String(edge))),
    });
    this.#voxel.input.placeholder = "automatic";
    this.host = element(
      "div",
      { class: "part" },
      this.#hint,
      element(
        "div",
        { class: "sampling" },
        element("label", { for: "samples" }, "Samples"),
        element("span", { class: "bar" }, this.#samples, this.#sequences.host),
        element("span", {}, "Voxel edge"),
        element("span", { class: "entry" }, this.#voxel.input, element("span", { class: "unit" }, "m")),
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
