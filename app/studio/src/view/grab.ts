/** What the pointer takes in the picture: links, which turn or slide about their joints, and the table's parameters. */

import { Vector2, Vector3 } from "three";

import { draftTable } from "../robot/table.ts";
import { type Drive, within } from "../robot/model.ts";
import { jointName, variableOf } from "../robot/dh.ts";
import type { Lit, State } from "../state.ts";
import type { Store } from "../store.ts";
import type { DhRow, DhTable } from "../types.ts";
import { distance, follow, type Motion, pointerOf, sightThrough, sliding, turning } from "./aiming.ts";
import type { Piece, TableLayer } from "./table.ts";
import type { View } from "./view.ts";

/** How near to a line the pointer takes it, [px]. */
const NEAR = 8;
const DEGREES = 180 / Math.PI;
/** Steps of angles that are dragged, [°], and of those dragged with Shift. */
const STEP = 5;
const FINE = 1;

/** What is held: how it moves, and what is done with the number. */
interface Held {
  motion: Motion;
  t: number;
  take: (t: number, isFine: boolean) => void;
}

export class Grabbing {
  /** What is held, and by which pointer: other fingers neither move it nor let it go. */
  #held: (Held & { pointer: number }) | null = null;
  #pointed: { lit: Lit | null; joint: string | null } = { lit: null, joint: null };
  /** The table that waits for the one before to be on the screen; with what was chosen then. */
  #next: ({ dh: DhTable } & Pick<State, "robot" | "draft">) | null = null;

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
    private readonly layer: TableLayer,
  ) {
    const host = view.canvas.parentElement!;
    const { canvas } = view;
    // Before the camera's own controls hear of it.
    host.addEventListener("pointerdown", (event) => this.#begin(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const)
      canvas.addEventListener(end, (event) => this.#end(event));
    canvas.addEventListener("pointerleave", () => this.#held || this.#point(null, null));
    store.watch(["loading"], ({ loading, robot, draft }) => {
      const next = this.#next;
      if (loading || !next) return;
      this.#next = null;
      // Whoever has chosen something else meanwhile keeps that.
      if (next.robot === robot && next.draft === draft) this.#draw(next.dh);
    });
  }

  /** Whether the pointer is somebody else's: on a handle, or choosing points. */
  #isTaken(event: PointerEvent): boolean {
    const { view } = this;
    const handles = [...view.handles];
    return view.isPicking || handles.some(({ axis, enabled }) => enabled && (axis || event.pointerType === "touch"));
  }

  #begin(event: PointerEvent): void {
    if (event.target !== this.view.canvas) return;
    // Another finger: the camera is not to turn under the one that holds.
    if (this.#held && this.#held.pointer !== event.pointerId) return event.stopPropagation();
    if (event.button !== 0 || !event.isPrimary || this.#isTaken(event)) return;
    const pointer = pointerOf(this.view, event);
    const piece = this.#pieceAt(pointer);
    const link = piece ? null : this.#link(pointer);
    const held = link ?? (piece && this.#parameter(piece, pointer));
    this.#held = held && { ...held, pointer: event.pointerId };
    if (!this.#held) return;
    event.stopPropagation();
    this.view.isDragged = true;
    this.#point(piece, link && link.leader);
    this.view.canvas.setPointerCapture(event.pointerId);
  }

  #move(event: PointerEvent): void {
    const held = this.#held;
    if (held && held.pointer !== event.pointerId) return;
    const pointer = pointerOf(this.view, event);
    if (held) {
      held.t = follow(this.view, pointer, held.motion, held.t);
      held.take(held.t, event.shiftKey);
    } else if (event.buttons === 0 && !this.#isTaken(event)) {
      const piece = this.#pieceAt(pointer);
      this.#point(piece, piece ? null : (this.#driveAt(pointer)?.drive.leader ?? null));
    }
  }

  #end({ pointerType, pointerId }: PointerEvent): void {
    if (this.#held && this.#held.pointer !== pointerId) return;
    if (this.#held) this.view.isDragged = false;
    this.#held = null;
    if (pointerType !== "mouse") this.#point(null, null); // a finger that is lifted points at nothing
  }

  /** Say what is under the pointer; what something else has pointed at meanwhile stays. */
  #point(piece: Piece | null, joint: string | null): void {
    const state = this.store.value;
    const [lit, last] = [piece && { row: piece.row, part: piece.part }, this.#pointed];
    this.view.canvas.classList.toggle("over", piece !== null || joint !== null);
    if (!isSame(lit, last.lit) && (lit || isSame(state.lit, last.lit))) this.store.set({ lit });
    if (joint !== last.joint && (joint !== null || state.joint === last.joint)) this.store.set({ joint });
    this.#pointed = { lit, joint };
  }

  #pieceAt(pointer: Vector2): Piece | null {
    const found = this.layer.pieces.map((piece) => [distance(this.view, pointer, piece.drawn.path), piece] as const);
    const [nearest] = found.filter(([px]) => px < NEAR).sort(([a], [b]) => a - b);
    return nearest?.[1] ?? null;
  }

  /** The joint that moves the link under the pointer, and where the link has been taken. */
  #driveAt(pointer: Vector2): { drive: Drive; point: Vector3 } | null {
    const { model } = this.store.value;
    const [hit] = model ? sightThrough(this.view, pointer).intersectObject(model.root) : [];
    const drive = hit && model!.drive(hit.object);
    return drive && drive.multiplier !== 0 ? { drive, point: hit.point } : null;
  }

  #link(pointer: Vector2): (Held & { leader: string }) | null {
    const found = this.#driveAt(pointer);
    if (!found) return null;
    const { joint, leader, multiplier } = found.drive;
    const centre = new Vector3().setFromMatrixPosition(joint.matrixWorld);
    const axis = joint.axis.clone().transformDirection(joint.matrixWorld);
    const slides = joint.jointType === "prismatic";
    const motion = slides ? sliding(found.point, axis) : turning(found.point, centre, axis);
    return { motion, t: 0, take: this.#turning(leader, multiplier), leader };
  }

  /** What moves a joint from where it is now, within its limits. */
  #turning(leader: string, multiplier: number): Held["take"] {
    const { positions, model } = this.store.value;
    const start = positions[leader] ?? 0;
    const own = model!.joints.find(({ name }) => name === leader)!;
    return (t) => {
      const value = within(start + t / multiplier, own);
      this.store.set({ positions: { ...this.store.value.positions, [leader]: value } });
    };
  }

  /** A parameter of a row: the joint's variable moves the joint, another number changes the table, if it can. */
  #parameter({ row, part, drawn }: Piece, pointer: Vector2): Held | null {
    const { table, positions } = this.store.value;
    const line = this.layer.axis({ row, part });
    const dh = this.#own();
    const joint = table!.dh.joints[row]!;
    if (!line) return null;
    const isAngle = part === "theta" || part === "alpha";
    const point = nearestOf(drawn.path, (at) => distance(this.view, pointer, [at, at]));
    const motion = isAngle ? turning(point, line.origin, line.direction) : sliding(point, line.direction);
    if (part === variableOf(joint)) {
      const name = joint.mimic?.joint ?? jointName(joint, row);
      if (!(name in positions)) return null;
      return { motion, t: 0, take: this.#turning(name, joint.mimic?.multiplier ?? 1) };
    }
    if (!dh) return null;
    const start = joint[part];
    const take = (t: number, isFine: boolean) => {
      const value = isAngle ? stepped(start + t, isFine) : rounded(start + t, this.store.value.unit, isFine);
      this.#draw(replaced(dh, row, { [part]: value }));
    };
    return { motion, t: 0, take };
  }

  /** The table that the robot on the screen is; null where it has only been found for it. */
  #own(): DhTable | null {
    const { draft, model, table } = this.store.value;
    if (draft) return draft;
    return model?.info?.dh && table?.dh === model.info.dh ? table.dh : null;
  }

  #draw(dh: DhTable): void {
    const { draft, robot, loading } = this.store.value;
    if (loading) this.#next = { dh, robot, draft };
    else if (JSON.stringify(dh) !== JSON.stringify(draft ?? this.#own()))
      this.store.set({ draft: dh, robot: "", base: null, tip: null, table: draftTable(dh) });
  }
}

function isSame(one: Lit | null, other: Lit | null): boolean {
  return one?.row === other?.row && one?.part === other?.part;
}

function nearestOf(path: readonly Vector3[], px: (point: Vector3) => number): Vector3 {
  const fine = path.slice(1).flatMap((end, i) => [0, 0.25, 0.5, 0.75, 1].map((s) => path[i]!.clone().lerp(end, s)));
  return fine.reduce((best, point) => (px(point) < px(best) ? point : best), path[0]!);
}

function replaced(table: DhTable, row: number, numbers: Partial<DhRow>): DhTable {
  return { ...table, joints: table.joints.map((joint, i) => (i === row ? { ...joint, ...numbers } : joint)) };
}

/** A number of whole steps of degrees. */
function stepped(angle: number, isFine: boolean): number {
  const step = isFine ? FINE : STEP;
  return (Math.round((angle * DEGREES) / step) * step * Math.PI) / 180;
}

/** A length of whole steps: a tenth of the decade that the picture's unit is nearest to, or a tenth of that. */
function rounded(length: number, unit: number, isFine: boolean): number {
  const places = Math.max(0, Math.min(15, 1 - Math.round(Math.log10(unit)) + (isFine ? 1 : 0)));
  return Number(length.toFixed(places));
}
