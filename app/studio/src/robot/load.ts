/** Bring the robot that the state names onto the screen: its description at once, its meshes as they arrive. */

import { type Api, asProblem, Latest } from "../api.ts";
import type { Positions, State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import { fetchModel } from "./fetch.ts";
import type { RobotModel } from "./model.ts";
import { chainTable, draftTable } from "./table.ts";

const NOT_FOUND = 404;
/** How long a mesh waits for the next ones, [ms]. */
const TOGETHER = 150;

export class Loader {
  #latest = new Latest();
  #tables = new Latest();
  #restored: Positions | number[] | null = null;
  #arrival = 0;
  #received = 0;
  #counting = 0;

  /** @param shown is told when the scene of the model has changed: meshes have arrived. */
  constructor(
    private readonly api: Api,
    private readonly store: Store<State>,
    private readonly shown: (model: RobotModel) => void,
  ) {}

  /** Follow the state from now on; the first robot starts at these positions. */
  follow(positions: number[] | null): void {
    this.#restored = positions;
    this.store.watch(["robot", "draft"], () => void this.#load());
    this.store.watch(["dh", "model", "base", "tip"], () => void this.#fetchTable());
  }

  /** Set values of the state, with the positions of the robot that they name, which may have to be fetched first. */
  restore(values: Partial<State> & Pick<State, "robot" | "draft">, positions: Positions | number[] | null): void {
    const { robot, draft, model, loading } = this.store.value;
    const isSame = values.robot === robot && JSON.stringify(values.draft) === JSON.stringify(draft);
    const isShown = isSame && model !== null && !loading;
    this.#restored = isShown ? null : positions;
    this.store.set({
      ...values,
      ...(isSame && { robot, draft }),
      ...(isShown && { positions: model.complete(positions, model.ends.base_frame, model.ends.tip_frame) }),
    });
  }

  /** The service is back: what it could not be asked for is asked again. */
  again(): void {
    const { model, failure } = this.store.value;
    if (failure || model?.meshes.failed.length) void this.#load();
  }

  async #load(): Promise<void> {
    const { robot, draft } = this.store.value;
    if (!robot && !draft) {
      this.#latest.cancel();
      return this.store.set({ loading: false, failure: null });
    }
    this.#received = 0;
    this.store.set({ loading: true, failure: null, received: 0 });
    try {
      const model = await this.#latest.run((signal) =>
        fetchModel(this.api, { robot, draft }, signal, {
          received: (bytes) => this.#count(bytes, signal),
          arrived: (made) => this.#tell(made),
        }),
      );
      if (model) this.#show(model);
    } catch (error) {
      const failure = asProblem(error, t("This robot cannot be shown"));
      this.store.set({ loading: false, failure });
      // There is what it says, and what else there is.
      if (failure.status === NOT_FOUND && !this.store.value.model) this.store.set({ panel: "robot" });
    }
  }

  /** Bytes of meshes have arrived; how many in all is told now and then. */
  #count(bytes: number, signal: AbortSignal): void {
    this.#received += bytes;
    if (this.#counting) return;
    this.#counting = window.setTimeout(() => {
      this.#counting = 0;
      if (!signal.aborted) this.store.set({ received: this.#received });
    }, TOGETHER);
  }

  /** Meshes that arrive one after the other are shown together: each picture of a large robot takes its time. */
  #tell(model: RobotModel): void {
    const { isComplete } = model;
    if (this.#arrival && !isComplete) return;
    clearTimeout(this.#arrival);
    const tell = () => {
      this.#arrival = 0;
      this.shown(model);
    };
    if (isComplete) tell();
    else this.#arrival = window.setTimeout(tell, TOGETHER);
  }

  #show(model: RobotModel): void {
    const state = this.store.value;
    const before = state.model;
    const base = model.has(state.base) ? state.base : null;
    const tip = model.has(state.tip) ? state.tip : null;
    const [from, to] = [base ?? model.ends.base_frame, tip ?? model.ends.tip_frame];
    const positions = model.complete(this.#restored ?? carried(before, model, state.positions), from, to);
    this.#restored = null;
    model.place(positions);
    const table = state.draft && draftTable(state.draft);
    this.store.set({ model, positions, base, tip, table, loading: false, failure: null });
  }

  /** The table of the chain, where its frames are wanted. A draft is its own. */
  async #fetchTable(): Promise<void> {
    const { dh, draft, model } = this.store.value;
    this.#tables.cancel();
    if (draft || !model || model.name === null) return;
    if (!dh) {
      this.store.set({ table: null });
      return;
    }
    try {
      const table = await this.#tables.run((signal) => chainTable(this.api, this.store.value, signal));
      if (table) this.store.set({ table });
    } catch {
      this.store.set({ table: null });
    }
  }
}

/** The positions of the robot before, where they mean the same: its joints have these names, or it is a table whose
 * joints have been renamed. */
function carried(before: RobotModel | null, model: RobotModel, positions: Positions): Positions | number[] | null {
  if (!before) return null;
  if (namesOf(before) === namesOf(model)) return positions;
  const isRenamed = before.name === null && model.name === null && before.joints.length === model.joints.length;
  return isRenamed ? before.joints.map(({ name }) => positions[name]!) : null;
}

function namesOf(model: RobotModel): string {
  return model.joints.map(({ name }) => name).join();
}
