/** Newton against the gradient from one start to the target: their errors, and the robot on their ways. */

import { asProblem, Latest } from "../../api.ts";
import { shownChain } from "../../robot/chain.ts";
import { t } from "../../texts/index.ts";
import { DIRECTIONS, type Errors, type InverseAnswer } from "../../types.ts";
import { button, Choice, element, section } from "../../ui/dom.ts";
import { inUnit, type Kind, type Units, unitOf } from "../../ui/quantity.ts";
import { ProblemView } from "../../ui/problem.ts";
import { Ghost } from "../../view/ghosts.ts";
import type { Studio } from "../panel.ts";
import { fullOptions, inverseCall } from "./call.ts";
import { type CourseMethod, stepAt, TITLES, type Way, wayOf } from "./course.ts";
import { errors, hasOrientation, hasPosition } from "./errors.ts";
import { type Curve, ErrorPlot } from "./plot.ts";
import { Stepper } from "./stepper.ts";
import { moved, type Solver } from "./solver.ts";

type Rival = Exclude<CourseMethod, "newton">;
type Start = "here" | "middle";

const OPACITY = 0.45;

export class Convergence {
  readonly host: HTMLElement;
  #rival: Rival = "gradient";
  #start: Start = "here";
  #latest = new Latest();
  #problem = new ProblemView();
  #ways: Way[] = [];
  #task: InverseAnswer["task"] = [...DIRECTIONS];
  #ghosts: Ghost[] = [];
  #lines: { now: HTMLElement; way: Way }[] = [];
  #legend = element("ul", { class: "ways" });
  #plot = new ErrorPlot((index) => this.#stepper.go(index));
  #stepper = new Stepper((index) => this.#show(index));
  #body = element("div", { class: "part", hidden: true }, this.#legend, this.#plot.host, this.#stepper.host);
  #run: HTMLButtonElement;
  #close: HTMLButtonElement;
  #isBusy = false;

