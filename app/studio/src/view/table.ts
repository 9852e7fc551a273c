/** The frames of a DH table in the picture, `x_i` and `z_i`, with a, d, α and θ between them. */

import { Group, type Matrix4, type Object3D, Vector3 } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import { frames, jointName, PARAMETERS, type Parameter, places, type Values } from "../robot/dh.ts";
import type { ChainTable } from "../robot/table.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { measured, subscript, type Units, UNITS } from "../ui/quantity.ts";
import { colour, type Hue, jointHue } from "./colours.ts";
import { Angle, Length, type Level } from "./dimensions.ts";
import { clear, label, put, triad } from "./shapes.ts";
import type { View } from "./view.ts";

export const SIGNS: Record<Parameter, string> = { theta: "θ", d: "d", a: "a", alpha: "α" };
/** Radii of the arcs, in the picture's unit: so that the two at a frame are apart. */
const WIDE = 0.95;
const NARROW = 0.7;

/** A parameter in the picture. */
export interface Piece {
  row: number;
  part: Parameter;
  hue: Hue;
  drawn: Length | Angle;
}

/** Keeps the frames as the state wants them, from now on. */
export class TableLayer {
  readonly group = new Group();
  #pieces: Piece[] = [];
  #places: Group[] = [];
  #tips: AxisName[] = [];

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
  ) {
    view.scene.add(this.group);
    view.before.add(() => this.#face());
    store.watch(["model", "unit", "dark", "dh", "table", "base", "tip"], () => this.#build());
    store.watch(["positions", ...UNITS, "dimensions", "lit", "joint"], () => this.#follow());
  }

  /** What can be pointed at: what is drawn. */
  get pieces(): readonly Piece[] {
    return this.#pieces.filter(({ drawn }) => drawn.group.visible);
  }

  /** The axis that a parameter turns about or slides along, in the world. */
  axis({ row, part }: Pick<Piece, "row" | "part">): { origin: Vector3; direction: Vector3 } | null {
    const table = this.#table;
    if (!table) return null;
    const { theta, alpha } = frames(table.dh, this.store.value.positions).rows[row]!;
    const T = this.#T_world_base(table).multiply(part === "theta" || part === "d" ? theta : alpha);
    const direction = new Vector3().setFromMatrixColumn(T, part === "theta" || part === "d" ? 2 : 0);
    return { origin: new Vector3().setFromMatrixPosition(T), direction };
  }

  #T_world_base({ base }: ChainTable): Matrix4 {
    return this.store.value.model!.link(base).matrixWorld.clone();
  }

  get #table(): ChainTable | null {
    const { dh, table, model } = this.store.value;
    return dh && model && table && model.has(table.base) ? table : null;
  }

  #build(): void {
    for (const { drawn } of this.#pieces) if (drawn instanceof Angle) drawn.dispose();
    clear(this.group);
    this.#pieces = this.#places = this.#tips = [];
    const table = this.#table;
    if (table) {
      const { unit } = this.store.value;
      this.#places = Array.from({ length: table.dh.joints.length + 1 }, () => triad(unit, ["x", "z"]));
      for (const [i, place] of this.#places.entries()) place.name = `DH frame ${i}`;
      this.#tips = this.#places.flatMap((_, i) => [named("x", i), named("z", i)]);
      this.#pieces = pieces(this.store.value);
      this.group.add(...this.#places, ...this.#tips.map((tip) => tip.object));
      this.group.add(...this.#pieces.flatMap(({ drawn }) => [drawn.group, drawn.label as Object3D]));
    }
    this.#follow();
  }

  #follow(): void {
    const table = this.#table;
    if (!table) return this.view.draw();
    const state = this.store.value;
    const T_world_base = this.#T_world_base(table);
    const found = frames(table.dh, state.positions);
    const inWorld = (T: Matrix4) => T_world_base.clone().multiply(T);
    const Ts = [found.first, ...found.rows.map(({ T }) => T)].map(inWorld);
    for (const [i, place] of this.#places.entries()) put(place, Ts[i]!);
    for (const piece of this.#pieces) {
      const { row, part, drawn } = piece;
      const { values, ...at } = found.rows[row]!;
      const level = levelOf(state, table, piece);
      const text = described(row, part, values, state);
      drawn.show(level, colour(level === "lit" ? "accent" : piece.hue));
      if (drawn instanceof Angle) drawn.place(inWorld(at[part as "theta"]), values[part], text);
      else {
        const [from, to] = at[part as "a"].map((point) => point.clone().applyMatrix4(T_world_base));
        drawn.place(from!, to!, nameOf(row, part), text);
      }
    }
    const along = state.unit * 1.15;
    for (const { axis, i, object } of this.#tips)
      object.position.set(axis === "x" ? along : 0, 0, axis === "z" ? along : 0).applyMatrix4(Ts[i]!);
    join(this.#tips, state.unit * 0.2);
    this.view.draw();
  }

  /** Lengths stand beside the arm, as the camera sees it now: outwards. */
  #face(): void {
    if (!this.#places.length) return;
    const sight = this.view.camera.getWorldDirection(new Vector3());
    const middle = this.#places.reduce((sum, { position }) => sum.add(position), new Vector3());
    middle.divideScalar(this.#places.length);
    for (const { drawn } of this.#pieces) if (drawn instanceof Length) drawn.face(sight, middle);
  }
}

/** Four pieces a row; θ and the axis of a joint in its colour. */
function pieces(state: Readonly<State>): Piece[] {
  const { table, unit } = state;
  return places(table!.dh.joints).flatMap((place, row) => {
    const own = jointHue(place);
    const hues: Record<Parameter, Hue> = {
      theta: own,
      d: "dimension-d",
      a: "dimension-a",
      alpha: "dimension-alpha",
    };
    return PARAMETERS.map((part): Piece => {
      const [hue, kind] = [hues[part], `dimension ${part} ${part === "theta" ? own : ""}`];
      const tone = colour(hue);
      const drawn =
        part === "a" || part === "d"
          ? new Length(kind, unit, tone)
          : new Angle(kind, unit, tone, unit * (part === "theta" ? WIDE : NARROW), part === "theta" ? "z" : "x");
      drawn.group.name = `DH ${part} ${row + 1}`;
      return { row, part, hue, drawn };
    });
  });
}

/** How much is shown of a parameter: of the row that is pointed at, in whatever list, all of it. */
function levelOf({ lit, joint, dimensions }: Readonly<State>, { dh }: ChainTable, { row, part }: Piece): Level {
  if (lit?.row === row && lit.part === part) return "lit";
  if (dimensions || lit?.row === row || (joint !== null && jointName(dh.joints[row]!, row) === joint)) return "full";
  return part === "a" || part === "d" ? "plain" : "none";
}

function nameOf(row: number, part: Parameter): string {
  return `${SIGNS[part]}${subscript(row + 1)}`;
}

/** `a₂ = 0.5 m`. */
function described(row: number, part: Parameter, values: Values, units: Units): string {
  const kind = part === "a" || part === "d" ? "length" : "angle";
  return `${nameOf(row, part)} = ${measured(values[part], kind, units, 3)}`;
}

interface AxisName {
  axis: "x" | "z";
  i: number;
  object: CSS2DObject;
}

function named(axis: "x" | "z", i: number): AxisName {
  return { axis, i, object: label("", axis) };
}

/** Axes that point to the same place share a label: `x₂ x₃`. */
function join(tips: readonly AxisName[], near: number): void {
  const heads: AxisName[] = [];
  for (const tip of tips) {
    const text = `${tip.axis}${subscript(tip.i)}`;
    const head = heads.find(
      (other) => other.axis === tip.axis && other.object.position.distanceTo(tip.object.position) < near,
    );
    tip.object.visible = head === undefined;
    if (head) head.object.element.textContent += ` ${text}`;
    else {
      tip.object.element.textContent = text;
      heads.push(tip);
    }
  }
}
