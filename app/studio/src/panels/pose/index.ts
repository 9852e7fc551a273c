/** Pose: move the joints, read where the tip is, and see that browser and service agree. */

import { Choice, button, element, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import type { Panel, Studio } from "../panel.ts";
import { Agreement } from "./agreement.ts";
import { JointList } from "./joints.ts";
import { TipPose } from "./tip.ts";

export const posePanel: Panel = { id: "pose", title: "Pose", open };

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, api } = studio;
  const request = new RequestView(api);
  const problem = new ProblemView();
  const joints = new JointList(store);
  const tip = new TipPose();
  const agreement = new Agreement(request.api, problem);
  const unit = new Choice("Unit of angles", [{ value: "rad", text: "rad" }, { value: "deg", text: "deg" }], (chosen) =>
    store.set({ degrees: chosen === "deg" }),
  );
  host.append(
    section("Joints", element("div", { class: "bar" }, ...presets(studio), element("span", { class: "spring" }), unit.host), joints.host),
    section("Tip", tip.host, agreement.host, problem.host),
    request.host,
  );
  const stops = [
    store.watch(["model", "base", "tip", "degrees"], ({ degrees }) => {
      unit.show(degrees ? "deg" : "rad");
      joints.build();
    }),
    store.watch(["model", "base", "tip", "degrees", "positions"], (state) => {
      joints.update();
      if (!state.model) return;
      const [base, end] = [state.base ?? state.model.ends.base_frame, state.tip ?? state.model.ends.tip_frame];
      const T = state.model.pose(base, end);
      tip.show(T, base, end, state.degrees);
      void agreement.check(state.model, base, end, state.positions, T);
    }),
    () => agreement.stop(),
    () => store.set({ joint: null }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

function presets({ store }: Studio): HTMLElement[] {
  const go = (which: "home" | "zero" | "random") => () => {
    const { model, base, tip, positions } = store.value;
    if (!model) return;
    const ends = [base ?? model.ends.base_frame, tip ?? model.ends.tip_frame] as const;
    store.set({ positions: which === "zero" ? model.zero() : which === "home" ? model.home(...ends) : model.random(...ends, positions) });
  };
  return [
    button("Home", go("home"), { title: "Each joint of the chain in the middle of its range" }),
    button("Zero", go("zero"), { title: "Every joint at zero" }),
    button("Random", go("random"), { title: "Each joint of the chain somewhere within its limits" }),
  ];
}
