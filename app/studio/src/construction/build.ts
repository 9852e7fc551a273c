/** One of the two tables under construction: its picture, the step, the transform so far, and the table. */

import { Matrix4, Vector3 } from "three";

import { NumberMatrix } from "../panels/worked/matrix.ts";
import { type Parameter, places } from "../robot/dh.ts";
import { rows } from "../robot/pose.ts";
import type { Positions } from "../state.ts";
import { t } from "../texts/index.ts";
import type { DhTable } from "../types.ts";
import { element } from "../ui/dom.ts";
import { formula } from "../ui/mathematics.ts";
import { inUnit, measured, subscript, type Units } from "../ui/quantity.ts";
import { jointHue } from "../view/colours.ts";
import { axes, Drawing, type Room, type Sight, type Stroke } from "./drawing.ts";
import { type Course, courseOf, frameAt, motion, ORDER, type Screw } from "./screws.ts";

const SIGNS: Record<Parameter, string> = { theta: "θ", d: "d", a: "a", alpha: "α" };
const LATEX: Record<Parameter, (i: number) => string> = {
  theta: (i) => `R_z(\\theta_{${i}})`,
  d: (i) => `T_z(d_{${i}})`,
  a: (i) => `T_x(a_{${i}})`,
  alpha: (i) => `R_x(\\alpha_{${i}})`,
};
const ARC_PARTS = 24;
const ANGLES: readonly Parameter[] = ["theta", "alpha"];

export class Build {
  readonly host = element("section", { class: "construction-build" });
  readonly course: Course;
  #drawing: Drawing;
  #step = element("p", { class: "construction-step" });
  #product = element("div", { class: "product" });
  #matrix = new NumberMatrix(t("The transform so far"));
  #cells: HTMLElement[] = [];
  #hues: string[];
  #written = -1;

  constructor(
    private readonly table: DhTable,
    positions: Positions,
    private readonly units: Units,
    turned: (dx: number, dy: number) => void,
  ) {
    this.course = courseOf(table, positions);
    this.#hues = places(table.joints).map(jointHue);
    this.#drawing = new Drawing(turned);
    this.host.dataset["convention"] = table.convention;
    this.host.append(
      element("h3", {}, table.convention === "standard" ? t("Standard") : t("Modified")),
      this.#drawing.host,
      this.#step,
      this.#product,
      this.#matrix.host,
      this.#rows(),
    );
  }

  /** All points that are ever drawn, but for the frames' axes. */
  get points(): Vector3[] {
    const { screws, frames, tool } = this.course;
    return [...screws.map(({ before }) => before), ...frames, tool].map((T) => new Vector3().setFromMatrixPosition(T));
  }

  /** @param step whole where a motion is done, between two of these while it is under way. */
  show(step: number, sight: Sight, room: Room): void {
    const T = frameAt(this.course, step);
    const sentence = this.sentence(Math.ceil(step));
    const name = `${this.table.convention === "standard" ? t("Standard") : t("Modified")}: ${sentence}`;
    this.#drawing.show(this.#strokes(step, T, room.radius * 0.32), sight, room, name);
    this.host.dataset["transform"] = JSON.stringify(rows(T));
    this.#matrix.set(rows(T).map((row) => row.map((value, j) => (j === 3 ? this.#length(value) : value))));
    if (this.#written === Math.ceil(step)) return;
    this.#written = Math.ceil(step);
    this.#step.textContent = sentence;
    this.#product.replaceChildren(formula(this.#latex(this.#written)));
    for (const [k, cell] of this.#cells.entries())
      cell.className = k === this.#written - 1 ? "now" : k < this.#written ? "done" : "open";
  }

  /** What a step does. */
  sentence(step: number): string {
    const screw = this.course.screws[step - 1];
    if (!screw) return t("Frame 0 stands where the table begins.");
    const { row, part, value } = screw;
    const axis = `${part === "theta" || part === "d" ? "z" : "x"}${subscript(this.#axisOf(screw))}`;
    const what = `${SIGNS[part]}${subscript(row + 1)} = ${this.#value(part, value)}`;
    const does = ANGLES.includes(part)
      ? t("turn about {axis} by {what}", { axis, what })
      : t("move along {axis} by {what}", { axis, what });
    const end = step % 4 === 0 ? t(" This is frame {row}.", { row: row + 1 }) : "";
    return t("Row {row}: {does}.{end}", { row: row + 1, does, end });
  }

  /** The index of the axis that a motion is about or along: of the frame before, or of the one that comes of it. */
  #axisOf({ row, part }: Screw): number {
    const isFirst = ORDER[this.table.convention].indexOf(part) < 2;
    return isFirst ? row : row + 1;
  }

  #value(part: Parameter, value: number): string {
    const kind = ANGLES.includes(part) ? "angle" : "length";
    return measured(value, kind, this.units, 3);
  }

