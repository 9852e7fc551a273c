/** How the target is to be reached: by which method, to which tolerance, in which directions. */

import { shownChain } from "../../robot/chain.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { DIRECTIONS, type Direction, type InverseMethod, type InverseOptions } from "../../types.ts";
import { button, Choice, element, toggle } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { type Kind, unitOf } from "../../ui/quantity.ts";
import { findsAll, fullOptions } from "./call.ts";

const METHODS: readonly { value: InverseMethod; text: string }[] = [
  { value: "auto", text: "Automatic" },
  { value: "analytic", text: "Closed form" },
  { value: "newton", text: "Newton" },
  { value: "gradient", text: "Gradient" },
  { value: "gradient_then_newton", text: "Gradient, then Newton" },
  { value: "damped_least_squares", text: "Damped least squares" },
];
const MEANINGS: Record<Direction, string> = {
  x: "Position along the base's x axis",
  y: "Position along the base's y axis",
  z: "Position along the base's z axis",
  rx: "Rotation about the target's x axis",
  ry: "Rotation about the target's y axis",
  rz: "Rotation about the target's z axis",
};

export class OptionFields {
  readonly host: HTMLElement;
  #count: Choice<"one" | "all">;
  #method: HTMLSelectElement;
  #limits: HTMLButtonElement;
  #directions = new Map<Direction, HTMLButtonElement>();
  #position: NumberField;
  #orientation: NumberField;
  #unit = element("span", { class: "unit" });

  /** @param solve again, from the posture on the screen. */
  constructor(
    private readonly store: Store<State>,
    solve: () => void,
  ) {
    this.#count = new Choice(
      "How many solutions",
      [
        { value: "one", text: "One" },
        { value: "all", text: "All" },
      ],
      (solutions) => this.#set({ solutions }),
    );
    this.#method = element(
      "select",
      {
        class: "select",
        "aria-label": "Method",
        onchange: () => this.#set({ method: this.#method.value as InverseMethod }),
      },
      ...METHODS.map(({ value, text }) => element("option", { value }, text)),
    );
    this.#limits = toggle("Within limits", "Whether solutions must be within the limits of the joints", () =>
      this.#set({ respect_limits: !this.#now().respect_limits }),
    );
    for (const direction of DIRECTIONS) {
      const flip = () => this.#flip(direction);
      this.#directions.set(direction, toggle(direction, MEANINGS[direction], flip));
    }
    this.#position = this.#tolerance("Position tolerance", "length", "position_tolerance");
    this.#orientation = this.#tolerance("Orientation tolerance", "angle", "orientation_tolerance");
    this.host = element(
      "div",
      { class: "ik-options" },
      element("div", { class: "bar" }, this.#count.host, this.#method, this.#limits),
      element(
        "div",
        { class: "bar", role: "group", "aria-label": "Directions that count" },
        element("span", { class: "field" }, "Counts"),
        ...this.#directions.values(),
      ),
      element(
        "div",
        { class: "bar tolerances" },
        element("span", { class: "field" }, "Tolerances"),
        this.#position.input,
        element("span", { class: "unit" }, "m"),
        this.#orientation.input,
        this.#unit,
        element("span", { class: "spring" }),
        button("Solve again", solve, { title: "Once more, from the posture on the screen" }),
      ),
    );
  }

  show({ inverse, degrees }: Readonly<State>): void {
    const { solutions, method, respect_limits, task } = this.#now();
    this.#count.show(solutions);
    this.#count.allow("all", findsAll(method) ? null : "This method follows one start to one solution");
    this.#method.value = method;
    this.#limits.setAttribute("aria-pressed", String(respect_limits));
    for (const [direction, made] of this.#directions) {
      made.setAttribute("aria-pressed", String(task.includes(direction)));
    }
    this.#position.set(inverse?.position_tolerance ?? null);
    this.#orientation.set(inverse?.orientation_tolerance ?? null);
    this.#unit.textContent = unitOf("angle", degrees);
    this.#orientation.input.placeholder = degrees ? "0.00006" : "0.000001";
  }

  #now() {
    const { inverse } = this.store.value;
    return fullOptions(inverse, shownChain(this.store.value)?.joints.length ?? 6);
  }

  #set(change: InverseOptions): void {
    this.store.set({ inverse: { ...this.store.value.inverse, ...change } });
  }

  #flip(direction: Direction): void {
    const { task } = this.#now();
    const wanted = DIRECTIONS.filter((one) => (one === direction) !== task.includes(one));
    if (wanted.length) this.#set({ task: wanted });
  }

  #tolerance(label: string, kind: Kind, key: "position_tolerance" | "orientation_tolerance"): NumberField {
    const field = new NumberField({
      label,
      kind,
      degrees: () => this.store.value.degrees,
      decimals: 14,
      optional: true,
      change: (value) => {
        const { [key]: _, ...others } = this.store.value.inverse ?? {};
        this.store.set({ inverse: value === null ? others : { ...others, [key]: value } });
      },
    });
    field.input.placeholder = "0.000001";
    return field;
  }
}
