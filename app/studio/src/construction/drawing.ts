/** Lines, arrows and labels in space as a drawing of the page: parallel projection, needs no graphics card. */

import { type Matrix4, Vector3 } from "three";

import { placed } from "../view/placing.ts";

const NS = "http://www.w3.org/2000/svg";
/** Of the drawing, in its own units. */
const WIDTH = 400;
const HEIGHT = 270;
const MARGIN = 26;
/** About that wide is a letter, and so high a line. */
const LETTER = 7;
const LINE = 14;
const HEAD = 8;

/** What is drawn: points of the world, and a class that colours it. */
export interface Stroke {
  points: readonly Vector3[];
  kind: string;
  /** Whether it ends in an arrow's head. */
  isArrow?: boolean;
  label?: string;
}

/** From where it is looked at: around the vertical, and above the horizontal, [rad]. */
export interface Sight {
  yaw: number;
  pitch: number;
}

/** What a drawing has to have room for: a sphere. */
export interface Room {
  centre: Vector3;
  radius: number;
}

type Flat = readonly [number, number];

export class Drawing {
  readonly host: SVGSVGElement;

  constructor(turned: (dx: number, dy: number) => void) {
    this.host = made("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", class: "construction-drawing" });
    this.host.addEventListener("pointerdown", ({ pointerId }) => this.host.setPointerCapture(pointerId));
    this.host.addEventListener("pointermove", ({ buttons, movementX, movementY }) => {
      if (buttons & 1) turned(movementX, movementY);
    });
  }

  show(strokes: readonly Stroke[], sight: Sight, room: Room, name: string): void {
    const flat = (point: Vector3) => project(point, sight, room);
    const lines = strokes.flatMap((stroke) => drawn(stroke, stroke.points.map(flat)));
    this.host.setAttribute("aria-label", name);
    this.host.replaceChildren(...lines, ...labels(strokes, flat));
  }
}

/** What is to the right, what is up, and of the depth nothing. */
function project(point: Vector3, { yaw, pitch }: Sight, { centre, radius }: Room): Flat {
  const { x, y, z } = point.clone().sub(centre);
  const right = x * Math.cos(yaw) + y * Math.sin(yaw);
  const away = -x * Math.sin(yaw) + y * Math.cos(yaw);
  const up = z * Math.cos(pitch) + away * Math.sin(pitch);
  const scale = (Math.min(WIDTH, HEIGHT) / 2 - MARGIN) / radius;
  return [WIDTH / 2 + right * scale, HEIGHT / 2 - up * scale];
}

function drawn({ kind, isArrow }: Stroke, points: readonly Flat[]): SVGElement[] {
  const line = made("polyline", { points: points.map((point) => point.join()).join(" "), class: kind });
  const [end, before] = [points.at(-1)!, points.at(-2)!];
  const [dx, dy] = [end[0] - before[0], end[1] - before[1]];
  const length = Math.hypot(dx, dy);
  if (!isArrow || length < 1e-6) return [line];
  const size = Math.min(HEAD, Math.hypot(end[0] - points[0]![0], end[1] - points[0]![1]));
  const [ux, uy] = [(dx / length) * size, (dy / length) * size];
  const corner = (side: number) => [end[0] - ux - side * uy * 0.4, end[1] - uy + side * ux * 0.4].join();
  return [line, made("polygon", { points: `${end.join()} ${corner(1)} ${corner(-1)}`, class: `${kind} head` })];
}

/** Beside the ends of what they name, none over another. */
function labels(strokes: readonly Stroke[], flat: (point: Vector3) => Flat): SVGElement[] {
  const named = strokes.flatMap(({ label, points, kind, isArrow }) => {
    if (!label) return [];
    const [x, y] = flat(isArrow && points.length === 2 ? points[1]! : points[Math.floor((points.length - 1) / 2)]!);
    const width = label.length * LETTER;
    return [{ label, kind, box: { x: x + 4, y: y - LINE - 2, width, height: LINE } }];
  });
  const shifts = placed(named.map(({ box }) => box));
  return named.flatMap(({ label, kind, box }, i) => {
    const shift = shifts[i];
    if (!shift) return [];
    const [x, y] = [box.x + shift[0], box.y + shift[1] + LINE - 3];
    const text = made("text", { x: Math.min(x, WIDTH - box.width), y, class: kind });
    text.textContent = label;
    return [text];
  });
}

/** Ends of the axes x and z of a frame. */
export function axes(T: Matrix4, length: number): { x: Vector3[]; z: Vector3[] } {
  const origin = new Vector3().setFromMatrixPosition(T);
  const along = (column: number) => [
    origin,
    origin.clone().addScaledVector(new Vector3().setFromMatrixColumn(T, column), length),
  ];
  return { x: along(0), z: along(2) };
}

function made<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[K] {
  const node = document.createElementNS(NS, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  return node;
}
