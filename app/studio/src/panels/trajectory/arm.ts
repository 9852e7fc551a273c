/** The joints' sliders, so that a way-point can be found without leaving the panel. */

import { shownChain } from "../../robot/chain.ts";
import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { UNITS } from "../../ui/quantity.ts";
import type { Studio } from "../panel.ts";
import { JointList } from "../pose/joints.ts";

export class Arm {
  readonly host: HTMLDetailsElement;
  #stops: (() => void)[];

  constructor({ store }: Studio) {
    const joints = new JointList(store);
    const random = button(t("Random"), () => {
      const { model, base, tip, positions } = shownChain(store.value)!;
      store.set({ positions: model.random(base, tip, positions) });
    });
    this.host = element(
      "details",
      { class: "arm", ontoggle: () => joints.update() },
      element("summary", {}, t("Move the arm")),
      element("div", { class: "part" }, element("div", { class: "bar" }, random), joints.host),
    );
    this.#stops = [
      store.watch(["model", "base", "tip", ...UNITS], () => joints.build()),
      store.watch(["positions"], () => {
        if (this.host.open) joints.update();
      }),
      () => store.set({ joint: null }),
    ];
  }

  stop(): void {
    for (const stop of this.#stops) stop();
  }
}
