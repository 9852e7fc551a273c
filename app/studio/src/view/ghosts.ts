/** Translucent copies of a robot in other configurations: only what moves, and of the robot's own geometry. */

import { Group, Mesh, MeshLambertMaterial } from "three";

import type { Joint, RobotModel } from "../robot/model.ts";
import type { Positions } from "../state.ts";
import type { Hue } from "./colours.ts";
import { colour } from "./colours.ts";

/** One copy; it stays where it was put. Belongs to the robot as long as that is on the screen. */
export class Ghost {
  readonly group = new Group();
  #material: MeshLambertMaterial;
  #parts: { from: Mesh; copy: Mesh }[];

  /** @param joints whose links are copied: those of the chain. */
  constructor(
    private readonly model: RobotModel,
    joints: readonly Joint[],
    hue: Hue,
    opacity: number,
  ) {
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
    this.model.place(present);
  }

  paint(hue: Hue, opacity: number): void {
    this.#material.color = colour(hue);
    this.#material.opacity = opacity;
  }

  remove(): void {
    this.group.removeFromParent();
    this.#material.dispose();
  }
}
