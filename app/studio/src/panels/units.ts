/** The choice of units of lengths and of angles, for the whole page. */

import { prefer } from "../prefs.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import { Choice, element } from "../ui/dom.ts";
import type { Units } from "../ui/quantity.ts";

export class UnitChoices {
  readonly host: HTMLElement;
  #lengths: Choice<"m" | "mm">;
  #angles: Choice<"rad" | "deg">;

  constructor(store: Store<State>) {
    const options = <T extends string>(...values: T[]) => values.map((value) => ({ value, text: value }));
    this.#lengths = new Choice(t("Unit of lengths"), options("m", "mm"), (chosen) =>
      prefer(store, { millimetres: chosen === "mm" }),
    );
    this.#angles = new Choice(t("Unit of angles"), options("rad", "deg"), (chosen) =>
      prefer(store, { degrees: chosen === "deg" }),
    );
    this.host = element("div", { class: "bar" }, this.#lengths.host, this.#angles.host);
  }

  show({ millimetres, degrees }: Units): void {
    this.#lengths.show(millimetres ? "mm" : "m");
    this.#angles.show(degrees ? "deg" : "rad");
  }
}
