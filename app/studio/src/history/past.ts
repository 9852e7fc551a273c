/** States in a row, and the present among them: pure, bounded, and of whatever kind. */

/** How many steps can be undone; the oldest are forgotten. */
export const STEPS = 100;

/** States with the number of the one that is the present. */
export interface Row<D> {
  states: readonly D[];
  at: number;
}

export class Past<D> {
  #states: D[];
  #at = 0;

  constructor(
    present: D,
    private readonly limit = STEPS,
  ) {
    this.#states = [present];
  }

  get present(): D {
    return this.#states[this.#at]!;
  }

  /** The state that undo leads to; null where there is none. */
  get before(): D | null {
    return this.#states[this.#at - 1] ?? null;
  }

  /** The state that redo leads to; null where there is none. */
  get after(): D | null {
    return this.#states[this.#at + 1] ?? null;
  }

  /** A step: what had been undone is lost. */
  push(state: D): void {
    this.#states.splice(this.#at + 1, Infinity, state);
    if (this.#states.length > this.limit + 1) this.#states.shift();
    this.#at = this.#states.length - 1;
  }

  /** The present has become another without a step. */
  amend(state: D): void {
    this.#states[this.#at] = state;
  }

  /** Go to the state before (-1) or after (1), if it is there. */
  go(by: -1 | 1): void {
    if (this.#at + by in this.#states) this.#at += by;
  }

  /** All of it. */
  get row(): Row<D> {
    return { states: this.#states, at: this.#at };
  }

  static of<D>({ states, at }: Row<D>): Past<D> {
    const made = new Past(states[0] as D);
    made.#states = [...states];
    made.#at = at;
    return made;
  }
}
