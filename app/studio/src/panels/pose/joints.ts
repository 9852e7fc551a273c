/** A slider and a number for each joint: first those of the chain, base to tip, then the others of the robot. */

import { shownChain } from "../../robot/chain.ts";
import { type Joint, isBeyond, kindOf, range } from "../../robot/model.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { jointHue } from "../../view/colours.ts";
import { format, unitOf } from "../../ui/quantity.ts";

interface Row {
  joint: Joint;
  slider: HTMLInputElement;
  field: NumberField;
  host: HTMLElement;
}

export class JointList {
  readonly host = element("div", { class: "joints" });
  #rows: Row[] = [];

  constructor(private readonly store: Store<State>) {}

  /** Rows for the robot and the chain that are on the screen now. */
  build(): void {
    const chain = shownChain(this.store.value);
    this.#rows = [];
    this.host.replaceChildren();
    if (!chain) return;
    const others = chain.model.joints.filter((joint) => !chain.joints.includes(joint));
    this.host.append(...chain.joints.map((joint, index) => this.#row(joint, jointHue(index))));
    if (chain.joints.length === 0)
      this.host.append(element("p", { class: "muted" }, t("No joint moves between these two frames.")));
    if (others.length) {
      const title = t("Other joints ({length})", { length: others.length });
      this.host.append(
        element(
          "details",
          { class: "others" },
          element("summary", {}, title),
          ...others.map((joint) => this.#row(joint)),
        ),
      );
    }
    this.update();
  }

  /** The positions of the state. */
  update(): void {
    const { positions } = this.store.value;
    for (const { joint, slider, field, host } of this.#rows) {
      const value = positions[joint.name] ?? 0;
      if (Number(slider.value) !== value) slider.value = String(value);
      field.set(value);
      host.classList.toggle("beyond", isBeyond(joint, value));
    }
  }

  #row(joint: Joint, hue?: string): HTMLElement {
    const { lower, upper } = range(joint);
    const kind = kindOf(joint);
    const units = () => this.store.value;
    const move = (value: number | null) => {
      if (value !== null) this.store.set({ positions: { ...this.store.value.positions, [joint.name]: value } });
    };
    const slider = element("input", {
      type: "range",
      min: lower,
      max: upper,
      step: "any",
      "aria-label": joint.name,
      oninput: () => move(Number(slider.value)),
      onkeydown: (event: KeyboardEvent) => step(event, slider, move),
    });
    const field = new NumberField({ label: t("{name}, number", { name: joint.name }), kind, units, change: move });
    const point = (name: string | null) => () => this.store.set({ joint: name });
    const text = (value: number) => format(value, kind, units(), 3);
    const host = element(
      "div",
      {
        class: "joint",
        onpointerenter: point(joint.name),
        onpointerleave: point(null),
        onfocusin: point(joint.name),
        onfocusout: point(null),
      },
      element("span", { class: hue ? `joint-name tinted ${hue}` : "joint-name", title: joint.name }, joint.name),
      element("span", { class: "entry" }, field.input, element("span", { class: "unit" }, unitOf(kind, units()))),
      element(
        "span",
        { class: "slide" },
        element("span", { class: "limit" }, joint.lower === null ? "" : text(lower)),
        slider,
        element("span", { class: "limit" }, joint.upper === null ? "" : text(upper)),
      ),
    );
    this.#rows.push({ joint, slider, field, host });
    return host;
  }
}

/** Arrow keys by a hundredth of the range: a slider without steps would leave that to the browser. */
function step(event: KeyboardEvent, slider: HTMLInputElement, move: (value: number) => void): void {
  const sign = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[event.key];
  if (sign === undefined) return;
  event.preventDefault();
  const [lower, upper] = [Number(slider.min), Number(slider.max)];
  const value = Number(slider.value) + (sign * (upper - lower)) / 100;
  move(Math.max(lower, Math.min(upper, value)));
}
