/** The joints of a plot: each with its colour and its value, to be hidden and shown. */

import type { Joint } from "../../robot/model.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { fixed } from "../../ui/quantity.ts";
import { jointHue } from "../../view/colours.ts";

export class Legend {
  readonly host = element("div", { class: "profile-legend", role: "group", "aria-label": t("Joints in the plot") });
  #values: HTMLElement[] = [];
  #hidden = new Set<string>();

  /** @param flipped is told which joint is shown from now on, or no longer. */
  constructor(
    private readonly store: Store<State>,
    private readonly flipped: (index: number, isShown: boolean) => void,
  ) {}

  isShown({ name }: Joint): boolean {
    return !this.#hidden.has(name);
  }

  list(joints: readonly Joint[]): void {
    const prefix = commonPrefix(joints.map(({ name }) => name));
    this.#values = joints.map(() => element("span", { class: "profile-value" }));
    this.host.replaceChildren(...joints.map((joint, i) => this.#entry(joint, i, prefix)));
  }

  tell(values: readonly number[]): void {
    for (const [i, cell] of this.#values.entries()) cell.textContent = fixed(values[i]!, 3);
  }

  #entry(joint: Joint, index: number, prefix: number): HTMLElement {
    const point = (name: string | null) => () => this.store.set({ joint: name });
    const entry = button("", () => this.#flip(joint, index, entry), {
      class: "profile-joint",
      title: t("{name}: show or hide", { name: joint.name }),
      "aria-pressed": String(this.isShown(joint)),
      onpointerenter: point(joint.name),
      onpointerleave: point(null),
      onfocus: point(joint.name),
      onblur: point(null),
    });
    entry.append(
      element("span", { class: `swatch ${jointHue(index)}` }),
      element("span", { class: "profile-name" }, joint.name.slice(prefix)),
      this.#values[index]!,
    );
    return entry;
  }

  #flip(joint: Joint, index: number, entry: HTMLElement): void {
    const isShown = this.#hidden.delete(joint.name);
    if (!isShown) this.#hidden.add(joint.name);
    entry.setAttribute("aria-pressed", String(isShown));
    this.flipped(index, isShown);
  }
}

/** How many characters at the front, up to an underscore, all names share and can do without: `panda_`. */
export function commonPrefix(names: readonly string[]): number {
  const [first = ""] = names;
  const isShared = (end: number) =>
    names.every((name) => name.startsWith(first.slice(0, end)) && /^[a-z]/i.test(name.slice(end)));
  const ends = [...first].flatMap((letter, i) => (letter === "_" && isShared(i + 1) ? [i + 1] : []));
  return names.length > 1 ? (ends.at(-1) ?? 0) : 0;
}