  /** A number of a transform's last column. */
  #length(value: number): number {
    return inUnit(value, "length", this.units);
  }

  /** The product so far: whole rows by their name. */
  #latex(step: number): string {
    const whole = Math.floor(step / 4);
    const factors = Array.from({ length: whole }, (_, i) => `A_{${i + 1}}`);
    for (const { row, part } of this.course.screws.slice(4 * whole, step)) factors.push(LATEX[part](row + 1));
    return `T = ${factors.join("\\,") || "I"}`;
  }

  #strokes(step: number, T: Matrix4, length: number): Stroke[] {
    const { screws, frames, tool } = this.course;
    const done = Math.floor(step);
    const row = Math.min(Math.floor(Math.max(0, Math.ceil(step) - 1) / 4), this.table.joints.length - 1);
    const last = [frames.at(-1)!, tool].map((end) => new Vector3().setFromMatrixPosition(end));
    const arm = [...screws.flatMap((screw) => this.#rod(screw)), { points: last, kind: `rod ${this.#hues.at(-1)}` }];
    const built = frames.slice(0, row + 1).flatMap((frame, i) => this.#frame(frame, String(i), length * 0.7, "built"));
    const current = screws.slice(4 * row, Math.ceil(step)).flatMap((screw, k) => {
      const share = 4 * row + k < done ? 1 : step - done;
      return this.#motion(screw, share, length);
    });
    const own = step > 0 && Number.isInteger(step / 4) ? String(step / 4) : "";
    return [...arm, ...built, ...current, ...this.#frame(T, own, length, "moving")];
  }

  #frame(T: Matrix4, i: string, length: number, kind: string): Stroke[] {
    const { x, z } = axes(T, length);
    const name = (axis: string) => axis + (i && subscript(Number(i)));
    return [
      { points: x, kind: `x ${kind}`, isArrow: true, label: name("x") },
      { points: z, kind: `z ${kind}`, isArrow: true, label: name("z") },
    ];
  }

  /** The arm as it is in the end: what a length has made, in the colour of the joint that moves it. */
  #rod({ row, part, before, value }: Screw): Stroke[] {
    if (ANGLES.includes(part)) return [];
    const end = before.clone().multiply(motion(part, value));
    const owner = this.table.convention === "modified" && part === "a" ? row - 1 : row;
    const kind = `rod ${this.#hues[owner] ?? ""}`;
    return [{ points: [before, end].map((T) => new Vector3().setFromMatrixPosition(T)), kind }];
  }

  /** A motion of the row that is being built, as far as it has come. */
  #motion({ row, part, before, value }: Screw, share: number, length: number): Stroke[] {
    if (value * share === 0) return [];
    const parts = ANGLES.includes(part) ? ARC_PARTS : 1;
    const arm =
      part === "theta" ? new Vector3(length * 0.8, 0, 0) : new Vector3(0, 0, part === "alpha" ? length * 0.6 : 0);
    const points = Array.from({ length: parts + 1 }, (_, i) =>
      arm.clone().applyMatrix4(before.clone().multiply(motion(part, (value * share * i) / parts))),
    );
    const hue = part === "theta" ? this.#hues[row]! : "";
    const label = `${SIGNS[part]}${subscript(row + 1)}`;
    return [{ points, kind: `motion ${part} ${hue}`, isArrow: ANGLES.includes(part), label }];
  }

  #rows(): HTMLElement {
    const order = ORDER[this.table.convention];
    const title = (text: string) => element("th", { scope: "col" }, text);
    const head = element("tr", {}, title("i"), ...order.map((part) => title(`${SIGNS[part]}ᵢ`)));
    const lines = this.table.joints.map((_, row) => {
      const screws = this.course.screws.slice(4 * row, 4 * row + 4);
      const cells = screws.map(({ part, value }) => element("td", {}, this.#value(part, value)));
      this.#cells.push(...cells);
      return element(
        "tr",
        {},
        element("th", { scope: "row", class: `tinted ${this.#hues[row]}` }, String(row + 1)),
        ...cells,
      );
    });
    return element(
      "table",
      { class: "construction-table" },
      element("thead", {}, head),
      element("tbody", {}, ...lines),
    );
  }
}
