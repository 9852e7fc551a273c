/** A robot from the service, or one that a table describes: its description at once, its meshes as they arrive. */

import { LoadingManager, type Material, Mesh, type Object3D } from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";

import type { Api } from "../api.ts";
import type { Linked } from "../state.ts";
import type { ChainEnds, RobotInfo, ToUrdfAnswer } from "../types.ts";
import { drawn, type MeshSource, meshSource, quiet, sticks } from "./meshes.ts";
import { RobotModel } from "./model.ts";
import { TABLE_CHAIN } from "./table.ts";

const DRAFT_NAME = "draft";

/** What is told while meshes arrive. */
export interface Arriving {
  /** So many bytes more. */
  received?: (bytes: number) => void;
  /** A file is in the scene of the model, or will never be. */
  arrived: (model: RobotModel) => void;
}

/** The robot of that name, or the draft where there is one; `signal` ends what is still on its way. */
export function fetchModel(
  api: Api,
  { robot, draft }: Pick<Linked, "robot" | "draft">,
  signal: AbortSignal,
  tell: Arriving,
): Promise<RobotModel> {
  return draft ? drafted(api, draft, signal) : kept(api, robot, signal, tell);
}

async function kept(api: Api, name: string, signal: AbortSignal, tell: Arriving): Promise<RobotModel> {
  const path = `v1/robots/${encodeURIComponent(name)}`;
  const [info, urdf] = await Promise.all([api.get<RobotInfo>(path, signal), api.text(`${path}/urdf`, signal)]);
  const source = meshSource((file) => api.url(`${path}/meshes/${file.split("/").map(encodeURIComponent).join("/")}`), {
    headers: api.key.headers,
    signal,
    ...(tell.received && { progress: tell.received }),
  });
  const paths = new Map(info.meshes.map(({ reference, path: file }) => [reference, file]));
  return model(
    name,
    urdf,
    info.default_chain,
    info,
    { path: (reference) => paths.get(reference) ?? null, source },
    tell,
  );
}

async function drafted(api: Api, dh: NonNullable<Linked["draft"]>, signal: AbortSignal): Promise<RobotModel> {
  const { urdf } = await api.post<ToUrdfAnswer>("v1/dh/to-urdf", { name: DRAFT_NAME, dh }, signal);
  const none: Files = { path: () => null, source: async () => new Mesh() };
  return model(null, urdf, TABLE_CHAIN, null, none, { arrived: () => {} });
}

interface Files {
  /** Where the service has what a description refers to; null for what it does not have. */
  path: (reference: string) => string | null;
  source: MeshSource;
}

function model(
  name: string | null,
  urdf: string,
  ends: ChainEnds,
  info: RobotInfo | null,
  { path, source }: Files,
  tell: Arriving,
): RobotModel {
  const arrivals: ((made: RobotModel) => Promise<void>)[] = [];
  let comes = false;
  const loader = new URDFLoader(new LoadingManager());
  loader.packages = (packageName: string) => `package://${packageName}`;
  loader.loadMeshCb = (reference, _, material, done) => {
    const file = path(reference);
    comes ||= file !== null;
    const fetch = file === null ? null : () => source(file, quiet(material));
    arrivals.push((made) => arrive(made, reference, fetch, done, tell));
  };
  const root: URDFRobot = loader.parse(urdf);
  for (const { link, ...solid } of info?.skeleton ?? []) root.links[link]?.add(drawn(solid));
  root.traverse((node) => {
    if (node instanceof Mesh) quiet(node.material);
  });
  const made = new RobotModel(name, root, urdf, ends, info);
  made.meshes.wanted = arrivals.length;
  if (comes) made.standIns = sticks(root);
  for (const each of arrivals) void each(made);
  return made;
}

async function arrive(
  made: RobotModel,
  reference: string,
  fetch: (() => Promise<Object3D>) | null,
  done: (object: Object3D) => void,
  tell: Arriving,
): Promise<void> {
  if (fetch === null) {
    made.meshes.failed.push(reference);
    return;
  }
  try {
    done(await fetch());
    made.meshes.shown += 1;
  } catch (error) {
    if ((error as Error).name === "AbortError") return;
    made.meshes.failed.push(reference);
  }
  if (made.isComplete && made.meshes.shown) removeAll(made.standIns);
  tell.arrived(made);
}

function removeAll(rods: Mesh[]): void {
  for (const rod of rods.splice(0)) {
    rod.removeFromParent();
    rod.geometry.dispose();
    (rod.material as Material).dispose();
  }
}
