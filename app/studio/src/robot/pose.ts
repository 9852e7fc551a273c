/** Poses in the notations of the API, from and to the matrices of three.js. */

import { Matrix4, Quaternion, Vector3 } from "three";

import { t } from "../texts/index.ts";
import type { Pose, PoseFormat } from "../types.ts";

export const FORMATS: readonly { format: PoseFormat; title: string }[] = [
  { format: "quaternion_xyzw", title: t("Quaternion xyzw") },
  { format: "quaternion_wxyz", title: t("Quaternion wxyz") },
  { format: "rpy", title: t("Roll pitch yaw") },
  { format: "zyz", title: t("Euler ZYZ") },
  { format: "rotation_vector", title: t("Rotation vector") },
  { format: "rotation", title: t("Rotation matrix") },
  { format: "matrix", title: t("Homogeneous") },
];

export const IN_RADIANS: ReadonlySet<PoseFormat> = new Set(["rpy", "zyz", "rotation_vector"]);

/** Row by row, as the API writes matrices. */
export function rows(T: Matrix4): number[][] {
  const e = T.elements;
  return [0, 1, 2, 3].map((i) => [0, 1, 2, 3].map((j) => e[i + 4 * j] as number));
}

export function position(T: Matrix4): number[] {
  return [...T.elements.slice(12, 15)];
}

/** A pose in one notation: a valid request of the API. */
export function asPose(T: Matrix4, format: PoseFormat): Pose {
  if (format === "matrix") return { matrix: rows(T) };
  return { position: position(T), [format]: orientation(T, format) };
}

export function orientation(T: Matrix4, format: Exclude<PoseFormat, "matrix">): number[] | number[][] {
  const R = rows(T)
    .slice(0, 3)
    .map((row) => row.slice(0, 3));
  const at = (i: number, j: number) => R[i]![j]!;
  switch (format) {
    case "rotation":
      return R;
    case "quaternion_xyzw":
      return quaternion(T);
    case "quaternion_wxyz": {
      const [x, y, z, w] = quaternion(T) as [number, number, number, number];
      return [w, x, y, z];
    }
    case "rotation_vector": {
      const [x, y, z, w] = quaternion(T) as [number, number, number, number];
      const s = Math.hypot(x, y, z);
      const scale = s > 0 ? (2 * Math.atan2(s, w)) / s : 2;
      return [x * scale, y * scale, z * scale];
    }
    case "rpy": {
      const cos = Math.hypot(at(0, 0), at(1, 0));
      const pitch = Math.atan2(-at(2, 0), cos);
      if (cos < 1e-9) return [0, pitch, Math.atan2(-at(0, 1), at(1, 1))];
      return [Math.atan2(at(2, 1), at(2, 2)), pitch, Math.atan2(at(1, 0), at(0, 0))];
    }
    case "zyz": {
      const sin = Math.hypot(at(0, 2), at(1, 2));
      const theta = Math.atan2(sin, at(2, 2));
      if (sin < 1e-9) return [Math.atan2(at(1, 0), at(1, 1)), theta, 0];
      return [Math.atan2(at(1, 2), at(0, 2)), theta, Math.atan2(at(2, 1), -at(2, 0))];
    }
  }
}

/** Unit quaternion x y z w with w ≥ 0; Shepperd's method, the largest component first. */
function quaternion(T: Matrix4): number[] {
  const q = new Quaternion().setFromRotationMatrix(T).normalize();
  const sign = q.w < 0 ? -1 : 1;
  return [q.x * sign, q.y * sign, q.z * sign, q.w * sign];
}

