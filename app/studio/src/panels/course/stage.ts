/** Where a picture is drawn: as wide as there is room, with what can be dragged, and scales that rest meanwhile. */

import { element } from "../../ui/dom.ts";
import { shareOf } from "../../ui/pointer.ts";
import { measured, type Units } from "../../ui/quantity.ts";
import type { Inputs, Picture, Point } from "./calculator.ts";
import { svg } from "./svg.ts";

const LEAST = 260;
const MOST = 960;

interface Drag {
  handle: string;
  from: { at: Point; inputs: Inputs };
}

export class Stage {
  readonly host = element("div", { class: "course-picture" });
  #drawing = svg("svg", { role: "img" }) as SVGSVGElement;
  #picture: Picture | null = null;
  #drag: Drag | null = null;
  #kept = new Map<string, unknown>();
  #watch: ResizeObserver;

  /**
   * @param inputs those of the picture.
   * @param changed is given the inputs that dragging leads to.
   * @param resized is told of another width.
   * @param units those of angles.
   */
  constructor(
    private readonly inputs: () => Inputs,
    private readonly changed: (inputs: Inputs) => void,
    resized: () => void,
    private readonly units: () => Units,
  ) {
    this.host.append(this.#drawing);
    this.#drawing.addEventListener("pointerdown", (event) => this.#begin(event));
    this.#drawing.addEventListener("pointermove", (event) => this.#move(event));
    for (const name of ["pointerup", "pointercancel"]) this.#drawing.addEventListener(name, () => this.#end());
    let before = this.width;
    this.#watch = new ResizeObserver(() => {
      if (this.width === before) return;
      before = this.width;
      resized();
    });
    this.#watch.observe(this.host);
  }

  /** [px] */
  get width(): number {
    return Math.round(Math.min(MOST, Math.max(LEAST, this.host.clientWidth)));
  }

  /** An angle as it is written in the picture. */
  angle(value: number): string {
    return measured(value, "angle", this.units());
  }

  /** A scale of the picture; the same one while something is dragged. */
  scale<T>(name: string, made: () => T): T {
    if (!this.#drag || !this.#kept.has(name)) this.#kept.set(name, made());
    return this.#kept.get(name) as T;
  }

  show(picture: Picture | null): void {
    this.#picture = picture;
    this.host.hidden = picture === null;
    if (!picture) return;
    this.#drawing.setAttribute("viewBox", `0 0 ${this.width} ${picture.height}`);
    this.#drawing.setAttribute("width", String(this.width));
    this.#drawing.setAttribute("aria-label", picture.name);
    this.#drawing.replaceChildren(...picture.nodes);
  }

  close(): void {
    this.#watch.disconnect();
  }

  #begin(event: PointerEvent): void {
    const handle = (event.target as Element).closest<SVGElement>("[data-handle]")?.dataset["handle"];
    if (handle === undefined || !this.#picture?.drag) return;
    event.preventDefault();
    this.#drawing.setPointerCapture(event.pointerId);
    this.#drag = { handle, from: { at: this.#at(event), inputs: this.inputs() } };
  }

  #move(event: PointerEvent): void {
    if (!this.#drag || !this.#picture?.drag) return;
    this.changed(this.#picture.drag(this.#drag.handle, this.#at(event), this.#drag.from));
  }

  #end(): void {
    if (!this.#drag) return;
    this.#drag = null;
    this.changed(this.inputs()); // the scales may follow again
  }

  #at({ clientX, clientY }: PointerEvent): Point {
    const { left, top } = this.#drawing.getBoundingClientRect();
    const share = shareOf(this.host);
    return [(clientX - left) * share, (clientY - top) * share];
  }
}

/** A picture of the plane: where its points are in a box of the drawing, the same scale in both directions. */
export class Plane {
  #scale: number;
  #middle: Point;

  constructor(
    points: readonly Point[],
    private readonly box: { x: number; y: number; width: number; height: number },
  ) {
    const [left, right] = extent(points.map(([x]) => x));
    const [low, high] = extent(points.map(([, y]) => y));
    this.#scale = Math.min(box.width / Math.max(right - left, 1e-9), box.height / Math.max(high - low, 1e-9));
    if (!Number.isFinite(this.#scale) || this.#scale > 1e8) this.#scale = 1;
    this.#middle = [(left + right) / 2, (low + high) / 2];
  }

  to([x, y]: Point): Point {
    const { box } = this;
    return [
      box.x + box.width / 2 + (x - this.#middle[0]) * this.#scale,
      box.y + box.height / 2 - (y - this.#middle[1]) * this.#scale,
    ];
  }

  /** The point of the plane, rounded to about a pixel. */
  from([x, y]: Point): Point {
    const { box } = this;
    const step = 10 ** Math.floor(Math.log10(1 / this.#scale));
    const round = (value: number) => Number((Math.round(value / step) * step).toPrecision(12));
    return [
      round((x - box.x - box.width / 2) / this.#scale + this.#middle[0]),
      round(this.#middle[1] - (y - box.y - box.height / 2) / this.#scale),
    ];
  }
}

export function extent(values: readonly number[]): Point {
  return [Math.min(...values), Math.max(...values)];
}
