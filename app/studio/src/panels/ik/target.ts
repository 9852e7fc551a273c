/** The part of the panel that says where the tip is to be: typed, dragged, moved by keys, or taken from a posture. */

import type { Matrix4 } from "three";

import { shownChain } from "../../robot/chain.ts";
import { asPose, formatOf, straightened } from "../../robot/pose.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { Pose } from "../../types.ts";
import { button, Choice, element, section } from "../../ui/dom.ts";
import { UNITS } from "../../ui/quantity.ts";
import type { Studio } from "../panel.ts";
import { UnitChoices } from "../units.ts";
import { TargetFields } from "./fields.ts";
import { type DragMode, Gizmo } from "./gizmo.ts";
import type { Part } from "./index.ts";
import type { Solver } from "./solver.ts";

const REST = 350; // ms after the last key that moved the target

export function targetPart(studio: Studio, solver: Solver): Part {
  const { store, view } = studio;
  const follow = (target: Pose): void => {
    const answer = solver.follow(target);
    view?.hold(answer);
  };
  const fields = new TargetFields({
    typed: (target) => store.set({ target }),
    nudged: (target) => {
      follow(target);
      solver.rest(REST);
    },
    units: () => store.value,
  });
  const drag = { dragged: follow, dropped: () => solver.rest() };
  const gizmo = view && new Gizmo(view, store, drag);
  const units = new UnitChoices(store);
  const modes = gizmo && dragModes(gizmo);
  const spring = element("span", { class: "spring" });
  const hint = element(
    "p",
    { class: "muted small", title: t("1 cm or 1° at a time, ten times as much with Shift") },
    gizmo
      ? t("Drag it in the picture, or press ↑ or ↓ in a field: the robot follows.")
      : t("Press ↑ or ↓ in a field: the robot follows."),
  );
  const stops = [
    followChain(store, solver),
    store.watch(["target", ...UNITS], ({ target }) => target && fields.show(target)),
    store.watch(["model", "base", "tip", "inverse"], () => modes?.show()),
    store.watch(UNITS, (state) => units.show(state)),
    () => gizmo?.close(),
  ];
  return {
    host: section(
      t("Target"),
      element("div", { class: "bar" }, modes && modes.host, ...presets(store), spring, units.host),
      fields.host,
      hint,
    ),
    close: () => stops.forEach((stop) => stop()),
  };
}

/** Turn what is typed, which is no rotation, into one. */
export function straighten(store: Store<State>): void {
  const { target } = store.value;
  if (target) aim(store, straightened(target));
}

/** A target in the notation of the one before. */
function aim(store: Store<State>, T_base_tip: Matrix4): void {
  const { target } = store.value;
  store.set({ target: asPose(T_base_tip, (target && formatOf(target)) ?? "rpy") });
}

/** Whether dragging moves or turns. */
function dragModes(gizmo: Gizmo): { host: HTMLElement; show: () => void } {
  const choose = (wanted: DragMode) => {
    choice.show(gizmo.turnTo(wanted));
    for (const mode of ["translate", "rotate"] as const) {
      choice.allow(mode, gizmo.allows(mode) ? null : t("None of its directions counts"));
    }
  };
  const choice = new Choice<DragMode>(
    t("Dragging in the picture"),
    [
      { value: "translate", text: t("Move") },
      { value: "rotate", text: t("Turn") },
    ],
    choose,
  );
  return { host: choice.host, show: () => choose(gizmo.mode) };
}

/** A target where there is none, and a new one where the chain has become another: where the tip is. */
function followChain(store: Store<State>, solver: Solver): () => void {
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
    if (!state.target || isStale) aim(store, poseAt(state, state.positions)!);
  });
}

function presets(store: Store<State>): HTMLElement[] {
  const go = (state: Readonly<State>, positions: State["positions"]) => {
    const T = poseAt(state, positions);
    if (T) aim(store, T);
  };
  const here = () => go(store.value, store.value.positions);
  const somewhere = () => {
    const chain = shownChain(store.value);
    if (chain) go(store.value, chain.model.random(chain.base, chain.tip, store.value.positions));
  };
  return [
    button(t("Here"), here, { title: t("Where the tip is now") }),
    button(t("Random"), somewhere, { title: t("Where a random configuration within the limits brings the tip") }),
  ];
}

/** T_base_tip at a configuration; the robot on the screen stays where it is. */
function poseAt(state: Readonly<State>, positions: State["positions"]): Matrix4 | null {
  const chain = shownChain(state);
  if (!chain) return null;
  chain.model.place(positions);
  const T_base_tip = chain.model.pose(chain.base, chain.tip);
  chain.model.place(state.positions);
  return T_base_tip;
}
