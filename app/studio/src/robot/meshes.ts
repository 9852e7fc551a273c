/** Mesh files of a robot, from the service; a file that several links show is fetched once. */

import {
  BoxGeometry,
  type Camera,
  Color,
  CylinderGeometry,
  FileLoader,
  type Light,
  LoadingManager,
  type Material,
  Mesh,
  MeshPhongMaterial,
  type Object3D,
} from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";

import type { LinkShape } from "../types.ts";

export type MeshSource = (path: string, material: Material) => Promise<Object3D>;

const BARE = new Color(0xffffff);

/** Where the files of one robot come from.
 *
 * @param url of a file below the robot's meshes.
 * @param headers that it is asked for with.
 */
export function meshSource(url: (path: string) => string, headers: Record<string, string>): MeshSource {
  const fetched = new Map<string, Promise<Object3D>>();
  return async (path, material) => {
    const found = fetched.get(path) ?? load(url(path), path, headers);
    fetched.set(path, found);
    return dressed((await found).clone(true), path, material);
  };
}

async function load(url: string, path: string, headers: Record<string, string>): Promise<Object3D> {
  const manager = new LoadingManager();
  switch (path.split(".").pop()?.toLowerCase()) {
    case "stl":
      return new Mesh(await new STLLoader(manager).setRequestHeader(headers).loadAsync(url));
    case "obj":
      return new OBJLoader(manager).setRequestHeader(headers).loadAsync(url);
    case "dae": {
      const collada = new ColladaLoader(manager).parse(
        asItStands(await new FileLoader(manager).setRequestHeader(headers).loadAsync(url)),
        folder(url),
      );
      if (!collada) throw new Error("no Collada document");
      for (const extra of lightsAndCameras(collada.scene)) extra.removeFromParent();
      return collada.scene;
    }
    default:
      throw new Error("no reader for this kind of file");
  }
}

/** A Collada document without its up axis: a URDF takes the numbers of a mesh as they are. */
function asItStands(text: string | ArrayBuffer): string {
  return String(text).replace(/<up_axis>[^<]*<\/up_axis>/, "");
}

function folder(url: string): string {
  return url.slice(0, url.lastIndexOf("/") + 1);
}

/** Files of bare geometry get the material of the URDF; a Collada file has its own. */
function dressed(object: Object3D, path: string, material: Material): Object3D {
  if (/\.dae$/i.test(path)) return object;
  object.traverse((node) => {
    if (node instanceof Mesh) node.material = material;
  });
  return object;
}

function lightsAndCameras(scene: Object3D): Object3D[] {
  const found: Object3D[] = [];
  scene.traverse((node) => {
    if ((node as Light).isLight || (node as Camera).isCamera) found.push(node);
  });
  return found;
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

/** The material of a visual that names none: a quiet grey in the place of glaring white. */
export function quiet(material: Material): Material {
  if (material instanceof MeshPhongMaterial) {
    if (material.color.equals(BARE) && !material.name) material.color.set(0xc4c8ce);
    material.shininess = 18;
    material.specular.set(0x222222);
  }
  return material;
}
