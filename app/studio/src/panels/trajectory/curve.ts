/** A motion as the polynomials that it is: exact at every time, not at the samples alone. */

import type { TrajectoryAnswer } from "../../types.ts";

/** The positions themselves, velocity, acceleration, jerk. */
export type Derivative = 0 | 1 | 2 | 3;

export interface Samples {
  times: number[];
  /** The piece that each sample is of: at a break there is one of the piece before and one of that after. */
  pieces: number[];
  /** For each joint its values. */
  values: number[][];
}

export class Curve {
  /** Where the pieces begin, and where the last one ends, [s]. */
  readonly breaks: number[] = [];
  #coefficients: number[][][] = [];

  constructor({ segments, duration, joint_positions: positions }: TrajectoryAnswer) {
    for (const { polynomials } of segments) {
      const { breaks, coefficients } = polynomials!; // which the planner asks for
      this.breaks.push(...breaks.slice(0, coefficients.length));
      this.#coefficients.push(...coefficients);
    }
    // What cannot begin stays where it starts.
    if (!this.#coefficients.length) {
      this.breaks.push(0);
      this.#coefficients.push([positions[0]!]);
    }
    this.breaks.push(duration);
  }

  get duration(): number {
    return this.breaks.at(-1)!;
  }

  /** One number a joint, [rad or m per sᵏ]; where the derivative jumps, that after the jump. */
  at(time: number, derivative: Derivative = 0): number[] {
    return this.#in(this.piece(time), time, derivative);
  }

  /** At least so many samples, both ends of each piece among them, so that what jumps is drawn as a jump. */
  sample(derivative: Derivative, least: number): Samples {
    const found: Samples = { times: [], pieces: [], values: [] };
    for (const [piece, coefficients] of this.#coefficients.entries()) {
      const [from, to] = [this.breaks[piece]!, this.breaks[piece + 1]!];
      const share = Math.ceil((least * (to - from)) / (this.duration || 1));
      const count = coefficients.length - derivative <= 2 ? 1 : Math.max(share, 2);
      for (let i = 0; i <= count; i += 1) {
        const time = i === count ? to : from + (i * (to - from)) / count;
        found.times.push(time);
        found.pieces.push(piece);
        for (const [joint, value] of this.#in(piece, time, derivative).entries())
          (found.values[joint] ??= []).push(value);
      }
    }
    return found;
  }

  /** The one that holds at a time: at a break the later one. */
  piece(time: number): number {
    let [low, high] = [0, this.#coefficients.length - 1];
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.breaks[middle]! <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Horner's rule for each joint. */
  #in(piece: number, time: number, derivative: Derivative): number[] {
    const powers = this.#coefficients[piece]!;
    const since = time - this.breaks[piece]!;
    return powers[0]!.map((_, joint) => {
      let value = 0;
      for (let k = powers.length - 1; k >= derivative; k -= 1) {
        let factor = 1;
        for (let down = 0; down < derivative; down += 1) factor *= k - down;
        value = value * since + factor * powers[k]![joint]!;
      }
      return value;
    });
  }
}
