/** What the colours of the points mean. */

import { Color } from "three";

import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import { rounded } from "../../ui/quantity.ts";
import { shade } from "../../view/shades.ts";
import type { Range } from "./cloud.ts";

const STEPS = 256;
const TICKS = [0, 0.25, 0.5, 0.75, 1];

export class Legend {
  readonly host: HTMLElement;
  #title = element("p", { class: "small" });
  #scale = element("canvas", { class: "scale-colours", width: STEPS, height: 1, role: "img" });
  #ticks = element("div", { class: "scale-ticks" });

  constructor() {
    this.host = element("div", { class: "scale" }, this.#title, this.#scale, this.#ticks);
    const context = this.#scale.getContext("2d")!;
    for (let k = 0; k < STEPS; k += 1) {
      context.fillStyle = `#${new Color().setRGB(...shade(k / (STEPS - 1))).getHexString()}`;
      context.fillRect(k, 0, 1, 1);
    }
  }

  show(title: string, { lower, upper }: Range): void {
    this.#title.textContent = title;
    this.#scale.setAttribute(
      "aria-label",
      t("Colours from {lower} to {upper}", { lower: rounded(lower), upper: rounded(upper) }),
    );
    const values = TICKS.map((share) => lower + share * (upper - lower));
    this.#ticks.replaceChildren(...values.map((value) => element("span", {}, rounded(value))));
  }
}
