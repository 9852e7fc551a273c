/** How near the arm comes to what is around it, over time: the clearance of even samples of a motion. */

import uPlot from "uplot";

import { type Api, asProblem, Latest } from "../../api.ts";
import type { ShownChain } from "../../robot/chain.ts";
import { surroundings } from "../../scene/objects.ts";
import { t } from "../../texts/index.ts";
import type { CollisionAnswer } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { leftIn } from "../../ui/pointer.ts";
import { ProblemView } from "../../ui/problem.ts";
import { column, inUnit, type Units, unitOf } from "../../ui/quantity.ts";
import { paint } from "../../view/colours.ts";
import type { Plan } from "./answer.ts";
import type { Curve } from "./curve.ts";

const SAMPLES = 240;
const HEIGHT = 120;

export class ClearancePlot {
  readonly host: HTMLElement;
  #latest = new Latest();
  #problem = new ProblemView();
  #canvas = element("div", { class: "profiles clearance", role: "img", "aria-label": t("Clearance over time") });
  #now = element("div", { class: "profile-now" });
  #words = element("p", { class: "muted small" });
  #plot: uPlot | null = null;
  /** Times [s] and clearances [m]. */
  #data: [number[], (number | null)[]] = [[], []];
  #time = 0;

  /** Is told of the time that is clicked, [s]. */
  go: (time: number) => void = () => {};

  constructor(
    private readonly api: Api,
    private readonly units: () => Units,
  ) {
    this.host = element("div", { class: "part", hidden: true }, this.#words, this.#canvas, this.#problem.host);
    this.#canvas.addEventListener("click", (event) => this.#follow(event));
    new ResizeObserver(() => this.#plot?.setSize({ width: this.#width, height: HEIGHT })).observe(this.#canvas);
  }

  /** Ask for a motion in its scene, or show none. */
  async show(chain: ShownChain, plan: Plan | null, curve: Curve | null): Promise<void> {
    this.#latest.cancel();
    this.#problem.show(null);
    this.#clear();
    this.host.hidden = !plan?.scene.objects.length || !curve?.duration;
    if (!plan || !curve || this.host.hidden) return;
    const times = Array.from({ length: SAMPLES + 1 }, (_, i) => (i * curve.duration) / SAMPLES);
    const around = { ...chain.ends, ...surroundings(plan.scene, plan.others) };
    const body = { ...around, joint_positions: times.map((time) => curve.at(time)), clearance: true, pairs: "none" };
    try {
      const answer = await this.#latest.run((signal) =>
        this.api.post<CollisionAnswer>(`${chain.path}/collisions`, body, signal),
      );
      if (!answer) return;
      const values = answer.results.map(({ clearance }) => clearance ?? null);
      this.#data = [times, values];
      this.draw();
    } catch (error) {
      this.#problem.show(asProblem(error));
    }
  }

  /** Anew, in the units and colours of the page; below zero the arm is in contact. */
  draw(): void {
    this.#plot?.destroy();
    this.#plot = null;
    if (!this.#data[0].length || this.host.hidden) return;
    const [tone, font] = [paint("muted"), `12px ${getComputedStyle(this.host).fontFamily}`];
    const axis = { stroke: tone, font, grid: { stroke: paint("line"), width: 1 }, ticks: { show: false }, gap: 4 };
    const written = (unit: string) => (_: uPlot, splits: number[]) =>
      splits.map((value) => `${String(value).replace("-", "−")}${unit}`);
    const line = { width: 1.5, pxAlign: 0, points: { show: false } };
    const options: uPlot.Options = {
      width: this.#width,
      height: HEIGHT,
      padding: [8, 14, 0, 0],
      scales: { x: { time: false, range: (_, from, to) => [from, to] } },
      axes: [
        { ...axis, size: 24, values: written(" s") },
        { ...axis, size: 40, values: written("") },
      ],
      series: [{}, { ...line, stroke: paint("accent") }, { ...line, stroke: paint("bad"), dash: [5, 4], width: 1 }],
      legend: { show: false },
      cursor: { show: false },
    };
    const [times, clearances] = this.#data;
    const shown = clearances.map((value) => value && inUnit(value, "length", this.units()));
    const data = [times, shown, times.map(() => 0)] as uPlot.AlignedData;
    this.#plot = new uPlot(options, data, this.#canvas);
    this.#plot.over.append(this.#now);
    this.at(this.#time);
  }

  /** Show a time, and the clearance then. */
  at(time: number): void {
    this.#time = time;
    if (!this.#plot) return;
    this.#now.style.transform = `translateX(${this.#plot.valToPos(time, "x")}px)`;
    const [times, values] = this.#data;
    const value = values[Math.round((time / times.at(-1)!) * SAMPLES)];
    this.#words.textContent = this.#told(value);
  }

  stop(): void {
    this.#latest.cancel();
    this.#plot?.destroy();
  }

  #clear(): void {
    this.#data = [[], []];
    this.#plot?.destroy();
    this.#plot = null;
    this.#words.textContent = this.#told();
  }

  #told(value: number | null = null): string {
    const title = t("Clearance [{unitOf}]", { unitOf: unitOf("length", this.units()) });
    return value === null
      ? title
      : t("{title}: {value} at this time", { title, value: column(value, "length", this.units(), 4) });
  }

  #follow(event: MouseEvent): void {
    if (!this.#plot) return;
    const x = leftIn(this.#plot.over, event);
    this.go(Math.max(0, Math.min(this.#data[0].at(-1)!, this.#plot.posToVal(x, "x"))));
  }

  get #width(): number {
    return Math.max(this.#canvas.clientWidth, 200);
  }
}
