/** Dimensions of a drawing: a length between two extension lines, and an angle as an arc with its two sides. */

import { CircleGeometry, type Color, DoubleSide, Group, Matrix4, Mesh, TorusGeometry, Vector3 } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import { aim, head, label, overlay, put, rod, stretch } from "./shapes.ts";

/** How much is shown: a line where it is measured, the dimension with its value, or that as what is pointed at. */
export type Level = "none" | "plain" | "full" | "lit";

const FAINT = 0.6;
const SECTOR = 0.13;
/** Parts of an arc to a turn. */
const SMOOTH = 96;

/** What lengths and angles have in common: its colour, its label, and where a pointer may take it. */
abstract class Dimension {
  readonly group = new Group();
  readonly label: CSS2DObject;
  protected level: Level = "none";

  constructor(
    kind: string,
    protected readonly unit: number,
  ) {
    this.label = label("", kind);
  }

  /** What is drawn of it, in the world: from the beginning to the end. */
  get path(): Vector3[] {
    return (this.group.userData["path"] as Vector3[] | undefined) ?? [];
  }

  protected set path(points: Vector3[]) {
    this.group.userData["path"] = points;
  }

  show(level: Level, tone: Color): void {
    this.level = level;
    this.group.visible = level !== "none";
    this.label.element.classList.toggle("lit", level === "lit");
    this.group.traverse((node) => {
      if (node instanceof Mesh) node.material.color = tone;
    });
  }

  protected say(text: string, at: Vector3, isSeen: boolean): void {
    if (this.label.element.textContent !== text) this.label.element.textContent = text;
    this.label.position.copy(at);
    this.label.visible = isSeen;
  }

  protected get thickness(): number {
    return this.unit * (this.level === "lit" ? 0.04 : 0.02);
  }
}

/** A length. */
export class Length extends Dimension {
  #line: Mesh;
  #sides: [Mesh, Mesh];
  #heads: [Mesh, Mesh];
  #ends: [Vector3, Vector3] = [new Vector3(), new Vector3()];
  #texts = { name: "", whole: "" };

