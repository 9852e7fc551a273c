/** Undo and redo: a step for each act that has changed the document. */

import type { RobotModel } from "../robot/model.ts";
import { isNone, type Positions, type State } from "../state.ts";
import { Store } from "../store.ts";
import { PANELS } from "../panels/index.ts";
import { type Doc, docOf, DOCUMENT, restored, step } from "./doc.ts";
import { keepSteps, keptSteps } from "./kept.ts";
import { Past } from "./past.ts";

const REST = 200; // ms

/** The names of what undo and redo would do; null where there is nothing. */
export interface Offered {
  undo: string | null;
  redo: string | null;
}

type Restore = (values: Omit<Doc, "positions"> & Partial<State>, positions: Positions) => void;

export class Steps {
  readonly offered = new Store<Offered>({ undo: null, redo: null });
  #past: Past<Doc>;
  /** Whether the next change is of another act than the one before. */
  #isNew = false;
  #isRestoring = false;
  /** Whether a robot that undo has asked for is on its way: the document is complete without it. */
  #isArriving = false;
  #model: RobotModel | null = null;
  #timer = 0;

  constructor(
    private readonly store: Store<State>,
    private readonly restore: Restore,
  ) {
    const kept = keptSteps(location.hash);
    this.#past = kept ? Past.of(kept) : new Past(docOf(store.value));
    window.addEventListener("pagehide", () => keepSteps(location.hash, this.#past.row));
    store.watch([...DOCUMENT, "model", "loading"], (state) => this.#note(state));
    this.#offer();
  }

  /** What changes from now on is of another act. */
  begin(): void {
    this.#isNew = true;
  }

  /** Undo the last step; answers its name. */
  undo(): string | null {
    return this.#go(-1);
  }

  redo(): string | null {
    return this.#go(1);
  }

  /** The document as it is now; what the page makes of an act later, such as a robot that arrives, is of that act. */
  #note(state: Readonly<State>): void {
    const isFresh = state.model !== this.#model;
    this.#model = state.model;
    if (!state.loading) this.#isArriving = false;
    // Between two robots, on the first screen, there is nothing to come back to.
    if (this.#isRestoring || isNone(state)) return;
    const doc = docOf(state);
    if (this.#isNew && !isFresh && !isNone(this.#past.present) && step(this.#past.present, doc)) {
      this.#isNew = this.#isArriving = false;
      this.#past.push(doc);
      this.#offer();
    } else if (!this.#isArriving) {
      this.#past.amend(doc);
      // What a drag comes to has its name when it rests.
      clearTimeout(this.#timer);
      this.#timer = window.setTimeout(() => this.#offer(), REST);
    }
  }

  #go(by: -1 | 1): string | null {
    const { present, before, after } = this.#past;
    const wanted = by < 0 ? before : after;
    if (!wanted) return null;
    const { name, panel } = (by < 0 ? step(wanted, present) : step(present, wanted)) ?? { name: "", panel: null };
    this.#past.go(by);
    this.#isRestoring = true;
    const isKnown = PANELS.some(({ id }) => id === panel);
    this.restore({ ...restored(wanted, this.store.value), ...(isKnown && { panel: panel! }) }, wanted.positions);
    this.#isRestoring = this.#isNew = false;
    this.#isArriving = this.store.value.loading;
    this.#note(this.store.value);
    this.#offer();
    return name;
  }

  #offer(): void {
    const { present, before, after } = this.#past;
    this.offered.set({
      undo: before && (step(before, present)?.name ?? ""),
      redo: after && (step(present, after)?.name ?? ""),
    });
  }
}
