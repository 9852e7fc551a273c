/** The service's worked solution of the table on the screen, asked for again when the joints have come to rest. */

import { type Api, asProblem, Latest, type Problem } from "../../api.ts";
import { jointName } from "../../robot/dh.ts";
import { chainTable } from "../../robot/table.ts";
import type { Positions, State } from "../../state.ts";
import type { Store } from "../../store.ts";
import type { DeriveAnswer, DhTable } from "../../types.ts";

/** How long the joints rest before the service is asked for their numbers, [ms]. */
const REST = 300;

export interface Derived {
  table: DhTable;
  answer: DeriveAnswer;
  /** Where the answer's numbers are meant. */
  positions: Positions;
  /** The same for answers with the same formulas. */
  key: string;
}

export interface Listener {
  derived(found: Derived): void;
  /** Null when there is none any more. */
  failed(problem: Problem | null): void;
  busy(isBusy: boolean): void;
}

export class Derivation {
  #tables = new Latest();
  #answers = new Latest();
  #table: DhTable | null = null;
  #isFetching = false;
  #answered = "";
  #asked = "";
  #rest = 0;

  constructor(
    private readonly api: Api,
    private readonly store: Store<State>,
    private readonly listener: Listener,
  ) {}

  /** Follow the state; returns how to stop. */
  follow(): () => void {
    const settle = () => {
      clearTimeout(this.#rest);
      this.#rest = window.setTimeout(() => void this.ask(), REST);
    };
    const stops = [
      this.store.watch(["model", "base", "tip"], () => void this.#fetchTable()),
      this.store.watch(["writing"], () => void (this.#table || this.#isFetching ? this.ask() : this.#fetchTable())),
      this.store.watch(["positions"], settle),
      () => clearTimeout(this.#rest),
      () => this.cancel(),
    ];
    return () => stops.forEach((stop) => stop());
  }

  /** Wait no longer. */
  cancel(): void {
    clearTimeout(this.#rest);
    this.#tables.cancel();
    this.#drop();
    this.listener.busy(false);
  }

  #drop(): void {
    this.#answers.cancel();
    this.#asked = "";
  }

  /** Ask for the solution, unless it is there, or asked for already. */
  async ask(): Promise<void> {
    const { positions, writing } = this.store.value;
    if (!this.#table) return;
    const { key, call } = question(this.#table, positions, writing);
    const asked = JSON.stringify(call);
    if (asked === this.#asked) return;
    this.#drop();
    if (asked === this.#answered) return this.listener.busy(false);
    this.#asked = asked;
    await this.#attempt(async () => {
      const answer = await this.#answers.run((signal) => this.api.post<DeriveAnswer>("v1/dh/derive", call, signal));
      if (!answer) return false;
      this.#answered = asked;
      this.listener.derived({ table: call.dh, answer, positions, key });
      return true;
    });
  }

  async #fetchTable(): Promise<void> {
    this.#table = null;
    this.#isFetching = true;
    this.#answered = ""; // the sheet is empty again, be the table the same
    this.#drop();
    await this.#attempt(async () => {
      const found = await this.#tables.run((signal) => chainTable(this.api, this.store.value, signal));
      if (!found) return false;
      this.#table = found.dh;
      return true;
    });
    this.#isFetching = false;
    await this.ask();
  }

  /** Tell that something is under way, and whether it failed; what was overtaken says nothing. */
  async #attempt(work: () => Promise<boolean>): Promise<void> {
    this.listener.busy(true);
    try {
      if (!(await work())) return;
      this.listener.failed(null);
    } catch (error) {
      this.#asked = this.#answered = ""; // what stood on the sheet is gone
      this.listener.failed(asProblem(error));
    }
    this.listener.busy(false);
  }
}

function question(dh: DhTable, positions: Positions, { part, notation, symbolic }: State["writing"]) {
  const style = { dh, notation, symbolic, ...(part === "motion" ? { dynamics: {} } : {}) };
  const joint_positions = [dh.joints.map((row, index) => positions[jointName(row, index)] ?? 0)];
  return { key: JSON.stringify(style), call: { ...style, joint_positions } };
}
