/** Meshes of a robot, from the service: small ones made for pictures; a file that several links show is fetched once. */

import {
  BoxGeometry,
  Color,
  CylinderGeometry,
  type Material,
  Mesh,
  MeshPhongMaterial,
  type Object3D,
  Vector3,
} from "three";
import type { URDFRobot } from "urdf-loader";

import type { LinkShape } from "../types.ts";
import { GLB, readGlb } from "./glb.ts";

export type MeshSource = (path: string, material: Material) => Promise<Object3D>;

/** Along a cylinder of the library. */
const UP = new Vector3(0, 1, 0);
/** Radius of a rod, in typical distances between joints. */
const SLENDER = 0.05;
const BARE = new Color(0xffffff);
const SMALL = `${GLB}, */*;q=0.5`;
const FAULT_OF_THE_SERVICE = 500;
/** As many at a time as a browser sends over HTTP/1: over HTTP/2 it would send them all, and the service refuse some. */
const MOST_AT_A_TIME = 6;

export interface Fetching {
  headers: Record<string, string>;
  /** Ends all that is still being fetched. */
  signal?: AbortSignal;
  /** Told of each piece that arrives, how many bytes it has. */
  progress?: (bytes: number) => void;
}

/** Where the files of one robot come from.
 *
 * @param url of a file below the robot's meshes.
 */
export function meshSource(url: (path: string) => string, fetching: Fetching): MeshSource {
  const fetched = new Map<string, ReturnType<typeof load>>();
  const lanes: Promise<unknown>[] = Array.from({ length: MOST_AT_A_TIME }, () => Promise.resolve());
  return async (path, material) => {
    if (!fetched.has(path)) {
      const lane = fetched.size % MOST_AT_A_TIME;
      const found = lanes[lane]!.then(() => load(url(path), path, fetching));
      lanes[lane] = found.catch(() => {});
      fetched.set(path, found);
    }
    return (await fetched.get(path)!)(material);
  };
}

/** What makes an object of a file; with geometry of its own each time, as whoever removes a robot disposes of it. */
async function load(url: string, path: string, fetching: Fetching): Promise<(material: Material) => Object3D> {
  const ask = (accept: string) => asked(url, accept, fetching);
  let answer = await ask(SMALL);
  if (answer.status >= FAULT_OF_THE_SERVICE) answer = await ask("*/*"); // what is hard to make small may be shown as it is
  if (!answer.ok) throw new Error(`the service answered ${answer.status}`);
  const content = await answer.arrayBuffer();
  if (answer.headers.get("Content-Type") === GLB) return (material) => readGlb(content, material);
  const { readOriginal } = await import("./originals.ts");
  return (material) => readOriginal(content, url, path, material);
}

async function asked(url: string, accept: string, { headers, signal, progress }: Fetching): Promise<Response> {
  const answer = await fetch(url, { headers: { ...headers, Accept: accept }, signal: signal ?? null });
  if (!answer.body || !progress) return answer;
  const counter = new TransformStream<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>({
    transform(piece, stream) {
      progress(piece.byteLength);
      stream.enqueue(piece);
    },
  });
  return new Response(answer.body.pipeThrough(counter), answer);
}

type Triple = [number, number, number];

/** A shape that the service offers for a link. */
export function drawn({ shape, pose }: Omit<LinkShape, "link">): Mesh {
  const geometry =
    shape.type === "box"
      ? new BoxGeometry(...(shape.size as Triple))
      : new CylinderGeometry(shape.radius, shape.radius, shape.length, 24).rotateX(Math.PI / 2);
  const mesh = new Mesh(geometry, new MeshPhongMaterial());
  mesh.position.fromArray(pose.position!);
  mesh.quaternion.fromArray(pose.quaternion_xyzw!);
  return mesh;
}

/** Rods from each joint to the next ones, in the place of meshes that are on their way. */
export function sticks(root: URDFRobot): Mesh[] {
  const joints = Object.values(root.joints).filter(({ position }) => position.lengthSq() > 0);
  const lengths = joints.map(({ position }) => position.length()).sort((a, b) => a - b);
  const radius = SLENDER * (lengths[lengths.length >> 1] ?? 0);
  return joints.map((joint) => {
    const geometry = new CylinderGeometry(radius, radius, joint.position.length(), 12);
    const rod = new Mesh(geometry, quiet(new MeshPhongMaterial()));
    rod.position.copy(joint.position).multiplyScalar(0.5);
    rod.quaternion.setFromUnitVectors(UP, joint.position.clone().normalize());
    joint.parent!.add(rod);
    return rod;
  });
}

/** The material of a visual that names none: a quiet grey in the place of glaring white. */
export function quiet(material: Material): Material {
  if (material instanceof MeshPhongMaterial) {
    if (material.color.equals(BARE) && !material.name) material.color.set(0xc4c8ce);
    material.shininess = 18;
    material.specular.set(0x222222);
  }
  return material;
}
