/** Where the cloud is cut open. */

import { chosen, choosing, type State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { WorkspaceSummary } from "../../types.ts";
import { Choice, element, toggle } from "../../ui/dom.ts";
import { column, withUnit } from "../../ui/quantity.ts";
import type { Axis, Section } from "./cloud.ts";

const CUTS = [
  { value: "whole", text: t("Whole") },
  { value: "x", text: "x" },
  { value: "y", text: "y" },
  { value: "z", text: "z" },
] as const;
type Cut = (typeof CUTS)[number]["value"];
const SIDES = ["behind", "slice"] as const;

export class SectionControls {
  readonly host: HTMLElement;
  #cuts: Choice<Cut>;
  #slider: HTMLInputElement;
  #place = element("output", { class: "section-at" });
  #slice: HTMLButtonElement;
  #summary: WorkspaceSummary | null = null;

  constructor(private readonly store: Store<State>) {
    const set = (option: string, value: string | null) => store.set(choosing(store.value, option, value));
    this.#cuts = new Choice(t("Section across"), CUTS, (cut) => {
      const middle = choosing(store.value, "workspace.at", null);
      store.set(choosing({ ...store.value, ...middle }, "workspace.section", cut === "whole" ? null : cut));
    });
    this.#slider = element("input", {
      type: "range",
      step: "any",
      "aria-label": t("Place of the section"),
      oninput: () => set("workspace.at", this.#slider.value),
    });
    this.#slice = toggle(t("Slice"), t("Only what lies in the plane, one voxel thick"), () =>
      set("workspace.side", this.#side === "slice" ? null : "slice"),
    );
    this.host = element(
      "div",
      { class: "section-controls" },
      this.#cuts.host,
      element("span", { class: "slide" }, this.#slider),
      this.#place,
      this.#slice,
    );
  }

  /** What the state says of the section through this workspace; null for none. */
  update(summary: WorkspaceSummary | null): Section | null {
    this.#summary = summary;
    const cut = chosen(
      this.store.value,
      "workspace.section",
      CUTS.map(({ value }) => value),
    );
    this.#cuts.show(cut);
    this.#slice.setAttribute("aria-pressed", String(this.#side === "slice"));
    const bounds = cut === "whole" ? null : summary?.bounding_box;
    for (const control of [this.#slider, this.#slice]) control.disabled = !bounds;
    this.#place.textContent = "";
    if (!bounds || cut === "whole") return null;
    return this.#through(cut, bounds);
  }

  #through(axis: Axis, { lower, upper }: { lower: number[]; upper: number[] }): Section {
    const i = "xyz".indexOf(axis);
    const [least, most] = [lower[i]!, upper[i]!];
    const given = Number(this.store.value.options["workspace.at"] ?? NaN);
    const at = Number.isFinite(given) ? Math.min(most, Math.max(least, given)) : (least + most) / 2;
    this.#slider.min = String(least);
    this.#slider.max = String(most);
    if (Number(this.#slider.value) !== at) this.#slider.value = String(at);
    const units = this.store.value;
    this.#place.textContent = `${axis} = ${withUnit(column(at, "length", units, 2), "length", units)}`;
    return { axis, at, thickness: this.#side === "slice" ? this.#summary!.voxels.size : null };
  }

  get #side() {
    return chosen(this.store.value, "workspace.side", SIDES);
  }
}