  constructor(
    private readonly studio: Studio,
    private readonly solver: Solver,
  ) {
    const rival = new Choice<Rival>(
      t("Against Newton"),
      [
        { value: "gradient", text: t("Gradient") },
        { value: "gradient_then_newton", text: t("Gradient, then Newton") },
      ],
      (chosen) => this.#choose(() => rival.show((this.#rival = chosen))),
    );
    const start = new Choice<Start>(
      t("Start"),
      [
        { value: "here", text: t("This posture") },
        { value: "middle", text: t("Middle of ranges") },
      ],
      (chosen) => this.#choose(() => start.show((this.#start = chosen))),
    );
    rival.show(this.#rival);
    start.show(this.#start);
    this.#run = button(t("Compare"), () => (this.#isBusy ? this.clear() : void this.#compare()));
    this.#close = button(t("Close"), () => this.clear(), { hidden: true });
    this.host = section(
      t("Newton against gradient"),
      element(
        "div",
        { class: "bar" },
        element("span", { class: "field ways-title" }, t("Against")),
        rival.host,
        spring(),
        this.#run,
      ),
      element(
        "div",
        { class: "bar" },
        element("span", { class: "field ways-title" }, t("From")),
        start.host,
        spring(),
        this.#close,
      ),
      this.#problem.host,
      this.#body,
    );
  }

  /** Take away what was of another target, or stop what is under way. */
  clear(): void {
    this.#latest.cancel();
    this.#setBusy(false);
    this.#stepper.pause();
    this.#ways = [];
    this.#body.hidden = this.#close.hidden = true;
    this.#plot.close();
    this.#haunt();
    this.solver.outcome.set({ isWalking: false });
  }

  /** Draw anew, in the colours and units of now and with the meshes that are there. */
  draw(): void {
    if (this.#ways.length === 0) return;
    this.#name();
    this.#plot.show(this.#ways.flatMap((way) => curves(way, this.#task, this.studio.store.value)));
    this.#haunt();
    this.#show(this.#plot.at);
  }

  #choose(change: () => void): void {
    const wasShown = this.#ways.length > 0;
    this.clear();
    change();
    if (wasShown) void this.#compare();
  }

  async #compare(): Promise<void> {
    this.#problem.show(null);
    this.#setBusy(true);
    try {
      const ways = await this.#latest.run((signal) => this.#ask(signal));
      if (!ways) return;
      this.#setBusy(false);
      this.#open(ways);
    } catch (error) {
      this.clear();
      this.#problem.show(asProblem(error));
    }
  }

  async #ask(signal: AbortSignal): Promise<Way[]> {
    const state = this.studio.store.value;
    const chain = shownChain(state)!;
    const target = state.target!;
    const options = fullOptions(state.inverse, chain.joints.length);
    const ways = (["newton", this.#rival] as const).map(async (method) => {
      const { seeds, ...call } = inverseCall(chain, target, { ...options, method, solutions: "one" });
      const body = { ...call, ...(this.#start === "here" && { seeds }), trace: true };
      const answer = await this.studio.api.post<InverseAnswer>(`${chain.path}/ik`, body, signal);
      this.#task = answer.task;
      return wayOf(answer, method, chain, state, target);
    });
    return Promise.all(ways);
  }

  #open(ways: Way[]): void {
    this.#ways = ways;
    this.#body.hidden = this.#close.hidden = false;
    this.#lines = ways.map((way) => ({ way, now: element("span", { class: "way-now" }) }));
    this.#name();
    this.solver.outcome.set({ isWalking: true });
    this.#plot.mark(0);
    this.draw();
    this.#stepper.load(Math.max(...ways.map(({ steps }) => steps.length - 1)));
  }

  /** What the curves are, and where each way ends. */
  #name(): void {
    this.#legend.replaceChildren(
      ...this.#lines.map(({ way, now }) =>
        element(
          "li",
          { class: `way ${way.method === "newton" ? "newton" : "rival"}`, "data-method": way.method },
          element("span", {}, `${TITLES[way.method]} ${way.end}`, remainder(way, this.#task, this.studio.store.value)),
          now,
        ),
      ),
      element(
        "li",
        { class: "muted small" },
        t("{task} over the iterations", { task: meaning(this.#task, this.studio.store.value) }),
      ),
    );
  }

  #show(index: number): void {
    this.#plot.mark(index);
    for (const { way, now } of this.#lines) {
      const step = stepAt(way, index);
      now.textContent = t("Iteration {index}: {step} off", {
        index: Math.min(index, way.steps.length - 1),
        step: errors(step, this.#task, this.studio.store.value),
      });
      now.dataset["position"] = String(step.position_error);
      now.dataset["orientation"] = String(step.orientation_error);
    }
    const { store, view } = this.studio;
    for (const [i, ghost] of this.#ghosts.entries()) {
      const way = this.#ways[i]!;
      ghost.place(moved(store.value, way.joints, stepAt(way, index).joint_positions), store.value.positions);
    }
    view?.draw();
  }

  /** A ghost for each way, in the colour of its curves; none without ways. */
  #haunt(): void {
    for (const ghost of this.#ghosts) ghost.remove();
    const { store, view } = this.studio;
    const chain = shownChain(store.value);
    this.#ghosts = view && chain ? this.#ways.map((way) => this.#ghost(way, chain)) : [];
    view?.draw();
  }

  #ghost(way: Way, { model, joints }: NonNullable<ReturnType<typeof shownChain>>): Ghost {
    const ghost = new Ghost(model, joints, way.hue, OPACITY);
    ghost.group.name = `way ${way.method}`;
    this.studio.view!.scene.add(ghost.group);
    return ghost;
  }

  #setBusy(isBusy: boolean): void {
    this.#isBusy = isBusy;
    this.#run.textContent = isBusy ? t("Cancel") : t("Compare");
  }
}

function curves({ hue, steps }: Way, task: InverseAnswer["task"], units: Units): Curve[] {
  const made: Curve[] = [];
  const values = (name: keyof Errors, kind: Kind) => steps.map((step) => inUnit(step[name], kind, units));
  if (hasPosition(task)) made.push({ hue, isDashed: false, values: values("position_error", "length") });
  if (hasOrientation(task)) made.push({ hue, isDashed: true, values: values("orientation_error", "angle") });
  return made;
}

/** What is left of the error where a way ends. */
function remainder({ steps }: Way, task: InverseAnswer["task"], units: Units): string {
  const last = steps.at(-1);
  return last ? t(", {last} off at the end", { last: errors(last, task, units) }) : "";
}

function meaning(task: InverseAnswer["task"], units: Units): string {
  const [length, angle] = [unitOf("length", units), unitOf("angle", units)];
  if (!hasOrientation(task)) return t("Distance to the target [{length}]", { length });
  if (!hasPosition(task)) return t("Angle to the target [{angle}], dashed,", { angle });
  return t("Distance [{length}] and, dashed, angle [{angle}] to the target", { length, angle });
}

function spring(): HTMLElement {
  return element("span", { class: "spring" });
}
