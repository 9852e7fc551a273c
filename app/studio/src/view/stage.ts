/** What the view is set up with, and what it has to know of a robot: its size, its plane, what it holds. */

import { Box3, LineSegments, type Material, Mesh, type Object3D, type Texture, Vector3, WebGLRenderer } from "three";

import type { RobotModel } from "../robot/model.ts";

const BACK = new Vector3(0, -1, 0);

/** Draws on a canvas of its own; throws where the browser has no WebGL. */
export function makeRenderer(antialias: boolean): WebGLRenderer {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", { alpha: true, depth: true, stencil: false, antialias });
  if (!context) throw new Error("no WebGL");
  return new WebGLRenderer({ canvas, context });
}

/** Whether no graphics card draws: then smooth edges and fine pixels cost much of the time of a picture. Some browsers
 * do not count that as a "major performance caveat", so that the renderer's name is asked too. */
export function isDrawnBySoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!probe) return true;
  const named = probe.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = probe.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : probe.RENDERER);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name));
}

/** Whence a planar arm is seen in its plane: from the side that is nearer to the usual one; null for other robots. */
export function acrossOf(model: RobotModel, usual: Vector3): Vector3 | null {
  const normal = model.normal();
  if (!normal) return null;
  if (normal.dot(usual) < 0) normal.negate();
  // Straight from above there would be no telling what is to the right.
  return normal.addScaledVector(BACK, Math.abs(normal.z) > 0.999 ? 1e-3 : 0).normalize();
}

/** What the robot takes up: its links' origins, and the meshes that have arrived. */
export function extent(model: RobotModel): Box3 {
  const box = new Box3().setFromObject(model.root);
  const point = new Vector3();
  for (const name of model.links) box.expandByPoint(point.setFromMatrixPosition(model.link(name).matrixWorld));
  return box;
}

export function dispose(root: Object3D): void {
  root.removeFromParent();
  root.traverse((node) => {
    if (!(node instanceof Mesh || node instanceof LineSegments)) return;
    node.geometry.dispose();
    for (const material of [node.material].flat() as (Material & { map?: Texture | null })[]) {
      material.map?.dispose();
      material.dispose();
    }
  });
}
