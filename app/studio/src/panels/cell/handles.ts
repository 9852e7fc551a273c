/** Handles in the picture on the object that is being edited: they move it, or turn it. */

import { Matrix4, Object3D } from "three";
import type { TransformControls } from "three/addons/controls/TransformControls.js";

import { moved, placeOf, replaced } from "../../scene/objects.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import type { SceneObject } from "../../types.ts";
import { colour } from "../../view/colours.ts";
import { handlesOn, withoutHandles } from "../../view/handles.ts";
import { put } from "../../view/shapes.ts";
import type { View } from "../../view/view.ts";

export class Handles {
  #controls: TransformControls;
  #handle = new Object3D();
  #stops: (() => void)[];

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
  ) {
    this.#controls = handlesOn(this.#handle, view);
    this.#controls.addEventListener("objectChange", () => this.#take());
    this.#controls.addEventListener("dragging-changed", ({ value }) => {
      view.isDragged = Boolean(value);
      if (!value) this.#place();
    });
    this.#handle.name = "object handle";
    this.#stops = [
      store.watch(["dark"], () => this.#controls.setColors(colour("x"), colour("y"), colour("z"), colour("axis"))),
      store.watch(["model", "scene", "chosen", "positions"], () => this.#place()),
    ];
  }

  turnTo(mode: "translate" | "rotate"): void {
    this.#controls.setMode(mode);
    this.#controls.setSpace(mode === "rotate" ? "local" : "world");
    this.view.draw();
  }

  close(): void {
    for (const stop of this.#stops) stop();
    withoutHandles(this.#handle, this.#controls, this.view);
  }

  #place(): void {
    const object = chosenObject(this.store.value);
    this.#controls.enabled = this.#controls.getHelper().visible = object !== null;
    if (!object || this.#controls.dragging) return;
    put(this.#handle, frameOf(object, this.store.value).multiply(placeOf(object)));
    this.view.draw();
  }

  #take(): void {
    const { scene } = this.store.value;
    const object = chosenObject(this.store.value);
    if (!object) return;
    this.#handle.updateMatrixWorld();
    const T = frameOf(object, this.store.value).invert().multiply(this.#handle.matrixWorld);
    this.store.set({ scene: replaced(scene, object.name, moved(object, T)) });
  }
}

/** The object that is being edited. */
export function chosenObject({ scene, chosen }: Readonly<State>): SceneObject | null {
  return scene.objects.find(({ name }) => name === chosen) ?? null;
}

/** T_world_frame of what an object is placed in. */
function frameOf({ attached_to: frame }: SceneObject, { model }: Readonly<State>): Matrix4 {
  return model?.has(frame ?? null) ? model.link(frame!).matrixWorld.clone() : new Matrix4();
}
