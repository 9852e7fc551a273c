/** Jacobian: the matrix, the ellipsoids at the tip with their measures, and what is lost near a singularity. */

import "../../styles/jacobian.css";

import { Latest, Problem } from "../../api.ts";
import { type ShownChain, shownChain } from "../../robot/chain.ts";
import { asProblem } from "../../robot/load.ts";
import { choosing } from "../../state.ts";
import { Choice, section, titled } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { presets } from "../pose/index.ts";
import { JointList } from "../pose/joints.ts";
import { AxesView } from "./axes.ts";
import { type Answers, ask, askNearest } from "./calls.ts";
import { FORMS, formOf, PARTS, partOf } from "./choices.ts";
import { MatrixView } from "./matrix.ts";
import { EllipsoidControls } from "./drawing.ts";
import { SingularityView } from "./singularity.ts";

export const jacobianPanel: Panel = {
  id: "jacobian",
  title: "Jacobian",
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

/** The nearest singularity takes longer to find than a slider's next step: it is looked for after a rest, [ms]. */
const REST = 250;

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, api } = studio;
  const requests = {
    matrix: new RequestView(api, "the matrix"),
    axes: new RequestView(api, "the ellipsoids"),
    singularity: new RequestView(api, "the singularity"),
  };
  const problems = { matrix: new ProblemView(), all: new ProblemView() };
  const joints = new JointList(store);
  joints.host.classList.add("compact");
  const matrix = new MatrixView(store, (joint) => visit(joints.host, joint));
  const axes = new AxesView();
  const drawing = new EllipsoidControls(studio);
  const singularity = new SingularityView((configuration) => move(studio, configuration));
  const choose = (option: string, usual: string) => (value: string) =>
    store.set(choosing(store.value, option, value === usual ? null : value));
  const forms = new Choice("Axes and rates of the matrix", FORMS, choose("jacobian.form", FORMS[0]!.value));
  const parts = new Choice("What counts", PARTS, choose("jacobian.part", PARTS[0]!.value));
  host.append(
    titled("Joints", presets(studio), joints.host),
    titled("Jacobian", [forms.host], problems.matrix.host, matrix.host),
    titled("Ellipsoids at the tip", [parts.host], drawing.host, axes.host, drawing.words),
    section("Singularity", singularity.host, problems.all.host),
    ...Object.values(requests).map((request) => request.host),
  );

  const show = (answers: Answers) => {
    problems.all.show(null);
    problems.matrix.show(answers.matrix instanceof Problem ? answers.matrix : null);
    if (answers.matrix instanceof Problem) matrix.clear();
    else matrix.show(answers.matrix, answers.form);
    axes.show(answers.axes, answers.part.value);
    singularity.show(answers.report, answers.axes.results[0]![answers.part.value]);
    drawing.show(answers);
  };
  const fail = (error: unknown) => problems.all.show(asProblem(error));

  const apis = {
    matrix: requests.matrix.api,
    axes: requests.axes.api,
    singularity: requests.singularity.api,
    other: api,
  };
  const [latest, seeking] = [new Latest(), new Latest()];
  let timer = 0;
  const refresh = () => {
    const [form, counted] = [formOf(store.value), partOf(store.value)];
    forms.show(form.value);
    parts.show(counted.value);
    joints.update();
    const chain = shownChain(store.value);
    clearTimeout(timer);
    seeking.cancel();
    if (!chain?.path) return;
    latest
      .run((signal) => ask(apis, chain, form, counted, signal))
      .then((answers) => answers && show(answers))
      .catch(fail);
    singularity.nearest(null);
    timer = window.setTimeout(() => {
      seeking
        .run((signal) => askNearest(apis.singularity, chain, counted, signal))
        .then((report) => report && singularity.nearest(report, chain.joints))
        .catch(fail);
    }, REST);
  };
  const stops = [
    store.watch(["model", "base", "tip", "degrees"], () => joints.build()),
    store.watch(["model", "base", "tip", "positions", "options"], refresh),
    store.watch(["joint"], () => matrix.mark()),
    store.watch(["joint", "dark", "unit", "options"], () => drawing.draw()),
    () => latest.cancel(),
    () => seeking.cancel(),
    () => clearTimeout(timer),
    () => drawing.close(),
    () => store.set({ joint: null }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

/** To the slider of a joint. */
function visit(list: HTMLElement, joint: string): void {
  const sliders = [...list.querySelectorAll<HTMLInputElement>("input[type=range]")];
  sliders.find((slider) => slider.getAttribute("aria-label") === joint)?.focus();
}

/** Put the chain at a configuration. */
function move({ store }: Studio, configuration: readonly number[]): void {
  const chain: ShownChain | null = shownChain(store.value);
  if (!chain) return;
  const moved = Object.fromEntries(chain.joints.map(({ name }, i) => [name, configuration[i]!]));
  store.set({ positions: { ...store.value.positions, ...moved } });
}
