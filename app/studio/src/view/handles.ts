/** Handles in the picture that move or turn what they are on. */

import type { Object3D } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";

import type { View } from "./view.ts";

const SIZE = 0.75;

/** Put handles on something, and both into the picture. */
export function handlesOn(on: Object3D, view: View): TransformControls {
  const controls = new TransformControls(view.camera, view.canvas);
  controls.setSize(SIZE);
  controls.addEventListener("change", () => view.draw());
  // An axis is dragged in a plane of its own, which only a picture would turn there: a finger presses before that.
  controls.addEventListener("axis-changed", () => controls.getHelper().updateMatrixWorld());
  controls.attach(on);
  view.scene.add(on, controls.getHelper());
  view.handles.add(controls);
  return controls;
}

/** Take both out of the picture. */
export function withoutHandles(on: Object3D, controls: TransformControls, view: View): void {
  view.isDragged = false;
  view.scene.remove(on, controls.getHelper());
  view.handles.delete(controls);
  controls.dispose();
  view.draw();
}
