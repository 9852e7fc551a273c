/** Inverse kinematics: say where the tip is to be, see every way to get there, and take one. */

import "../../styles/ik.css";

import { shownChain } from "../../robot/chain.ts";
import { asPose, straightened } from "../../robot/pose.ts";
import type { Pose } from "../../types.ts";
import { button, Choice, element, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { type DragMode, Gizmo } from "./gizmo.ts";
import { OptionFields } from "./options.ts";
import { Picture } from "./picture.ts";
import { SolutionList } from "./solutions.ts";
import { Solver } from "./solver.ts";
import { TargetFields } from "./target.ts";
import { Verdict } from "./verdict.ts";

const REST = 350; // ms after the last key that moved the target

export const inversePanel: Panel = {
  id: "ik",
  title: "Inverse",
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, api, view } = studio;
  const request = new RequestView(api);
  const problem = new ProblemView();
  const solver = new Solver(request.api, store);
  const fields = new TargetFields({
    typed: (target) => store.set({ target }),
    nudged: (target) => {
      solver.follow(target);
      solver.rest(REST);
    },
    degrees: () => store.value.degrees,
  });
  const options = new OptionFields(store, () => void solver.solve());
  const verdict = new Verdict(store, solver);
  const list = new SolutionList(store, solver.outcome);
  const picture = view && new Picture(view, store, solver.outcome);
  const gizmo =
    view && new Gizmo(view, store, { dragged: (target) => solver.follow(target), dropped: () => solver.rest() });
  const drag = new Choice<DragMode>(
    "Dragging in the picture",
    [
      { value: "translate", text: "Move" },
      { value: "rotate", text: "Turn" },
    ],
    (mode) => turnTo(mode),
  );
  const turnTo = (wanted: DragMode) => {
    const mode = gizmo?.turnTo(wanted) ?? wanted;
    drag.show(mode);
    for (const other of ["translate", "rotate"] as const) {
      drag.allow(other, gizmo?.allows(other) ? null : "None of its directions counts");
    }
  };
  const unit = new Choice(
    "Unit of angles",
    [
      { value: "rad", text: "rad" },
      { value: "deg", text: "deg" },
    ],
    (chosen) => store.set({ degrees: chosen === "deg" }),
  );
  const straighten = button("Make it a rotation", () => store.set({ target: straight(store.value.target!, fields) }), {
    hidden: true,
  });
  const hint = element(
    "p",
    { class: "muted small", title: "1 cm or 1° at a time, ten times as much with Shift" },
    `${gizmo ? "Drag it in the picture, or press" : "Press"} ↑ or ↓ in a field: the robot follows.`,
  );
  host.append(
    section(
      "Target",
      element(
        "div",
        { class: "bar" },
        gizmo && drag.host,
        ...presets(studio, fields),
        element("span", { class: "spring" }),
        unit.host,
      ),
      fields.host,
      hint,
    ),
    section("Solutions", options.host, problem.host, straighten, verdict.host, list.host),
    request.host,
  );
  const stops = [
    followChain(studio, fields, solver),
    store.watch(["model", "base", "tip", "target", "inverse"], ({ target }) => {
      if (target && !solver.outcome.value.isFollowing) void solver.solve();
    }),
    store.watch(["target", "degrees"], ({ target }) => target && fields.show(target)),
    store.watch(["model", "base", "tip", "inverse", "degrees"], (state) => options.show(state)),
    store.watch(["model", "base", "tip", "inverse"], () => turnTo(gizmo?.mode ?? "translate")),
    store.watch(["degrees"], ({ degrees }) => unit.show(degrees ? "deg" : "rad")),
    store.watch(["positions", "degrees"], () => list.show()),
    solver.outcome.watch(["result"], () => list.show()),
    solver.outcome.watch(["result", "isBusy", "isFollowing", "isCancelled"], () => verdict.show()),
    solver.outcome.watch(["problem"], ({ problem: found }) => {
      problem.show(found);
      straighten.hidden = !found?.places.some(({ pointer }) => pointer.startsWith("#/targets"));
    }),
    () => solver.cancel(),
    () => verdict.close(),
    () => picture?.close(),
    () => gizmo?.close(),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

/** A target where there is none, and a new one where the chain has become another: where the tip is. */
function followChain({ store }: Studio, fields: TargetFields, solver: Solver): () => void {
  let ends = "";
  let before: Pose | null = null;
  return store.watch(["model", "base", "tip", "target"], (state) => {
    const chain = shownChain(state);
    if (!chain) return;
    const now = `${chain.model.name} ${chain.base} ${chain.tip}`;
    const isStale = ends !== "" && now !== ends && before === state.target;
    if (now !== ends) solver.forget();
    ends = now;
    before = state.target;
    if (!state.target || isStale) {
      chain.model.place(state.positions);
      store.set({ target: asPose(chain.model.pose(chain.base, chain.tip), fields.format) });
    }
  });
}

function presets({ store }: Studio, fields: TargetFields): HTMLElement[] {
  const here = () => {
    const chain = shownChain(store.value);
    if (chain) store.set({ target: asPose(chain.model.pose(chain.base, chain.tip), fields.format) });
  };
  const somewhere = () => {
    const chain = shownChain(store.value);
    if (!chain) return;
    const { model, base, tip } = chain;
    const { positions } = store.value;
    model.place(model.random(base, tip, positions));
    const T = model.pose(base, tip);
    model.place(positions);
    store.set({ target: asPose(T, fields.format) });
  };
  return [
    button("Here", here, { title: "Where the tip is now" }),
    button("Random", somewhere, { title: "Where a random configuration within the limits brings the tip" }),
  ];
}

function straight(target: Pose, fields: TargetFields): Pose {
  return asPose(straightened(target), fields.format);
}
