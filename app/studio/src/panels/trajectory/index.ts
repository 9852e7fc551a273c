/** Trajectory: build a motion from poses of the arm, have it planned, play it and see how near it comes to its limits. */

import "../../styles/trajectory.css";

import { t } from "../../texts/index.ts";
import { section } from "../../ui/dom.ts";
import { UNITS } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { Arm } from "./arm.ts";
import { ClearancePlot } from "./clearance.ts";
import { Draft } from "./draft.ts";
import { Ends } from "./ends.ts";
import { Loads } from "./loads.ts";
import { belongs, missing } from "./motion.ts";
import { Planner } from "./planner.ts";
import { Result } from "./result.ts";
import { MotionMarks } from "./scene.ts";
import { SegmentList } from "./segments.ts";
import { Settings } from "./settings.ts";
import { Tool } from "./tool.ts";

export const trajectoryPanel: Panel = {
  id: "trajectory",
  title: t("Trajectory"),
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, view } = studio;
  const draft = new Draft(store);
  const asked = new RequestView(studio.api);
  const marks = view && new MotionMarks(view);
  const showPlaces = () => marks?.showPlaces(draft.chain, draft.motion, store.value.plan, store.value.unit, list.open);
  const list = new SegmentList(draft, showPlaces);
  const settings = new Settings(draft);
  const tool = new Tool(draft);
  const ends = new Ends(draft);
  const loads = new Loads(draft);
  const arm = new Arm(studio);
  const result = new Result(draft, asked.api, new ClearancePlot(studio.api, () => store.value), marks, view);
  const planner = new Planner(
    draft,
    asked,
    (places) => loads.fail(ends.fail(tool.fail(list.fail(places)))),
    (isFocusFree) => {
      result.begin();
      if (isFocusFree) result.reveal();
    },
  );
  host.append(
    section(t("Motion"), list.host, tool.host, arm.host, settings.host, ends.host, loads.host, planner.host),
    result.host,
    asked.host,
  );
  const stops = [
    store.watch(["model", "base", "tip", "motion", ...UNITS, "plan", "scene"], ({ plan }) => {
      draft.begin();
      list.update();
      settings.update(plan && belongs(plan.motion, draft.chain) ? plan.answer.limits : null);
      list.host.hidden = draft.motion.path !== undefined;
      tool.update();
      ends.update();
      loads.update();
      planner.update();
      result.update();
    }),
    store.watch(["model", "base", "tip", "motion", "plan", "unit", "dark"], showPlaces),
    store.watch(["unit", "dark"], () => result.drawWay()),
    store.watch(["dark", "options"], () => result.drawProfiles()),
    store.watch(["joint"], ({ joint }) => result.point(joint)),
    store.watch(["positions"], () => {
      marks?.follow(draft.chain);
      planner.update();
    }),
    () => planner.stop(),
    () => arm.stop(),
    () => result.stop(),
    () => marks?.remove(),
  ];
  const { plan } = store.value;
  if (!(plan && belongs(plan.motion, draft.chain)) && missing(draft.motion) === null) void planner.plan();
  return () => {
    for (const stop of stops) stop();
  };
}
