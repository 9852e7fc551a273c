/** Scenes that the service keeps. */

import { type Api, asProblem, Latest, Paced, Problem } from "../api.ts";
import type { ShownChain } from "../robot/chain.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import type { SceneInfo, SceneList, SceneObject } from "../types.ts";
import { call } from "./contacts.ts";
import { changed, filesOf, type Scene } from "./objects.ts";

const CONFLICT = 409;
const ENDING = /\.(stl|obj|dae)$/i;
const COPIES = "scenes"; // of this tab, in the browser's storage

/** The names of all scenes. */
export async function sceneNames(api: Api): Promise<string[]> {
  return (await api.get<SceneList>("v1/scenes")).scenes.map(({ name }) => name);
}

/** The scene under a name. */
export async function storedScene(api: Api, name: string, signal?: AbortSignal): Promise<Scene> {
  const { objects } = await api.get<SceneInfo>(path(name), signal);
  return { name, objects, origin: name };
}

/** Keep the objects with their files under a name, in the place of those that may be there.
 *
 * @param added files that the scene it comes from does not have.
 */
export async function keepScene(api: Api, name: string, scene: Scene, added: readonly File[] = []): Promise<Scene> {
  const { objects } = scene;
  const files = [...added, ...(await fetched(api, scene, new Set(added.map((file) => file.name))))];
  const content = (text: object) =>
    files.length
      ? { form: { fields: { scene: JSON.stringify(text) }, part: "files", files } as const }
      : { body: text };
  try {
    await api.call({ method: "POST", path: "v1/scenes", ...content({ name, objects }) });
  } catch (error) {
    if (!(error instanceof Problem) || error.status !== CONFLICT) throw error;
    await api.call({ method: "PUT", path: path(name), ...content({ objects }) });
  }
  return { name, objects, origin: name };
}

export function isMesh(file: File): boolean {
  return ENDING.test(file.name);
}

/** The scene with an object of a mesh file, kept as a copy; refused where the service cannot compute contacts with it.
 *
 * @param made is given the name of the file, which no other of the scene has.
 */
export async function withMesh(
  api: Api,
  chain: ShownChain,
  scene: Scene,
  file: File,
  made: (name: string) => SceneObject,
): Promise<Scene> {
  const name = fileName(file, filesOf(scene));
  const more = changed(scene, [...scene.objects, made(name)]);
  const stored = await keepScene(api, copyName(scene), more, [new File([file], name)]);
  try {
    await api.post(`${chain.path}/collisions`, call(chain, stored));
  } catch (error) {
    await api.call({ method: "DELETE", path: path(stored.name!) });
    throw error;
  }
  rememberCopy(stored);
  return stored;
}

/** Keep a changed scene with files up to date at the service, which alone reads them: as a copy, until it is stored
 * under a name. */
export function followFiles(store: Store<State>, api: Api): void {
  const paced = new Paced<Scene>(async (scene) => {
    try {
      const stored = await updated(api, scene);
      const now = store.value.scene;
      if (now === scene) store.set({ scene: stored });
      else if (now.origin === scene.origin && now.name === null)
        store.set({ scene: { ...now, origin: stored.origin } });
    } catch (error) {
      store.set({ refusal: asProblem(error, t("This scene cannot be kept")) });
    }
  });
  store.watch(["scene"], ({ scene }) => {
    if (scene.name === null && scene.origin !== null && filesOf(scene).length) paced.want(scene);
    else paced.cancel();
  });
}

async function updated(api: Api, scene: Scene): Promise<Scene> {
  const { origin, objects } = scene;
  // A copy whose file is no longer named would lose it; undo may name it again.
  const isWhole = copies()[origin!]?.every((file) => filesOf(scene).includes(file));
  if (isWhole) {
    await api.call({ method: "PUT", path: path(origin!), body: { objects } });
    return { name: origin, objects, origin };
  }
  const stored = await keepScene(api, copyName(scene), scene);
  rememberCopy(stored);
  return stored;
}

/** The scene's files from where it comes from, but for those that are at hand. */
function fetched(api: Api, scene: Scene, atHand: ReadonlySet<string>): Promise<File[]> {
  const wanted = filesOf(scene).filter((name) => !atHand.has(name));
  return Promise.all(
    wanted.map(async (name) => {
      const file = `${path(scene.origin ?? "")}/files/${encodeURIComponent(name)}`;
      return new File([await api.bytes(file, "*/*")], name);
    }),
  );
}

/** The file's name as the service takes it, and as no other of the scene is called. */
function fileName({ name }: File, taken: readonly string[]): string {
  const ending = ENDING.exec(name)![0];
  const stem = name
    .slice(0, -ending.length)
    .replace(/[^A-Za-z0-9_.-]+/g, "_")
    .replace(/^[^A-Za-z0-9]+/, "")
    .slice(0, 80);
  for (let i = 1; ; i += 1) {
    const free = `${stem || "mesh"}${i > 1 ? `_${i}` : ""}${ending}`;
    if (!taken.includes(free)) return free;
  }
}

/** A name that is never used again: what has been fetched under it stays right. */
function copyName({ origin }: Scene): string {
  const base = origin?.replace(/\.copy-[a-z0-9]+$/, "").slice(0, 48) ?? "cell";
  return `${base}.copy-${Math.random().toString(36).slice(2, 10)}`;
}

/** The copies of this tab, with their files. */
function copies(): Readonly<Record<string, readonly string[]>> {
  return JSON.parse(sessionStorage.getItem(COPIES) ?? "{}") as Record<string, string[]>;
}

function rememberCopy(scene: Scene): void {
  sessionStorage.setItem(COPIES, JSON.stringify({ ...copies(), [scene.name!]: filesOf(scene) }));
}

/** Fetch the objects of a scene that an address names without them. */
export function followStored(store: Store<State>, api: Api): void {
  const latest = new Latest();
  store.watch(["scene"], ({ scene: { name, objects } }) => {
    if (name === null || objects.length) return latest.cancel();
    latest
      .run((signal) => storedScene(api, name, signal))
      .then((scene) => scene?.objects.length && store.set({ scene }))
      .catch((error: unknown) => store.set({ refusal: asProblem(error, t("This scene cannot be shown")) }));
  });
}

function path(name: string): string {
  return `v1/scenes/${encodeURIComponent(name)}`;
}
