/** Reads mesh files as they were uploaded: those that have no small form. */

import { type Camera, type Light, LoadingManager, type Material, Mesh, type Object3D } from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";

/** @param material of what has none of its own: only a Collada file has. */
export function readOriginal(content: ArrayBuffer, url: string, path: string, material: Material): Object3D {
  const manager = new LoadingManager();
  const text = () => new TextDecoder().decode(content);
  switch (path.split(".").pop()?.toLowerCase()) {
    case "stl":
      return new Mesh(new STLLoader(manager).parse(content), material);
    case "obj":
      return dressed(new OBJLoader(manager).parse(text()), material);
    case "dae": {
      const collada = new ColladaLoader(manager).parse(asItStands(text()), folder(url));
      if (!collada) throw new Error("no Collada document");
      for (const extra of lightsAndCameras(collada.scene)) extra.removeFromParent();
      return collada.scene;
    }
    default:
      throw new Error("no reader for this kind of file");
  }
}

/** A Collada document without its up axis: a URDF takes the numbers of a mesh as they are. */
function asItStands(text: string): string {
  return text.replace(/<up_axis>[^<]*<\/up_axis>/, "");
}

function folder(url: string): string {
  return url.slice(0, url.lastIndexOf("/") + 1);
}

function dressed(object: Object3D, material: Material): Object3D {
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
