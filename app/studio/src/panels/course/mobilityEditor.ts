/** The editor of a mechanism: its links and its pairs, added, changed and taken away. */

import { t } from "../../texts/index.ts";
import { button, Choice, element } from "../../ui/dom.ts";
import type { Editor, Inputs } from "./calculator.ts";
import { parsedList, writtenList } from "./lists.ts";
import * as mechanism from "./mechanism.ts";
import type { Pair } from "./mechanism.ts";

export class MechanismEditor implements Editor {
  readonly host = element("div", { class: "course-editor" });
  #spaces: Choice<"planar" | "spatial">;
  #links = element("ul", { class: "course-links" });
  #pairs = element("ol", { class: "course-pairs" });
  #wrong = element("p", { class: "course-wrong", role: "alert", hidden: true });
  #inputs: Inputs = {};
  #shape = "";

  constructor(private readonly change: (inputs: Inputs) => void) {
    this.#spaces = new Choice(
      t("Space"),
      [
        { value: "planar", text: t("In the plane, λ = 3") },
        { value: "spatial", text: t("In space, λ = 6") },
      ],
      (space) => change(mechanism.inSpace(this.#inputs, space)),
    );
    const add = (text: string, how: (inputs: Inputs) => Inputs) => button(text, () => change(how(this.#inputs)));
    const spring = () => element("span", { class: "spring" });
    this.host.append(
      this.#spaces.host,
      element("div", { class: "bar" }, element("h3", {}, t("Links")), spring(), add(t("Add link"), mechanism.withLink)),
      this.#links,
      element(
        "div",
        { class: "bar" },
        element("h3", {}, t("Joints")),
        spring(),
        add(t("Add joint"), mechanism.withPair),
      ),
      this.#pairs,
      this.#wrong,
    );
  }

  show(inputs: Inputs): void {
    this.#inputs = inputs;
    this.host.hidden = !mechanism.isNamed(inputs);
    this.#wrong.hidden = true;
    if (this.host.hidden) return;
    this.#spaces.show(mechanism.spaceOf(inputs));
    const [links, pairs] = [mechanism.linksOf(inputs), mechanism.pairsOf(inputs)];
    const shape = JSON.stringify([
      links,
      pairs.map(({ point, axis, ...rest }) => [rest, !!point, !!axis]),
      inputs["space"],
    ]);
    if (shape !== this.#shape) this.#build(links, pairs);
    this.#shape = shape;
    this.#placePoints(pairs);
  }

  fail(pointer: string, reason: string): boolean {
    const [, what, index] = pointer.split("/");
    if (this.host.hidden || (what !== "pairs" && what !== "links")) return false;
    const which = index === undefined ? "" : `${what === "pairs" ? t("Joint") : t("Link")} ${Number(index) + 1}: `;
    this.#wrong.hidden = false;
    this.#wrong.textContent = which + reason;
    return true;
  }

  /** The rows anew; the focus stays where it was, or goes to the row before. */
  #build(links: readonly string[], pairs: readonly Pair[]): void {
    const focused = this.host.contains(document.activeElement)
      ? document.activeElement!.getAttribute("aria-label")
      : null;
    this.#links.replaceChildren(...links.map((name, i) => this.#link(name, i)));
    this.#pairs.replaceChildren(...pairs.map((pair, i) => this.#pair(pair, i, links)));
    if (focused) this.host.querySelector<HTMLElement>(`[aria-label="${CSS.escape(focused)}"]`)?.focus();
  }

  #link(name: string, i: number): HTMLElement {
    const remove = button("×", () => this.change(mechanism.withoutLink(this.#inputs, name)), {
      class: "icon",
      "aria-label": t("Remove link {name}", { name }),
    });
    return element("li", { class: `link curve-${(i % 6) + 1}` }, element("span", {}, name), i > 0 && remove);
  }

  #pair(pair: Pair, i: number, links: readonly string[]): HTMLElement {
    const change = (to: Partial<Pair>) => this.change(mechanism.withPairChanged(this.#inputs, i, to));
    const select = (label: string, value: string, options: readonly string[], take: (value: string) => void) => {
      const made = element(
        "select",
        {
          class: "select",
          "aria-label": t("Joint {i}, {label}", { i: i + 1, label }),
          onchange: () => take(made.value),
        },
        ...options.map((one) => element("option", { value: one, selected: one === value }, one.replaceAll("_", " "))),
      );
      return made;
    };
    const types = Object.keys(mechanism.TYPES[mechanism.spaceOf(this.#inputs)]);
    const vector = (key: "point" | "axis", label: string) => pair[key] && this.#vector(i, key, label);
    return element(
      "li",
      {},
      select("kind", mechanism.kindOf(pair), types, (type) => change({ type })),
      select(t("first link"), pair.link_a, links, (link_a) => change({ link_a })),
      select(t("second link"), pair.link_b, links, (link_b) => change({ link_b })),
      button("×", () => this.change(mechanism.withoutPair(this.#inputs, i)), {
        class: "icon",
        "aria-label": t("Remove joint {i}", { i: i + 1 }),
      }),
      vector("point", "x, y"),
      vector("axis", "direction"),
    );
  }

  #vector(i: number, key: "point" | "axis", label: string): HTMLElement {
    const input = element("input", {
      class: "number list",
      type: "text",
      autocomplete: "off",
      "aria-label": t("Joint {i}, {label}", { i: i + 1, label }),
      "data-vector": `${i} ${key}`,
      onblur: () => this.#placePoints(mechanism.pairsOf(this.#inputs)),
      oninput: () => {
        const given = parsedList(input.value);
        const isVector = given !== null && (given.length === 2 || given.length === 3);
        input.setAttribute("aria-invalid", String(!isVector));
        if (isVector) this.change(mechanism.withPairChanged(this.#inputs, i, { [key]: [...given, 0].slice(0, 3) }));
      },
    });
    return element("label", { class: "course-vector" }, element("span", { class: "muted small" }, label), input);
  }

  #placePoints(pairs: readonly Pair[]): void {
    for (const input of this.#pairs.querySelectorAll<HTMLInputElement>("[data-vector]")) {
      if (input === document.activeElement) continue;
      const [i, key] = input.dataset["vector"]!.split(" ") as [string, "point" | "axis"];
      const [x, y, z] = pairs[Number(i)]?.[key] ?? [];
      input.value = writtenList(z ? [x, y, z] : [x, y]);
      input.setAttribute("aria-invalid", "false");
    }
  }
}