  constructor(kind: string, unit: number, tone: Color) {
    super(kind, unit);
    const line = () => rod(new Vector3(), new Vector3(), unit, tone);
    this.#line = line();
    this.#sides = [line(), line()];
    this.#heads = [head(tone), head(tone)];
    this.group.add(this.#line, ...this.#sides, ...this.#heads);
  }

  /** @param name without its value, for where little is shown; `whole` with it. */
  place(from: Vector3, to: Vector3, name: string, whole: string): void {
    this.#ends = [from, to];
    this.#texts = { name, whole };
  }

  /** Beside what is measured as it is seen from there, away from a point. */
  face(sight: Vector3, away: Vector3): void {
    const [from, to] = this.#ends;
    const along = to.clone().sub(from);
    const length = along.length();
    const isPlain = this.level === "plain";
    const isThere = length > 1e-9;
    const aside = isPlain || !isThere ? new Vector3() : this.#aside(along, sight, away);
    const [start, end] = [from.clone().add(aside), to.clone().add(aside)];
    this.path = [start, end];
    stretch(this.#line, start, end, this.thickness);
    along.normalize();
    for (const i of [0, 1] as const) {
      const cone = this.#heads[i];
      stretch(this.#sides[i], this.#ends[i]!, this.#ends[i]!.clone().addScaledVector(aside, 1.15), this.thickness / 2);
      cone.visible = isThere && !isPlain;
      if (cone.visible) aim(cone, this.path[i]!, along.clone().multiplyScalar(i ? 1 : -1), this.#pointed(length));
    }
    const isSeen = this.level === "lit" || (isThere && this.level !== "none");
    this.say(isPlain ? this.#texts.name : this.#texts.whole, start.clone().lerp(end, 0.5), isSeen);
  }

  #pointed(length: number): number {
    return Math.min(this.unit * 0.22, length / 3);
  }

  #aside(along: Vector3, sight: Vector3, away: Vector3): Vector3 {
    const aside = along.clone().cross(sight);
    // Seen from the end of the line, any side is as good.
    if (aside.length() < 1e-3 * along.length()) aside.copy(along).cross(new Vector3(0, 0, 1));
    if (aside.length() < 1e-3 * along.length()) aside.set(1, 0, 0);
    const middle = this.#ends[0].clone().lerp(this.#ends[1], 0.5);
    return aside.setLength(this.unit * 0.75 * (aside.dot(middle.sub(away)) < 0 ? -1 : 1));
  }
}

/** From the frame in which an angle is measured about z from x, to the one about x from z. */
const ABOUT_X = new Matrix4().makeBasis(new Vector3(0, 0, 1), new Vector3(0, -1, 0), new Vector3(1, 0, 0));

/** An angle. */
export class Angle extends Dimension {
  #arc: Mesh<TorusGeometry>;
  #sector: Mesh<CircleGeometry>;
  #sides: [Mesh, Mesh];
  #head: Mesh;
  #drawn: string | null = null;

  /** @param axis that the angle turns about: z from x, or x from z. */
  constructor(
    kind: string,
    unit: number,
    tone: Color,
    private readonly radius: number,
    private readonly axis: "x" | "z",
  ) {
    super(kind, unit);
    const material = (opacity: number) => Object.assign(overlay(tone, opacity), { side: DoubleSide });
    this.#arc = new Mesh(new TorusGeometry(), material(1));
    this.#sector = new Mesh(new CircleGeometry(), material(SECTOR));
    this.#arc.renderOrder = this.#sector.renderOrder = 9;
    this.#sides = [
      rod(new Vector3(), new Vector3(), 1, tone, FAINT),
      rod(new Vector3(), new Vector3(), 1, tone, FAINT),
    ];
    this.#head = head(tone);
    this.group.add(this.#sector, this.#arc, ...this.#sides, this.#head);
  }

  /** @param at frame whose x or z is the axis. */
  place(at: Matrix4, angle: number, text: string): void {
    // Most arcs are not shown while the arm moves; their geometry would be made at each step.
    if (this.level === "none") {
      this.label.visible = false;
      return;
    }
    const T = this.axis === "z" ? at : at.clone().multiply(ABOUT_X);
    put(this.group, T);
    const { radius, thickness } = this;
    const point = (phi: number, size = radius) => new Vector3(Math.cos(phi), Math.sin(phi), 0).multiplyScalar(size);
    const isThere = Math.abs(angle) > 1e-9;
    const sign = Math.sign(angle) || 1;
    // The arrow takes what is left of the arc; a small one has none.
    const pointed = Math.min(this.unit * 0.2, Math.abs(angle) * radius * 0.5);
    this.#bend(angle, sign * Math.max(0, Math.abs(angle) - (0.8 * pointed) / radius));
    this.#head.visible = isThere;
    const tangent = point(angle - sign * ((0.5 * pointed) / radius) + (sign * Math.PI) / 2, 1);
    aim(this.#head, point(angle), tangent, pointed);
    for (const [side, phi] of [
      [this.#sides[0], 0],
      [this.#sides[1], angle],
    ] as const)
      stretch(side, new Vector3(), point(phi, radius * 1.25), thickness / 2);
    const steps = Math.max(2, Math.ceil((Math.abs(angle) / (2 * Math.PI)) * 32));
    this.path = Array.from({ length: steps + 1 }, (_, i) => point((angle * i) / steps).applyMatrix4(T));
    const isSeen = this.level === "lit" || (isThere && this.level === "full");
    this.say(text, point(angle / 2, radius * 1.4).applyMatrix4(T), isSeen);
  }

  /** Geometry of the angle, made again where that has changed. */
  #bend(angle: number, arc: number): void {
    const wanted = `${angle} ${this.thickness}`;
    if (this.#drawn === wanted) return;
    this.#drawn = wanted;
    this.dispose();
    const parts = Math.max(2, Math.ceil((Math.abs(angle) / (2 * Math.PI)) * SMOOTH));
    this.#arc.geometry = new TorusGeometry(this.radius, this.thickness, 8, parts, arc);
    this.#sector.geometry = new CircleGeometry(this.radius, parts, 0, angle);
    this.#arc.visible = this.#sector.visible = Math.abs(angle) > 1e-9;
  }

  dispose(): void {
    this.#arc.geometry.dispose();
    this.#sector.geometry.dispose();
  }
}
