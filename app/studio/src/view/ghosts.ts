/** Translucent copies of a robot in other configurations: only what moves, and of the robot's own geometry. */

import { Group, Mesh, MeshLambertMaterial } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";

import type { Joint, RobotModel } from "../robot/model.ts";
import type { Positions } from "../state.ts";
import type { Hue } from "./colours.ts";
import { colour } from "./colours.ts";
import { label } from "./shapes.ts";

/** One copy; it stays where it was put. Belongs to the robot as long as that is on the screen. */
export class Ghost {
  readonly group = new Group();
  /** What it is called, beside the middle of its chain: tips meet where configurations differ. */
  readonly label: CSS2DObject;
  #middle: string | null;
  #material: MeshLambertMaterial;
  #parts: { from: Mesh; copy: Mesh }[];

  /**
   * @param joints whose links are copied: those of the chain.
   * @param name of its label; without one it has none.
   */
  constructor(
    private readonly model: RobotModel,
    joints: readonly Joint[],
    hue: Hue,
    opacity: number,
    name = "",
  ) {
    this.label = label(name, `ghost ${hue}`);
    this.#middle = name ? (joints[Math.min(Math.ceil(joints.length / 2), joints.length - 1)]?.name ?? null) : null;
    this.label.visible = this.#middle !== null;
    // Set back by a hair: where a ghost and the robot share a surface, the robot is seen and nothing flickers.
    const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    this.#material = new MeshLambertMaterial({ color: colour(hue), transparent: true, opacity, ...behind });
    this.#parts = model.moving(joints).map((from) => {
      const copy = new Mesh(from.geometry, this.#material);
      copy.matrixAutoUpdate = false;
      return { from, copy };
    });
    // One by one: before the meshes have come there may be none, and `add` wants at least one.
    for (const { copy } of this.#parts) this.group.add(copy);
  }

  /** @param present where the robot itself is to be afterwards. */
  place(at: Positions, present: Positions): void {
    this.model.place(at);
    for (const { from, copy } of this.#parts) copy.matrix.copy(from.matrixWorld);
    const joint = this.#middle && this.model.root.joints[this.#middle];
    if (joint) this.label.position.setFromMatrixPosition(joint.matrixWorld);
    this.model.place(present);
  }

  paint(hue: Hue, opacity: number): void {
    this.#material.color = colour(hue);
    this.#material.opacity = opacity;
    this.label.element.classList.toggle("bad", hue === "bad");
  }

  /** Show it and its label, or neither. */
  show(isShown: boolean): void {
    this.group.visible = isShown;
    this.label.visible = isShown && this.#middle !== null;
  }

  remove(): void {
    this.group.removeFromParent();
    this.label.removeFromParent();
    this.#material.dispose();
  }
}
