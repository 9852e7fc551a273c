/** Jacobian: the matrix, the ellipsoids at the tip with their measures, and what is lost near a singularity. */

import "../../styles/jacobian.css";

import { type Api, asProblem, Problem } from "../../api.ts";
import { type ShownChain, shownChain } from "../../robot/chain.ts";
import { choosing, type State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { Part, SingularityReport } from "../../types.ts";
import { Choice, element, section, titled } from "../../ui/dom.ts";
import { drawing, figureOf, svgOf } from "../../ui/drawing.ts";
import { ProblemView } from "../../ui/problem.ts";
import { UNITS } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { presets } from "../pose/index.ts";
import { JointList } from "../pose/joints.ts";
import { AxesView } from "./axes.ts";
import { type Answers, type Apis, Inquiry, type Listener } from "./calls.ts";
import { type Form, FORMS, formOf, type PartChoice, PARTS, partOf } from "./choices.ts";
import { MatrixView } from "./matrix.ts";
import { EllipsoidControls } from "./drawing.ts";
import { levers } from "./levers.ts";
import { SingularityView } from "./singularity.ts";

export const jacobianPanel: Panel = {
  id: "jacobian",
  title: t("Jacobian"),
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

function open(host: HTMLElement, studio: Studio): () => void {
  const { store } = studio;
  const views = new Views(studio);
  const inquiry = new Inquiry(views.apis, views);
  host.append(...views.hosts);
  const stops = [
    store.watch(["model", "base", "tip", ...UNITS], () => views.joints.build()),
    store.watch(UNITS, () => views.measure()),
    store.watch(["model", "base", "tip", "positions", "options"], (state) => {
      const [form, part] = [formOf(state), partOf(state)];
      views.choose(form, part);
      const chain = shownChain(state);
      if (chain?.path) inquiry.about(chain, form, part);
    }),
    store.watch(["joint"], () => views.matrix.mark()),
    store.watch(["joint", "dark", "unit", "options", ...UNITS], () => views.drawing.draw()),
    () => inquiry.stop(),
    () => views.drawing.close(),
    () => store.set({ joint: null }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

/** What the panel consists of. */
class Views implements Listener {
  readonly hosts: readonly HTMLElement[];
  readonly apis: Apis;
  readonly joints: JointList;
  readonly matrix: MatrixView;
  readonly drawing: EllipsoidControls;
  #axes = new AxesView();
  #answers: Answers | null = null;
  #nearest: [SingularityReport | null, ShownChain] | null = null;
  #singularity: SingularityView;
  #forms: Choice<string>;
  #parts: Choice<Part>;
  #problems = { matrix: new ProblemView(), all: new ProblemView() };

  constructor(studio: Studio) {
    const { store, api } = studio;
    const set = (option: string, usual: string) => (value: string) =>
      store.set(choosing(store.value, option, value === usual ? null : value));
    const requests = [t("the matrix"), t("the ellipsoids"), t("the levers"), t("the singularity")].map(
      (what) => new RequestView(api, what),
    );
    const [matrix, axes, statics, singularity] = requests.map((request) => request.api) as [Api, Api, Api, Api];
    this.apis = { matrix, axes, singularity, other: api };
    this.joints = new JointList(store);
    this.joints.host.classList.add("compact");
    this.matrix = new MatrixView(store, (joint) => visit(this.joints.host, joint));
    this.drawing = new EllipsoidControls(studio);
    this.#singularity = new SingularityView(
      () => store.value,
      (configuration) => move(studio, configuration),
    );
    this.#forms = new Choice(t("Axes and rates of the matrix"), FORMS, set("jacobian.form", FORMS[0]!.value));
    this.#parts = new Choice(t("What counts"), PARTS, set("jacobian.part", PARTS[0]!.value));
    const title = t("The arm with both ellipses, as a picture to save");
    const picture = drawing(t("Ellipses drawn"), title, this.#problems.all, () => ellipses(axes, store));
    this.hosts = [
      titled(t("Joints"), presets(studio), this.joints.host),
      titled(t("Jacobian"), [this.#forms.host], this.#problems.matrix.host, this.matrix.host),
      titled(
        t("Ellipsoids at the tip"),
        [this.#parts.host],
        this.drawing.host,
        this.#axes.host,
        this.drawing.words,
        element("div", { class: "bar" }, picture.ask),
        picture.place,
      ),
      levers(statics, store),
      section(t("Singularity"), this.#singularity.host, this.#problems.all.host),
      ...requests.map((request) => request.host),
    ];
  }

  choose(form: Form, part: PartChoice): void {
    this.#forms.show(form.value);
    this.#parts.show(part.value);
    this.joints.update();
  }

  answered(answers: Answers): void {
    const { matrix, form } = answers;
    this.#answers = answers;
    this.#problems.all.show(null);
    this.#problems.matrix.show(matrix instanceof Problem ? matrix : null);
    if (matrix instanceof Problem) this.matrix.clear();
    else this.matrix.show(matrix, form);
    this.measure();
    this.drawing.show(answers);
  }

  /** What of the last answer has units. */
  measure(): void {
    if (!this.#answers) return;
    const { axes, part, report } = this.#answers;
    this.#axes.show(axes, part.value);
    this.#singularity.show(report, axes.results[0]![part.value]);
    if (this.#nearest) this.nearest(...this.#nearest);
  }

  nearest(report: SingularityReport | null, chain: ShownChain): void {
    this.#nearest = [report, chain];
    this.#singularity.nearest(report, chain.joints);
  }

  failed(error: unknown): void {
    this.#problems.all.show(asProblem(error));
  }
}

/** The picture of translation at the tip, where the joints stand. */
async function ellipses(api: Api, { value }: Store<State>): Promise<HTMLElement> {
  const { path, ends, configuration } = shownChain(value)!;
  const body = { ...ends, joint_positions: [configuration] };
  const svg = await svgOf(api, { method: "POST", path: `${path}/manipulability`, body });
  return figureOf(svg, t("Velocity and force ellipses"), "ellipses", t("Save the ellipses as SVG"));
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
