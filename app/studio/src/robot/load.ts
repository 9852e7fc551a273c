/** Bring the robot that the state names onto the screen: its description at once, its meshes as they arrive. */

import { LoadingManager, Mesh, type Object3D } from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";

import { type Api, Latest, NOT_OF_THE_SERVICE, Problem } from "../api.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import type { ChainEnds, DhTable, RobotInfo, TableAnswer, ToUrdfAnswer } from "../types.ts";
import { type MeshSource, meshSource, quiet } from "./meshes.ts";
import { RobotModel } from "./model.ts";

/** The links that the service writes a table between. */
const TABLE_CHAIN: ChainEnds = { base_frame: "base", tip_frame: "tool" };
const DRAFT_NAME = "draft";

export class Loader {
  #latest = new Latest();
  #tables = new Latest();
  #restored: number[] | null = null;

  /** @param shown is told when the scene of the model has changed: a mesh has arrived. */
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

  async #load(): Promise<void> {
    const { robot, draft } = this.store.value;
    if (!robot && !draft) return;
    this.store.set({ loading: true, failure: null });
    try {
      const model = await this.#latest.run((signal) =>
        draft ? this.#draft(draft, signal) : this.#kept(robot, signal),
      );
      if (model) this.#show(model);
    } catch (error) {
      this.store.set({ loading: false, failure: asProblem(error) });
    }
  }

  async #kept(name: string, signal: AbortSignal): Promise<RobotModel> {
    const path = `v1/robots/${encodeURIComponent(name)}`;
    const [info, urdf] = await Promise.all([
      this.api.get<RobotInfo>(path, signal),
      this.api.text(`${path}/urdf`, signal),
    ]);
    const source = meshSource((file) =>
      this.api.url(`${path}/meshes/${file.split("/").map(encodeURIComponent).join("/")}`),
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
    const loader = new URDFLoader(new LoadingManager());
    loader.packages = (packageName: string) => `package://${packageName}`;
    loader.loadMeshCb = (reference, _, material, done) => {
      const file = path(reference);
      arrivals.push((model) => this.#arrive(model, reference, file, () => source(file!, quiet(material)), done));
    };
    const root: URDFRobot = loader.parse(urdf);
    root.traverse((node) => {
      if (node instanceof Mesh) quiet(node.material);
    });
    const model = new RobotModel(name, root, urdf, ends, info);
    model.meshes.wanted = arrivals.length;
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
    } catch {
      model.meshes.failed.push(reference);
    }
    this.shown(model);
  }

  #show(model: RobotModel): void {
    const state = this.store.value;
    const before = state.model;
    const base = model.has(state.base) ? state.base : null;
    const tip = model.has(state.tip) ? state.tip : null;
    const [from, to] = [base ?? model.ends.base_frame, tip ?? model.ends.tip_frame];
    const isSame = before !== null && namesOf(before) === namesOf(model);
    const positions = model.complete(this.#restored ?? (isSame ? state.positions : null), from, to);
    this.#restored = null;
    model.place(positions);
    const table = state.draft ? { dh: state.draft, base: TABLE_CHAIN.base_frame } : null;
    this.store.set({ model, positions, base, tip, table, loading: false, failure: null });
  }

  /** The table of the chain, where its frames are wanted. A draft is its own. */
  async #fetchTable(): Promise<void> {
    const { dh, model, base, tip } = this.store.value;
    if (!model || model.name === null) return;
    const { name } = model;
    if (!dh) {
      this.#tables.cancel();
      this.store.set({ table: null });
      return;
    }
    try {
      if (model.info?.dh && isWhole(this.store.value)) {
        this.#tables.cancel();
        this.store.set({ table: { dh: model.info.dh, base: TABLE_CHAIN.base_frame } });
        return;
      }
      const path = tablePath(name, "standard", base, tip);
      const answer = await this.#tables.run((signal) => this.api.get<TableAnswer>(path, signal));
      if (answer) this.store.set({ table: { dh: answer.dh, base: answer.base_frame } });
    } catch {
      this.store.set({ table: null });
    }
  }
}

/** Whether the chain is the one that a table describes. */
function isWhole({ model, base, tip }: Readonly<State>): boolean {
  const ends = [base ?? model?.ends.base_frame, tip ?? model?.ends.tip_frame];
  return ends[0] === TABLE_CHAIN.base_frame && ends[1] === TABLE_CHAIN.tip_frame;
}

function namesOf(model: RobotModel): string {
  return model.joints.map(({ name }) => name).join();
}

export function tablePath(robot: string, convention: string, base: string | null, tip: string | null): string {
  const query = new URLSearchParams({ convention });
  if (base) query.set("base_frame", base);
  if (tip) query.set("tip_frame", tip);
  return `v1/robots/${encodeURIComponent(robot)}/dh?${query}`;
}

export function asProblem(error: unknown): Problem {
  return error instanceof Problem
    ? error
    : new Problem(NOT_OF_THE_SERVICE, "This robot cannot be shown", String(error));
}
