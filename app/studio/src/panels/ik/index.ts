/** Inverse kinematics: say where the tip is to be, see every way to get there, and take one. */

import "../../styles/ik.css";

import { t } from "../../texts/index.ts";
import { button, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { UNITS } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { Convergence } from "./convergence.ts";
import { FamilyList } from "./families.ts";
import { OptionFields } from "./options.ts";
import { Picture } from "./picture.ts";
import { SolutionList } from "./solutions.ts";
import { Solver } from "./solver.ts";
import { straighten, targetPart } from "./target.ts";
import { Verdict } from "./verdict.ts";

export const inversePanel: Panel = {
  id: "ik",
  title: t("Inverse"),
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

/** A part of the panel, and how to undo what it does. */
export interface Part {
  host: HTMLElement;
  close: () => void;
}

function open(host: HTMLElement, studio: Studio): () => void {
  const request = new RequestView(studio.api);
  const solver = new Solver(request.api, studio.store);
  const parts = [
    targetPart(studio, solver),
    solutionsPart(studio, solver),
    convergencePart({ ...studio, api: request.api }, solver),
  ];
  host.append(...parts.map((part) => part.host), request.host);
  return () => {
    solver.cancel();
    for (const part of parts) part.close();
  };
}

function solutionsPart({ store, view }: Studio, solver: Solver): Part {
  const { outcome } = solver;
  const options = new OptionFields(store, () => void solver.solve());
  const problem = new ProblemView();
  const repair = button(t("Make it a rotation"), () => straighten(store), { hidden: true });
  const verdict = new Verdict(store, solver);
  const list = new SolutionList(store, outcome);
  const families = new FamilyList(store, outcome);
  const picture = view && new Picture(view, store, outcome);
  const stops = [
    store.watch(["model", "base", "tip", "target", "inverse", "scene"], ({ target }) => {
      if (target && !solver.isAfter(target)) void solver.solve();
    }),
    store.watch(["model", "base", "tip", "inverse", ...UNITS], (state) => options.show(state)),
    store.watch(["positions", ...UNITS], () => {
      list.show();
      verdict.follow();
    }),
    store.watch(UNITS, () => verdict.show()),
    outcome.watch(["result"], () => {
      list.show();
      families.show();
    }),
    outcome.watch(["result", "isBusy", "isFollowing", "isCancelled"], () => verdict.show()),
    outcome.watch(["problem"], ({ problem: found }) => {
      problem.show(found);
      repair.hidden = !found?.places.some(({ pointer }) => pointer.startsWith("#/targets"));
    }),
    () => verdict.close(),
    () => picture?.close(),
  ];
  return {
    host: section(t("Solutions"), options.host, problem.host, repair, verdict.host, families.host, list.host),
    close: () => stops.forEach((stop) => stop()),
  };
}

function convergencePart(studio: Studio, solver: Solver): Part {
  const convergence = new Convergence(studio, solver);
  const stops = [
    studio.store.watch(["model", "base", "tip", "target", "inverse"], () => convergence.clear()),
    studio.store.watch(["dark", "meshes", ...UNITS], () => convergence.draw()),
    () => convergence.clear(),
  ];
  return { host: convergence.host, close: () => stops.forEach((stop) => stop()) };
}
