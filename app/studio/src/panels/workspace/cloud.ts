/** The workspace in the picture: a point for each sample or voxel, coloured by its value, and cut open. */

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  type Camera,
  Group,
  LineBasicMaterial,
  LineLoop,
  type Matrix4,
  OrthographicCamera,
  Plane,
  Points,
  PointsMaterial,
  Sphere,
  Vector3,
} from "three";

import type { Table } from "../../npy.ts";
import type { WorkspaceSummary } from "../../types.ts";
import { colour } from "../../view/colours.ts";
import { shade } from "../../view/shades.ts";
import { clear, put } from "../../view/shapes.ts";
import { FIELD, type View } from "../../view/view.ts";

export type Axis = "x" | "y" | "z";

export interface Section {
  axis: Axis;
  /** Where the plane cuts its axis, [m]. */
  at: number;
  /** Thickness of what is left, [m]; null for all that lies behind the plane. */
  thickness: number | null;
}

/** Between which values the colours are spread. */
export interface Range {
  lower: number;
  upper: number;
}

/** The side that stays: the one further from where the view usually looks from. */
const STAYS: Record<Axis, Vector3> = { x: new Vector3(-1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, -1) };
const INDEX: Record<Axis, number> = { x: 0, y: 1, z: 2 };
const PALETTE = Array.from({ length: 256 }, (_, k) => shade(k / 255));
const MANY = 50_000;

export class Cloud {
  #group = new Group();
  #box: Box3 | null = null;
  #ball: Sphere | null = null;
  #base: Matrix4 | null = null;
  #section: Section | null = null;
  #geometry: BufferGeometry | null = null;

  constructor(private readonly view: View) {
    this.#group.name = "workspace";
    view.scene.add(this.#group);
  }

  /** Draw the rows of a table, their value in the last column. */
  show({ rows, columns, values }: Table, summary: WorkspaceSummary, range: Range): void {
    this.clear();
    const positions = new Float32Array(3 * rows);
    const colours = new Float32Array(3 * rows);
    const scale = (PALETTE.length - 1) / (range.upper - range.lower || 1);
    for (let k = 0; k < rows; k += 1) {
      for (let i = 0; i < 3; i += 1) positions[3 * k + i] = values[columns * k + i]!;
      colours.set(PALETTE[Math.round((values[columns * (k + 1) - 1]! - range.lower) * scale)]!, 3 * k);
    }
    this.#geometry = new BufferGeometry();
    this.#geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.#geometry.setAttribute("color", new BufferAttribute(colours, 3));
    const isCloud = summary.kind === "cloud";
    const material = new PointsMaterial({
      vertexColors: true,
      sizeAttenuation: !isCloud,
      size: rows > MANY ? 2 : 3,
    });
    const points = new Points(this.#geometry, material);
    if (!isCloud)
      points.onBeforeRender = (_, __, camera) => (material.size = this.#sizeOf(summary.voxels.size, camera));
    this.#group.add(points);
    const bounds = summary.bounding_box;
    this.#geometry.computeBoundingSphere();
    this.#ball = rows ? this.#geometry.boundingSphere : null;
    this.#box = bounds && new Box3(new Vector3(...bounds.lower), new Vector3(...bounds.upper));
  }

  /** Where the base frame of the chain is in the world, and the section that lets one look inside. */
  place(base: Matrix4, section: Section | null): void {
    const isNew = this.#base === null || !this.#base.equals(base);
    this.#base = base.clone();
    this.#section = section;
    put(this.#group, base);
    this.#cut();
    if (isNew) this.view.surround("workspace", this.#ball?.clone().applyMatrix4(base) ?? null);
    this.view.draw();
  }

  clear(): void {
    clear(this.#group);
    this.#geometry?.dispose();
    this.#geometry = null;
    this.#base = null;
    this.#box = this.#ball = null;
    this.view.surround("workspace", null);
  }

  close(): void {
    this.clear();
    this.view.scene.remove(this.#group);
    this.view.draw();
  }

  /** A voxel's size for three.js: at a distance, for a field of view of 90°, or in parallel projection in pixels. */
  #sizeOf(voxel: number, camera: Camera): number {
    const size = 0.7 * voxel;
    if (!(camera instanceof OrthographicCamera)) return size / Math.tan((FIELD * Math.PI) / 360);
    return (size * this.view.canvas.clientHeight) / (camera.top - camera.bottom);
  }

  #cut(): void {
    const points = this.#group.children.find((child) => child instanceof Points);
    if (!(points?.material instanceof PointsMaterial)) return;
    points.material.clippingPlanes = planes(this.#section).map((plane) => plane.applyMatrix4(this.#base!));
    for (const line of this.#group.children.filter((child) => child instanceof LineLoop)) {
      line.geometry.dispose();
      (line.material as LineBasicMaterial).dispose();
      this.#group.remove(line);
    }
    if (this.#section && this.#box) this.#group.add(border(this.#section, this.#box));
  }
}

/** Half spaces that points stay in, in the base frame. */
function planes(section: Section | null): Plane[] {
  if (!section) return [];
  const normal = STAYS[section.axis];
  const at = normal.getComponent(INDEX[section.axis]) * section.at;
  const half = (section.thickness ?? 0) / 2;
  const front = new Plane(normal.clone(), half - at);
  return section.thickness === null ? [front] : [front, new Plane(normal.clone().negate(), half + at)];
}

/** Where the plane goes through the box of the workspace. */
function border({ axis, at }: Section, { min, max }: Box3): LineLoop {
  const i = INDEX[axis];
  const [j, k] = [(i + 1) % 3, (i + 2) % 3];
  const corners = [
    [min, min],
    [max, min],
    [max, max],
    [min, max],
  ].map(([second, third]) =>
    new Vector3().setComponent(i, at).setComponent(j, second!.getComponent(j)).setComponent(k, third!.getComponent(k)),
  );
  const material = new LineBasicMaterial({ color: colour("accent"), transparent: true, opacity: 0.8 });
  return new LineLoop(new BufferGeometry().setFromPoints(corners), material);
}
