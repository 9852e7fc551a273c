/** Position, velocity, acceleration and jerk of the joints over time, with their limits and the time that is shown. */

import "uplot/dist/uPlot.min.css";

import uPlot from "uplot";

import type { Joint } from "../../robot/model.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { button, Choice, element } from "../../ui/dom.ts";
import { fixed, unitOf } from "../../ui/quantity.ts";
import { type Hue, paint } from "../../view/colours.ts";
import type { JointLimits, TrajectoryAnswer } from "./answer.ts";
import type { Curve, Derivative, Samples } from "./curve.ts";
import { kindOf } from "./fields.ts";

const QUANTITIES = [
  { value: "0", text: "Position", per: "" },
  { value: "1", text: "Velocity", per: "/s" },
  { value: "2", text: "Acceleration", per: "/s²" },
  { value: "3", text: "Jerk", per: "/s³" },
] as const;
const LIMITS = [null, "joint_velocity", "joint_acceleration", "joint_jerk"] as const;
const HUES = 8;
const HEIGHT = 184;
const LEAST_SAMPLES = 600;
const DASH = [5, 4];
/** Of a line in the plot, in pixels. */
const WIDTH = 1.5;

/** A motion that is drawn. */
export interface Drawn {
  curve: Curve;
  answer: TrajectoryAnswer;
  joints: readonly Joint[];
}

export class Profiles {
  readonly host: HTMLElement;
  #quantity: Derivative = 1;
  #choice: Choice<(typeof QUANTITIES)[number]["value"]>;
  #unit = element("span", { class: "unit" });
  #canvas = element("div", { class: "profiles" });
  #legend = element("div", { class: "profile-legend", role: "group", "aria-label": "Joints in the plot" });
  #values: HTMLElement[] = [];
  #now = element("div", { class: "profile-now" });
  #plot: uPlot | null = null;
  #drawn: Drawn | null = null;
  #hidden = new Set<string>();
  #time = 0;
  #observer: ResizeObserver;

