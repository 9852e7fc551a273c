/** Bring the robot that the state names onto the screen: its description at once, its meshes as they arrive. */

import { LoadingManager, type Material, Mesh, type Object3D } from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";

import { type Api, asProblem, Latest } from "../api.ts";
import type { Positions, State } from "../state.ts";
import type { Store } from "../store.ts";
import type { ChainEnds, DhTable, RobotInfo, ToUrdfAnswer } from "../types.ts";
import { drawn, type MeshSource, meshSource, quiet, sticks } from "./meshes.ts";
import { RobotModel } from "./model.ts";
import { chainTable, draftTable, TABLE_CHAIN } from "./table.ts";

const DRAFT_NAME = "draft";
const NOT_FOUND = 404;
/** How long a mesh waits for the next ones, [ms]. */
const TOGETHER = 150;

export class Loader {
  #latest = new Latest();
  #tables = new Latest();
  #restored: number[] | null = null;
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

  /** The positions that the next robot starts at. */
  startAt(positions: number[] | null): void {
    this.#restored = positions;
  }

  /** The service is back: what it could not be asked for is asked again. */
  again(): void {
    const { model, failure } = this.store.value;
    if (failure || model?.meshes.failed.length) void this.#load();
  }

  async #load(): Promise<void> {
    const { robot, draft } = this.store.value;
    if (!robot && !draft) return;
    this.#received = 0;
    this.store.set({ loading: true, failure: null, received: 0 });
    try {
      const model = await this.#latest.run((signal) =>
        draft ? this.#draft(draft, signal) : this.#kept(robot, signal),
      );
      if (model) this.#show(model);
    } catch (error) {
      const failure = asProblem(error, "This robot cannot be shown");
      this.store.set({ loading: false, failure });
      // There is what it says, and what else there is.
      if (failure.status === NOT_FOUND && !this.store.value.model) this.store.set({ panel: "robot" });
    }
  }

  async #kept(name: string, signal: AbortSignal): Promise<RobotModel> {
    const path = `v1/robots/${encodeURIComponent(name)}`;
    const [info, urdf] = await Promise.all([
      this.api.get<RobotInfo>(path, signal),
      this.api.text(`${path}/urdf`, signal),
    ]);
    const source = meshSource(
      (file) => this.api.url(`${path}/meshes/${file.split("/").map(encodeURIComponent).join("/")}`),
      { headers: this.api.key.headers, signal, progress: (bytes) => this.#count(bytes, signal) },
    );
    const paths = new Map(info.meshes.map(({ reference, path: file }) => [reference, file]));
    return this.#model(name, urdf, info.default_chain, info, (reference) => paths.get(reference) ?? null, source);
  }

  async #draft(dh: DhTable, signal: AbortSignal): Promise<RobotModel> {
    const answer = await this.api.post<ToUrdfAnswer>("v1/dh/to-urdf", { name: DRAFT_NAME, dh }, signal);
    return this.#model(
      null,
      answer.urdf,
      TABLE_CHAIN,
      null,
      () => null,
      async () => new Mesh(),
    );
  }

  #model(
    name: string | null,
    urdf: string,
    ends: ChainEnds,
    info: RobotInfo | null,
    path: (reference: string) => string | null,
    source: MeshSource,
  ): RobotModel {
    const arrivals: ((model: RobotModel) => Promise<void>)[] = [];
    let comes = false;
    const loader = new URDFLoader(new LoadingManager());
    loader.packages = (packageName: string) => `package://${packageName}`;
    loader.loadMeshCb = (reference, _, material, done) => {
      const file = path(reference);
      comes ||= file !== null;
      arrivals.push((model) => this.#arrive(model, reference, file, () => source(file!, quiet(material)), done));
    };
    const root: URDFRobot = loader.parse(urdf);
    for (const { link, ...solid } of info?.skeleton ?? []) root.links[link]?.add(drawn(solid));
    root.traverse((node) => {
      if (node instanceof Mesh) quiet(node.material);
    });
    const model = new RobotModel(name, root, urdf, ends, info);
    model.meshes.wanted = arrivals.length;
    if (comes) model.standIns = sticks(root);
    for (const arrive of arrivals) void arrive(model);
    return model;
  }

  async #arrive(
    model: RobotModel,
    reference: string,
    file: string | null,
    fetch: () => Promise<Object3D>,
    done: (object: Object3D) => void,
  ): Promise<void> {
    if (file === null) {
      model.meshes.failed.push(reference);
      return;
    }
    try {
      done(await fetch());
      model.meshes.shown += 1;
    } catch (error) {
      if ((error as Error).name === "AbortError") return;
      model.meshes.failed.push(reference);
    }
    this.#tell(model);
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
    const { wanted, shown, failed } = model.meshes;
    const isComplete = shown + failed.length >= wanted;
    if (isComplete && shown) removeAll(model.standIns);
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
    if (draft || !model || model.name === null) return;
    if (!dh) {
      this.#tables.cancel();
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

function removeAll(rods: Mesh[]): void {
  for (const rod of rods.splice(0)) {
    rod.removeFromParent();
    rod.geometry.dispose();
    (rod.material as Material).dispose();
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
