/** Pose: move the joints, read where the tip is, and see that browser and service agree. */

import { shownChain, type ShownChain } from "../../robot/chain.ts";
import type { Positions } from "../../state.ts";
import { t } from "../../texts/index.ts";
import { button, element, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import { UNITS } from "../../ui/quantity.ts";
import type { Panel, Studio } from "../panel.ts";
import { Agreement } from "./agreement.ts";
import { JointList } from "./joints.ts";
import { UnitChoices } from "../units.ts";
import { TipPose } from "./tip.ts";

export const posePanel: Panel = { id: "pose", title: t("Pose"), open };

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, api } = studio;
  const request = new RequestView(api);
  const problem = new ProblemView();
  const joints = new JointList(store);
  const tip = new TipPose();
  const agreement = new Agreement(request.api, () => store.value, problem);
  const units = new UnitChoices(store);
  host.append(
    section(
      t("Joints"),
      element("div", { class: "bar" }, ...presets(studio), element("span", { class: "spring" }), units.host),
      joints.host,
    ),
    section(t("Tip"), tip.host, agreement.host, problem.host),
    request.host,
  );
  const stops = [
    store.watch(["model", "base", "tip", ...UNITS], (state) => {
      units.show(state);
      joints.build();
    }),
    store.watch(["model", "base", "tip", ...UNITS, "positions"], (state) => {
      joints.update();
      const chain = shownChain(state);
      if (!chain) return;
      const T = chain.model.pose(chain.base, chain.tip);
      tip.show(T, chain.base, chain.tip, state);
      agreement.check(chain, T);
    }),
    () => agreement.stop(),
    () => store.set({ joint: null }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

/** Buttons that put the chain somewhere. */
export function presets({ store }: Studio): HTMLElement[] {
  const go = (positions: (chain: ShownChain) => Positions) => () => {
    const chain = shownChain(store.value);
    if (chain) store.set({ positions: positions(chain) });
  };
  const home = go(({ model, base, tip }) => model.home(base, tip));
  const zero = go(({ model }) => model.zero());
  const random = go(({ model, base, tip }) => model.random(base, tip, store.value.positions));
  return [
    button(t("Home"), home, { title: t("Each joint of the chain in the middle of its range") }),
    button(t("Zero"), zero, { title: t("Every joint at zero") }),
    button(t("Random"), random, { title: t("Each joint of the chain somewhere within its limits") }),
  ];
}
