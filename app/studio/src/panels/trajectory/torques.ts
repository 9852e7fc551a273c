/** The motors' torques as the service samples them, on straight lines between the samples. */

import type { TrajectoryAnswer } from "../../types.ts";
import type { Curve, Samples } from "./curve.ts";

export class Torques {
  readonly #times: number[];
  readonly #rows: number[][];

  constructor(
    { times, joint_torques }: TrajectoryAnswer,
    private readonly curve: Curve,
  ) {
    this.#times = times;
    this.#rows = joint_torques!;
  }

  sample(): Samples {
    const values = this.#rows[0]!.map((_, joint) => this.#rows.map((row) => row[joint]!));
    return { times: this.#times, pieces: this.#times.map((time) => this.curve.piece(time)), values };
  }

  /** One number a joint, [N m or N]. */
  at(time: number): number[] {
    const after = this.#times.findIndex((other) => other > time);
    if (after <= 0) return this.#rows.at(after)!; // before the first sample, or at the last one
    const [from, to] = [this.#times[after - 1]!, this.#times[after]!];
    const share = (time - from) / (to - from);
    return this.#rows[after - 1]!.map((value, joint) => value + share * (this.#rows[after]![joint]! - value));
  }
}
