/** The target in the picture, to be dragged: along the base's axes, or about its own. */

import { Object3D, Vector3 } from "three";
import type { TransformControls } from "three/addons/controls/TransformControls.js";

import { shownChain } from "../../robot/chain.ts";
import { asMatrix, asPose, formatOf } from "../../robot/pose.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import type { Direction, Pose } from "../../types.ts";
import { colour } from "../../view/colours.ts";
import { handlesOn, withoutHandles } from "../../view/handles.ts";
import { put } from "../../view/shapes.ts";
import type { View } from "../../view/view.ts";
import { fullOptions } from "./call.ts";

export type DragMode = "translate" | "rotate";

export interface GizmoEvents {
  dragged: (target: Pose) => void;
  dropped: () => void;
}

export class Gizmo {
  #controls: TransformControls;
  /** What the handles are on: at the target, turned as the base is while the target is moved. */
  #handle = new Object3D();
  #mode: DragMode = "translate";
  #stops: (() => void)[];

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
    events: GizmoEvents,
  ) {
    this.#controls = handlesOn(this.#handle, view);
    this.#controls.setSpace("local");
    this.#controls.addEventListener("objectChange", () => events.dragged(this.#target()));
    this.#controls.addEventListener("dragging-changed", ({ value }) => {
      view.isDragged = Boolean(value);
      if (!value) {
        this.#place();
        events.dropped();
      }
    });
    this.#handle.name = "target handle";
    this.#stops = [
      store.watch(["dark"], () => this.#controls.setColors(colour("x"), colour("y"), colour("z"), colour("axis"))),
      store.watch(["model", "base", "tip", "target", "inverse", "positions"], () => this.#place()),
    ];
  }

  get mode(): DragMode {
    return this.#mode;
  }

  /** Whether there is a direction to drag in: one that counts. */
  allows(mode: DragMode): boolean {
    return this.#task().some((direction) => direction.startsWith("r") === (mode === "rotate"));
  }

  /** Move or turn from now on, as far as that is allowed; answers what it is. */
  turnTo(wanted: DragMode): DragMode {
    const other = wanted === "rotate" ? "translate" : "rotate";
    this.#mode = this.allows(wanted) ? wanted : other;
    this.#controls.setMode(this.#mode);
    this.#place();
    return this.#mode;
  }

  close(): void {
    for (const stop of this.#stops) stop();
    withoutHandles(this.#handle, this.#controls, this.view);
  }

  /** Put the handles to the target, those of the directions that count. */
  #place(): void {
    const { target } = this.store.value;
    const chain = shownChain(this.store.value);
    this.#controls.enabled = this.#controls.getHelper().visible = chain !== null && target !== null;
    if (!chain || !target || this.#controls.dragging) return;
    const task = this.#task();
    const isTurning = this.#mode === "rotate";
    this.#controls.showX = task.includes(isTurning ? "rx" : "x");
    this.#controls.showY = task.includes(isTurning ? "ry" : "y");
    this.#controls.showZ = task.includes(isTurning ? "rz" : "z");
    const { showX, showY, showZ } = this.#controls;
    this.#controls.showE = this.#controls.showXYZE = showX && showY && showZ;
    const T_world_base = chain.model.link(chain.base).matrixWorld;
    put(this.#handle, T_world_base.clone().multiply(asMatrix(target)));
    if (!isTurning) T_world_base.decompose(new Vector3(), this.#handle.quaternion, new Vector3());
    this.view.draw();
  }

  #task(): Direction[] {
    const joints = shownChain(this.store.value)?.joints.length ?? 0;
    return fullOptions(this.store.value.inverse, joints).task;
  }

  /** The pose that the handles are at, in the notation of the target. */
  #target(): Pose {
    const chain = shownChain(this.store.value)!;
    const before = this.store.value.target!;
    this.#handle.updateMatrixWorld();
    const T = chain.model.link(chain.base).matrixWorld.clone().invert().multiply(this.#handle.matrixWorld);
    const dragged = this.#mode === "rotate" ? T : asMatrix(before).copyPosition(T);
    return asPose(dragged, formatOf(before) ?? "rpy");
  }
}
