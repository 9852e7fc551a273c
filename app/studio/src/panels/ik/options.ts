/** How the target is to be reached: by which method, to which tolerance, in which directions. */

import { shownChain } from "../../robot/chain.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { DIRECTIONS, type Direction, type InverseMethod, type InverseOptions } from "../../types.ts";
import { button, Choice, element, explained, toggle } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { format, type Kind, unitOf } from "../../ui/quantity.ts";
import { findsAll, fullOptions } from "./call.ts";

const METHODS: readonly { value: InverseMethod; text: string }[] = [
  { value: "auto", text: t("Automatic") },
  { value: "analytic", text: t("Closed form") },
  { value: "newton", text: t("Newton") },
  { value: "gradient", text: t("Gradient") },
  { value: "gradient_then_newton", text: t("Gradient, then Newton") },
  { value: "damped_least_squares", text: t("Damped least squares") },
];
const MEANINGS: Record<Direction, string> = {
  x: t("Position along the base's x axis"),
  y: t("Position along the base's y axis"),
  z: t("Position along the base's z axis"),
  rx: t("Rotation about the target's x axis"),
  ry: t("Rotation about the target's y axis"),
  rz: t("Rotation about the target's z axis"),
};

/** Of position [m] and of orientation [rad]. */
const USUAL_TOLERANCE = 1e-6;

export class OptionFields {
  readonly host: HTMLElement;
  #count: Choice<"one" | "all">;
  #method: HTMLSelectElement;
  #limits: HTMLButtonElement;
  #directions = new Map<Direction, HTMLButtonElement>();
  #position: NumberField;
  #orientation: NumberField;
  #folded: HTMLDetailsElement;
  #units = [element("span", { class: "unit" }), element("span", { class: "unit" })] as const;

  /** @param solve again, from the posture on the screen. */
  constructor(
    private readonly store: Store<State>,
    solve: () => void,
  ) {
    this.#count = new Choice(
      t("How many solutions"),
      [
        { value: "one", text: t("One") },
        { value: "all", text: t("All") },
      ],
      (solutions) => this.#set({ solutions }),
    );
    this.#method = element(
      "select",
      {
        class: "select",
        "aria-label": t("Method"),
        onchange: () => this.#set({ method: this.#method.value as InverseMethod }),
      },
      ...METHODS.map(({ value, text }) => element("option", { value }, text)),
    );
    this.#limits = toggle(t("Within limits"), t("Whether solutions must be within the limits of the joints"), () =>
      this.#set({ respect_limits: !this.#now().respect_limits }),
    );
    for (const direction of DIRECTIONS) {
      const flip = () => this.#flip(direction);
      this.#directions.set(direction, toggle(direction, MEANINGS[direction], flip));
    }
    this.#position = this.#tolerance(t("Position tolerance"), "length", "position_tolerance");
    this.#orientation = this.#tolerance(t("Orientation tolerance"), "angle", "orientation_tolerance");
    this.host = element(
      "div",
      { class: "ik-options" },
      element(
        "div",
        { class: "bar" },
        this.#count.host,
        this.#method,
        this.#limits,
        element("span", { class: "spring" }),
        button(t("Solve again"), solve, { title: t("Once more, from the posture on the screen") }),
      ),
      (this.#folded = element(
        "details",
        {},
        element("summary", {}, t("Directions and tolerances")),
        element(
          "div",
          { class: "bar", role: "group", "aria-label": t("Directions that count") },
          explained(element("span", { class: "field" }, t("Counts")), t("Counts")),
          ...this.#directions.values(),
        ),
        element(
          "div",
          { class: "bar tolerances" },
          explained(element("span", { class: "field" }, t("Tolerances")), t("Tolerances")),
          this.#position.input,
          this.#units[0],
          this.#orientation.input,
          this.#units[1],
        ),
      )),
    );
  }

  show(state: Readonly<State>): void {
    const { inverse } = state;
    const { solutions, method, respect_limits, task } = this.#now();
    // What is not as usual is not hidden.
    this.#folded.open ||= Boolean(inverse?.task ?? inverse?.position_tolerance ?? inverse?.orientation_tolerance);
    this.#count.show(solutions);
    this.#count.allow("all", findsAll(method) ? null : t("This method follows one start to one solution"));
    this.#method.value = method;
    this.#limits.setAttribute("aria-pressed", String(respect_limits));
    for (const [direction, made] of this.#directions) {
      made.setAttribute("aria-pressed", String(task.includes(direction)));
    }
    this.#position.set(inverse?.position_tolerance ?? null);
    this.#orientation.set(inverse?.orientation_tolerance ?? null);
    for (const [i, field] of [this.#position, this.#orientation].entries()) {
      const kind = i ? "angle" : "length";
      this.#units[i]!.textContent = unitOf(kind, state);
      field.input.placeholder = format(USUAL_TOLERANCE, kind, state, 7);
    }
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
    return new NumberField({
      label,
      kind,
      units: () => this.store.value,
      decimals: 14,
      optional: true,
      change: (value) => {
        const { [key]: _, ...others } = this.store.value.inverse ?? {};
        this.store.set({ inverse: value === null ? others : { ...others, [key]: value } });
      },
    });
  }
}