/** T_a_b of a pose that the service sent as a matrix, or of a base or tool of a table. */
export function asMatrix(pose: Pose | null | undefined): Matrix4 {
  const T = new Matrix4();
  if (!pose) return T;
  if (pose.matrix) return T.set(...(pose.matrix.flat() as Parameters<Matrix4["set"]>));
  const [x = 0, y = 0, z = 0] = pose.position ?? [];
  if (pose.rotation) {
    const [x_row, y_row, z_row] = pose.rotation as [number[], number[], number[]];
    return T.set(...([...x_row, x, ...y_row, y, ...z_row, z, 0, 0, 0, 1] as Parameters<Matrix4["set"]>));
  }
  T.makeRotationFromQuaternion(asQuaternion(pose));
  return T.setPosition(x, y, z);
}

function asQuaternion(pose: Pose): Quaternion {
  if (pose.quaternion_xyzw) return new Quaternion(...pose.quaternion_xyzw).normalize();
  if (pose.quaternion_wxyz) {
    const [w, x, y, z] = pose.quaternion_wxyz;
    return new Quaternion(x, y, z, w).normalize();
  }
  if (pose.rotation_vector) {
    const [x = 0, y = 0, z = 0] = pose.rotation_vector;
    const angle = Math.hypot(x, y, z);
    const s = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
    return new Quaternion(x * s, y * s, z * s, Math.cos(angle / 2));
  }
  const [first = 0, second = 0, third = 0] = pose.zyz ?? pose.rpy ?? [];
  if (pose.zyz) return turn("z", first).multiply(turn("y", second)).multiply(turn("z", third));
  return turn("z", third).multiply(turn("y", second)).multiply(turn("x", first));
}

function turn(axis: "x" | "y" | "z", angle: number): Quaternion {
  const q = new Quaternion(0, 0, 0, Math.cos(angle / 2));
  q[axis] = Math.sin(angle / 2);
  return q;
}

/** How far two poses are apart: distance [m], angle [rad]; small angles by the chord, which rounding does not swallow. */
export function difference(A: Matrix4, B: Matrix4): { position: number; angle: number } {
  const a = A.elements;
  const b = B.elements;
  const at = (k: number) => a[k]! - b[k]!;
  const chord = Math.hypot(...[0, 1, 2, 4, 5, 6, 8, 9, 10].map(at));
  return {
    position: Math.hypot(at(12), at(13), at(14)),
    angle: 2 * Math.asin(Math.min(1, chord / Math.SQRT2 / 2)),
  };
}

/** Whether a value, of an address for instance, has the form of a pose; whether it is a rotation is another matter. */
export function isPose(value: unknown): value is Pose {
  if (typeof value !== "object" || value === null) return false;
  const { position: place, ...rest } = value as Pose;
  const format = formatOf(rest);
  if (Object.keys(rest).length !== 1 || !format || (format === "matrix") !== (place === undefined)) return false;
  return (place === undefined || hasShape(place, [3])) && hasShape(rest[format], SHAPES[format]);
}

export function formatOf(pose: Pose): PoseFormat | null {
  return FORMATS.find(({ format }) => pose[format] !== undefined)?.format ?? null;
}

const SHAPES: Record<PoseFormat, readonly number[]> = {
  quaternion_xyzw: [4],
  quaternion_wxyz: [4],
  rpy: [3],
  zyz: [3],
  rotation_vector: [3],
  rotation: [3, 3],
  matrix: [4, 4],
};

function hasShape(value: unknown, [length, ...rest]: readonly number[]): boolean {
  if (length === undefined) return Number.isFinite(value);
  return Array.isArray(value) && value.length === length && value.every((item) => hasShape(item, rest));
}

/** The pose with a rotation in the place of what is nearly one: x keeps its direction, y its plane with x. */
export function straightened(pose: Pose): Matrix4 {
  const T = asMatrix(pose);
  const [x, y, z, p] = [new Vector3(), new Vector3(), new Vector3(), new Vector3().setFromMatrixPosition(T)];
  T.extractBasis(x, y, z);
  z.crossVectors(x, y).normalize();
  x.normalize();
  y.crossVectors(z, x);
  const isFlat = z.length() < 0.5;
  return (isFlat ? new Matrix4() : new Matrix4().makeBasis(x, y, z)).setPosition(p);
}
