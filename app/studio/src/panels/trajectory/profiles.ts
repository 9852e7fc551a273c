/** Position, velocity, acceleration and jerk of the joints over time, with their limits and the time that is shown. */

import "uplot/dist/uPlot.min.css";

import uPlot from "uplot";

import { type Joint, kindOf } from "../../robot/model.ts";
import { chosen, choosing, type State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { Choice, element, toggle } from "../../ui/dom.ts";
import { inUnit } from "../../ui/quantity.ts";
import { leftIn, shareOf } from "../../ui/pointer.ts";
import { jointHue, paint } from "../../view/colours.ts";
import type { TrajectoryAnswer } from "../../types.ts";
import type { Curve, Derivative, Samples } from "./curve.ts";
import { effortUnit, unitsOf } from "./fields.ts";
import { Legend } from "./legend.ts";
import type { Torques } from "./torques.ts";

const QUANTITIES = [
  { value: "position", text: t("Position"), per: "", limit: null },
  { value: "velocity", text: t("Velocity"), per: "/s", limit: "joint_velocity" },
  { value: "acceleration", text: t("Acceleration"), per: "/s²", limit: "joint_acceleration" },
  { value: "jerk", text: t("Jerk"), per: "/s³", limit: "joint_jerk" },
  { value: "torque", text: t("Torque"), per: "", limit: "joint_torque" },
] as const;
type Quantity = (typeof QUANTITIES)[number]["value"];
/** What is drawn where nothing else is chosen stands first. */
const CHOICES: readonly Quantity[] = ["velocity", "position", "acceleration", "jerk", "torque"];
const EXTENTS = ["near", "all"] as const;
const HEIGHT = 184;
const LEAST_SAMPLES = 600;
const DASH = [5, 4];
/** Of a line in the plot, in pixels. */
const WIDTH = 1.5;

/** A motion that is drawn. */
export interface Drawn {
  curve: Curve;
  /** Null where they were not asked for. */
  torques: Torques | null;
  answer: TrajectoryAnswer;
  joints: readonly Joint[];
}

export class Profiles {
  readonly host: HTMLElement;
  #choice: Choice<Quantity>;
  #unit = element("span", { class: "unit" });
  #canvas = element("div", { class: "profiles" });
  #legend: Legend;
  #now = element("div", { class: "profile-now" });
  #plot: uPlot | null = null;
  #drawn: Drawn | null = null;
  #time = 0;
  #limits = toggle(t("All limits"), t("Scale the plot so that every limit is on it"), () =>
    this.#choose("trajectory.limits", this.#showsLimits ? null : "all"),
  );
  #observer: ResizeObserver;

  /** @param go is told of the time that is clicked, [s]. */
  constructor(
    private readonly store: Store<State>,
    private readonly go: (time: number) => void,
  ) {
    this.#choice = new Choice(t("Quantity"), QUANTITIES, (quantity) =>
      this.#choose("trajectory.plot", quantity === CHOICES[0] ? null : quantity),
    );
    this.#legend = new Legend(store, (index, isShown) => {
      this.point(null);
      for (const line of [1, 2, 3]) this.#plot?.setSeries(3 * index + line, { show: isShown });
    });
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(this.#canvas);
    this.host = element(
      "div",
      { class: "part" },
      element(
        "div",
        { class: "bar profile-bar" },
        this.#choice.host,
        this.#unit,
        element("span", { class: "spring" }),
        this.#limits,
      ),
      this.#canvas,
      this.#legend.host,
    );
  }

  /** A motion, or none, at a time. */
  show(drawn: Drawn | null, time: number): void {
    this.#drawn = drawn;
    this.#time = time;
    this.draw();
  }

  /** Anew: what is chosen, in the units and the colours of the page. */
  draw(): void {
    this.#plot?.destroy();
    this.#plot = null;
    this.#limits.setAttribute("aria-pressed", String(this.#showsLimits));
    if (!this.#drawn) return;
    const { joints, torques } = this.#drawn;
    const { value, text, per } = this.#quantity;
    this.#choice.allow("torque", torques ? null : t("Ask for them under “Torques and payload”, and plan again"));
    this.#choice.show(value);
    const units = new Set(joints.map(effortUnit));
    const unit = value === "torque" ? [...units].join(t(" or ")) : unitsOf(joints, this.store.value, per);
    this.#unit.textContent = `[${unit}]`;
    this.#canvas.setAttribute("role", "img");
    this.#canvas.setAttribute("aria-label", t("{text} of each joint over time; its limits are dashed", { text }));
    const samples = this.#values.sample();
    const series = joints.map((joint, i) => this.#lines(joint, i, samples));
    const data = [samples.times, ...series.flat()] as uPlot.AlignedData;
    this.#plot = new uPlot(this.#options(joints), data, this.#canvas);
    this.#plot.over.append(this.#now);
    this.#follow(this.#plot.over);
    this.#legend.list(joints);
    this.at(this.#time);
  }

  /** Show a time, and the values then. */
  at(time: number): void {
    this.#time = time;
    if (!this.#plot || !this.#drawn) return;
    this.#now.style.transform = `translateX(${this.#plot.valToPos(time, "x")}px)`;
    this.#legend.tell(this.#values.at(time).map((value, i) => value * this.#factor(this.#drawn!.joints[i]!)));
  }

  /** Bring one joint to the front, or none. */
  point(joint: string | null): void {
    const index = this.#drawn?.joints.findIndex((one) => one.name === joint && this.#legend.isShown(one)) ?? -1;
    this.#plot?.setSeries(index < 0 ? null : 1 + 3 * index, { focus: true });
  }

  stop(): void {
    this.#observer.disconnect();
    this.#plot?.destroy();
  }

  get #quantity(): (typeof QUANTITIES)[number] {
    const wanted = chosen(this.store.value, "trajectory.plot", CHOICES);
    const quantity = wanted === "torque" && !this.#drawn?.torques ? CHOICES[0] : wanted;
    return QUANTITIES.find(({ value }) => value === quantity)!;
  }

  get #values(): { sample: () => Samples; at: (time: number) => number[] } {
    const { curve, torques } = this.#drawn!;
    const { value } = this.#quantity;
    if (value === "torque") return torques!;
    const derivative = QUANTITIES.findIndex((one) => one.value === value) as Derivative;
    return {
      sample: () => curve.sample(derivative, LEAST_SAMPLES),
      at: (time) => curve.at(time, derivative),
    };
  }

  get #showsLimits(): boolean {
    return chosen(this.store.value, "trajectory.limits", EXTENTS) === "all";
  }

  #choose(option: string, value: string | null): void {
    this.store.set(choosing(this.store.value, option, value));
  }

  /** A joint's values, its lower and its upper limit: null where there is none. */
  #lines(joint: Joint, index: number, { values, pieces }: Samples): (number | null)[][] {
    const factor = this.#factor(joint);
    const scaled = values[index]!.map((value) => value * factor);
    const { curve, answer } = this.#drawn!;
    const { limit: key } = this.#quantity;
    const times = (by: number) => (limit: number | null) => (limit === null ? null : limit * by);
    if (!key) return [scaled, ...[joint.lower, joint.upper].map((limit) => pieces.map(() => times(factor)(limit)))];
    const limits = pieces.map((piece) => limitIn(answer, curve, piece, key)?.[index] ?? null);
    return [scaled, limits.map(times(-factor)), limits.map(times(factor))];
  }

  #factor(joint: Joint): number {
    return this.#quantity.value === "torque" ? 1 : inUnit(1, kindOf(joint), this.store.value);
  }

  #options(joints: readonly Joint[]): uPlot.Options {
    const tone = paint("muted");
    const font = `12px ${getComputedStyle(this.host).fontFamily}`;
    const axis = { stroke: tone, font, grid: { stroke: paint("line"), width: 1 }, ticks: { show: false }, gap: 4 };
    const series = joints.flatMap((joint, i) => {
      const stroke = paint(jointHue(i));
      const show = this.#legend.isShown(joint);
      const limit = { stroke, show, width: 1, dash: DASH, points: { show: false } };
      return [{ stroke, show, width: WIDTH, pxAlign: 0, points: { show: false } }, limit, limit];
    });
    return {
      width: Math.max(this.#canvas.clientWidth, 200),
      height: HEIGHT,
      padding: [8, 14, 0, 0],
      scales: {
        x: { time: false, range: (_, from, to) => [from, to] },
        y: { range: (plot) => extent(plot, this.#showsLimits) },
      },
      axes: [
        { ...axis, size: 24, values: (_, splits) => splits.map((value) => `${value} s`) },
        { ...axis, size: 40, values: (_, splits) => splits.map((value) => String(value).replace("-", "−")) },
      ],
      series: [{}, ...series],
      legend: { show: false },
      focus: { alpha: 0.2 },
      cursor: {
        y: false,
        drag: { x: false, y: false },
        points: { show: false },
        move: ({ over }, left, top) => [left * shareOf(over), top * shareOf(over)],
      },
      hooks: { drawAxes: [(plot) => this.#drawEnds(plot)] },
    };
  }

  /** Where one segment ends and the next begins. */
  #drawEnds({ ctx, bbox, valToPos }: uPlot): void {
    ctx.save();
    ctx.strokeStyle = paint("field-line");
    ctx.lineWidth = 1;
    for (const { end_time } of this.#drawn!.answer.segments.slice(0, -1)) {
      const x = Math.round(valToPos(end_time, "x", true)) + 0.5;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
    ctx.restore();
  }

  /** A click goes to its time, and so does every move of a pressed pointer. */
  #follow(over: HTMLElement): void {
    const go = (event: PointerEvent) => {
      const { duration } = this.#drawn!.curve;
      this.go(Math.max(0, Math.min(duration, this.#plot!.posToVal(leftIn(over, event), "x"))));
    };
    over.addEventListener("pointerdown", (event) => {
      over.setPointerCapture(event.pointerId);
      go(event);
    });
    over.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) go(event);
    });
  }

  #resize(): void {
    const width = this.#canvas.clientWidth;
    if (!this.#plot || !width || width === this.#plot.width) return;
    this.#plot.setSize({ width, height: HEIGHT });
    this.at(this.#time);
  }
}

/** The limits of the joints in a piece: those of the segment that it is in. */
function limitIn(
  { segments, limits }: TrajectoryAnswer,
  curve: Curve,
  piece: number,
  key: NonNullable<(typeof QUANTITIES)[number]["limit"]>,
): readonly (number | null)[] | null | undefined {
  const middle = (curve.breaks[piece]! + curve.breaks[piece + 1]!) / 2;
  const segment = segments.find(({ start_time, end_time }) => start_time <= middle && middle <= end_time);
  return (segment?.limits ?? limits)[key];
}

/** All of the lines, and all limits or those that are not further away from them than they are wide. */
function extent(plot: uPlot, showsLimits: boolean): [number, number] {
  const drawn = plot.series.map(({ show }, i) => (show && i > 0 ? (plot.data[i] as (number | null)[]) : []));
  let [low, high] = range(drawn.filter((_, i) => i % 3 === 1));
  if (low > high) [low, high] = [0, 0];
  const span = showsLimits ? Infinity : high - low || Math.abs(high) || 1;
  for (const line of drawn.filter((_, i) => i % 3 !== 1)) {
    const [from, to] = range([line]);
    if (from > high && from <= high + span) high = Math.max(high, to);
    if (to < low && to >= low - span) low = Math.min(low, from);
  }
  const margin = 0.06 * (high - low || 1);
  return [low - margin, high + margin];
}

function range(lines: readonly (readonly (number | null)[])[]): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const line of lines) {
    for (const value of line) {
      if (value === null) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  return [low, high];
}
