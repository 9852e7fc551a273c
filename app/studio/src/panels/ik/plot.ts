/** Errors over iterations, on scales that show both five steps and five thousand. */

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import { leftIn } from "../../ui/pointer.ts";
import { type Hue, paint } from "../../view/colours.ts";

const HEIGHT = 208;
const FLOOR = 1e-17; // below what rounding leaves; a logarithm needs more than nothing
const ASINH = 4;
const LOGARITHMIC = 3;

export interface Curve {
  hue: Hue;
  isDashed: boolean;
  values: readonly number[];
}

export class ErrorPlot {
  readonly host = element("div", { class: "errors-plot", role: "img", "aria-label": t("Errors over iterations") });
  #plot: uPlot | null = null;
  #at = 0;
  #now = element("span", { class: "errors-now" });

  /** @param choose is told the iteration that was clicked on. */
  constructor(private readonly choose: (index: number) => void) {}

  show(curves: readonly Curve[]): void {
    this.close();
    const length = Math.max(...curves.map(({ values }) => values.length));
    const xs = Array.from({ length }, (_, i) => i);
    const ys = curves.map(({ values }) => xs.map((i) => (i < values.length ? Math.max(values[i]!, FLOOR) : null)));
    this.#plot = new uPlot(options(curves, this.host.clientWidth), [xs, ...ys], this.host);
    this.#plot.over.append(this.#now);
    this.#plot.over.addEventListener("pointerdown", (event) => this.#scrub(event));
    this.#plot.over.addEventListener("pointermove", (event) => event.buttons === 1 && this.#scrub(event));
  }

  /** Mark an iteration. */
  mark(index: number): void {
    this.#at = index;
    if (this.#plot) this.#now.style.transform = `translateX(${this.#plot.valToPos(index, "x")}px)`;
  }

  get at(): number {
    return this.#at;
  }

  close(): void {
    this.#plot?.destroy();
    this.#plot = null;
  }

  #scrub(event: PointerEvent): void {
    const { over, posToVal } = this.#plot!;
    this.choose(Math.round(posToVal(leftIn(over, event), "x")));
  }
}

function options(curves: readonly Curve[], width: number): uPlot.Options {
  const ink = paint("muted");
  const line = paint("line");
  const axis = {
    stroke: ink,
    font: "12px system-ui, sans-serif",
    grid: { stroke: line, width: 1 },
    ticks: { show: false },
    filter: (_: uPlot, splits: number[]) => splits,
  };
  return {
    width,
    height: HEIGHT,
    legend: { show: false },
    cursor: { show: false },
    scales: {
      x: { time: false, distr: ASINH, asinh: 3, range: (_, least, most) => [least, Math.max(most, 1)] },
      y: {
        distr: LOGARITHMIC,
        range: (_, least, most) => [decade(least, Math.floor), decade(Math.max(most, 2 * least), Math.ceil)],
      },
    },
    axes: [
      { ...axis, size: 28, splits: (_, __, least, most) => roundNumbers(least, most) },
      {
        ...axis,
        size: 48,
        splits: (_, __, least, most) => powersOfTen(least, most),
        values: (_, splits) => splits.map((split) => powerOfTen(split)),
      },
    ],
    series: [
      {},
      ...curves.map(({ hue, isDashed }) => ({
        stroke: paint(hue),
        width: 1.5,
        ...(isDashed && { dash: [5, 4] }),
        points: { show: false },
      })),
    ],
  };
}

/** 0, 1, 2, 5, 10 and so on: they stand apart on the scale of iterations. */
function roundNumbers(least: number, most: number): number[] {
  const found = [0];
  for (let decade = 1; decade <= most; decade *= 10) found.push(decade, 2 * decade, 5 * decade);
  return found.filter((number) => number >= least && number <= most);
}

function decade(value: number, round: (exponent: number) => number): number {
  return 10 ** round(Math.log10(value));
}

function powersOfTen(least: number, most: number): number[] {
  const [from, to] = [Math.ceil(Math.log10(least) - 1e-9), Math.floor(Math.log10(most) + 1e-9)];
  const every = Math.max(1, Math.ceil((to - from) / 6));
  return Array.from({ length: Math.floor((to - from) / every) + 1 }, (_, i) => 10 ** (from + i * every));
}

function powerOfTen(value: number): string {
  const exponent = Math.round(Math.log10(value));
  return `10${[...String(exponent)].map((sign) => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(sign)])).join("")}`;
}