  /** @param go is told of the time that is clicked, [s]. */
  constructor(
    private readonly store: Store<State>,
    private readonly go: (time: number) => void,
  ) {
    this.#choice = new Choice("Quantity", QUANTITIES, (chosen) => {
      this.#quantity = Number(chosen) as Derivative;
      this.draw();
    });
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(this.#canvas);
    this.host = element(
      "div",
      { class: "part" },
      element("div", { class: "bar" }, this.#choice.host, this.#unit),
      this.#canvas,
      this.#legend,
    );
  }

  /** A motion, or none, at a time. */
  show(drawn: Drawn | null, time: number): void {
    this.#drawn = drawn;
    this.#time = time;
    this.draw();
  }

  /** Anew, in the unit of angles and the colours of the page. */
  draw(): void {
    this.#plot?.destroy();
    this.#plot = null;
    this.#choice.show(String(this.#quantity) as "0");
    if (!this.#drawn) return;
    const { curve, joints } = this.#drawn;
    const name = QUANTITIES[this.#quantity];
    const degrees = this.store.value.degrees;
    const units = new Set(joints.map((joint) => unitOf(kindOf(joint), degrees) + name.per));
    this.#unit.textContent = `[${[...units].join(" or ")}]`;
    this.#canvas.setAttribute("role", "img");
    this.#canvas.setAttribute("aria-label", `${name.text} of each joint over time; its limits are dashed`);
    const samples = curve.sample(this.#quantity, LEAST_SAMPLES);
    const series = joints.map((joint, i) => this.#lines(joint, i, samples));
    const data = [samples.times, ...series.flat()] as uPlot.AlignedData;
    this.#plot = new uPlot(this.#options(joints), data, this.#canvas);
    this.#plot.over.append(this.#now);
    this.#follow(this.#plot.over);
    this.#list(joints);
    this.at(this.#time);
  }

  /** Show a time, and the values then. */
  at(time: number): void {
    this.#time = time;
    if (!this.#plot || !this.#drawn) return;
    this.#now.style.transform = `translateX(${this.#plot.valToPos(time, "x")}px)`;
    const values = this.#drawn.curve.at(time, this.#quantity);
    for (const [i, cell] of this.#values.entries())
      cell.textContent = fixed(values[i]! * this.#factor(this.#drawn.joints[i]!), 3);
  }

  /** Bring one joint to the front, or none. */
  point(joint: string | null): void {
    const index = this.#drawn?.joints.findIndex(({ name }) => name === joint && !this.#hidden.has(name)) ?? -1;
    this.#plot?.setSeries(index < 0 ? null : 1 + 3 * index, { focus: true });
  }

  stop(): void {
    this.#observer.disconnect();
    this.#plot?.destroy();
  }

  /** A joint's values, its lower and its upper limit: null where there is none. */
  #lines(joint: Joint, index: number, { values, pieces }: Samples): (number | null)[][] {
    const factor = this.#factor(joint);
    const scaled = values[index]!.map((value) => value * factor);
    const { curve, answer } = this.#drawn!;
    const key = LIMITS[this.#quantity];
    if (!key) {
      const along = (limit: number | null) => pieces.map(() => (limit === null ? null : limit * factor));
      return [scaled, along(joint.lower), along(joint.upper)];
    }
    const upper = pieces.map((piece) => limitIn(answer, curve, piece, key)[index]! * factor);
    return [scaled, upper.map((value) => -value), upper];
  }

  #factor(joint: Joint): number {
    return kindOf(joint) === "angle" && this.store.value.degrees ? 180 / Math.PI : 1;
  }

  #options(joints: readonly Joint[]): uPlot.Options {
    const tone = paint("muted");
    const font = `12px ${getComputedStyle(this.host).fontFamily}`;
    const axis = { stroke: tone, font, grid: { stroke: paint("line"), width: 1 }, ticks: { show: false }, gap: 4 };
    const series = joints.flatMap((joint, i) => {
      const stroke = paint(hue(i));
      const show = !this.#hidden.has(joint.name);
      const limit = { stroke, show, width: 1, dash: DASH, points: { show: false } };
      return [{ stroke, show, width: WIDTH, pxAlign: 0, points: { show: false } }, limit, limit];
    });
    return {
      width: Math.max(this.#canvas.clientWidth, 200),
      height: HEIGHT,
      padding: [8, 14, 0, 0],
      scales: { x: { time: false, range: (_, from, to) => [from, to] }, y: { range: (plot) => extent(plot) } },
      axes: [
        { ...axis, size: 24, values: (_, splits) => splits.map((value) => `${value} s`) },
        { ...axis, size: 40, values: (_, splits) => splits.map((value) => String(value).replace("-", "−")) },
      ],
      series: [{}, ...series],
      legend: { show: false },
      focus: { alpha: 0.2 },
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
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
      const x = event.clientX - over.getBoundingClientRect().left;
      const { duration } = this.#drawn!.curve;
      this.go(Math.max(0, Math.min(duration, this.#plot!.posToVal(x, "x"))));
    };
    over.addEventListener("pointerdown", (event) => {
      over.setPointerCapture(event.pointerId);
      go(event);
    });
    over.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) go(event);
    });
  }

  #list(joints: readonly Joint[]): void {
    const prefix = commonPrefix(joints.map(({ name }) => name));
    this.#values = joints.map(() => element("span", { class: "profile-value" }));
    const entries = joints.map((joint, i) => {
      const point = (name: string | null) => () => this.store.set({ joint: name });
      const flip = button("", () => this.#flip(joint.name, i), {
        class: "profile-joint",
        title: `${joint.name}: show or hide`,
        "aria-pressed": String(!this.#hidden.has(joint.name)),
        onpointerenter: point(joint.name),
        onpointerleave: point(null),
        onfocus: point(joint.name),
        onblur: point(null),
      });
      flip.append(
        element("span", { class: `swatch ${hue(i)}` }),
        element("span", { class: "profile-name" }, joint.name.slice(prefix)),
        this.#values[i]!,
      );
      return flip;
    });
    this.#legend.replaceChildren(...entries);
  }

  #flip(joint: string, index: number): void {
    const isShown = this.#hidden.delete(joint);
    if (!isShown) this.#hidden.add(joint);
    this.point(null);
    this.#legend.children[index]!.setAttribute("aria-pressed", String(isShown));
    for (const line of [1, 2, 3]) this.#plot?.setSeries(3 * index + line, { show: isShown });
  }

  #resize(): void {
    const width = this.#canvas.clientWidth;
    if (!this.#plot || !width || width === this.#plot.width) return;
    this.#plot.setSize({ width, height: HEIGHT });
    this.at(this.#time);
  }
}

function hue(index: number): Hue {
  return `joint-${(index % HUES) + 1}`;
}

/** How many characters at the front, up to an underscore, all names share and can do without: `panda_`. */
function commonPrefix(names: readonly string[]): number {
  const [first = ""] = names;
  const isShared = (end: number) =>
    names.every((name) => name.startsWith(first.slice(0, end)) && /^[a-z]/i.test(name.slice(end)));
  const ends = [...first].flatMap((letter, i) => (letter === "_" && isShared(i + 1) ? [i + 1] : []));
  return names.length > 1 ? (ends.at(-1) ?? 0) : 0;
}

/** The limits of the joints in a piece: those of the segment that it is in. */
function limitIn(
  { segments, limits }: TrajectoryAnswer,
  curve: Curve,
  piece: number,
  key: keyof JointLimits,
): number[] {
  const middle = (curve.breaks[piece]! + curve.breaks[piece + 1]!) / 2;
  const segment = segments.find(({ start_time, end_time }) => start_time <= middle && middle <= end_time);
  return (segment?.limits ?? limits)[key];
}

/** All of the lines, and of the limits those that are not further away from them than they are wide. */
function extent(plot: uPlot): [number, number] {
  const drawn = plot.series.map(({ show }, i) => (show && i > 0 ? (plot.data[i] as (number | null)[]) : []));
  let [low, high] = range(drawn.filter((_, i) => i % 3 === 1));
  if (low > high) [low, high] = [0, 0];
  const span = high - low || Math.abs(high) || 1;
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
