/** Scenes that the service keeps. */

import { type Api, asProblem, Latest, Problem } from "../api.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import type { SceneInfo, SceneList } from "../types.ts";
import type { Scene } from "./objects.ts";

const CONFLICT = 409;

/** The names of all scenes. */
export async function sceneNames(api: Api): Promise<string[]> {
  return (await api.get<SceneList>("v1/scenes")).scenes.map(({ name }) => name);
}

/** The scene under a name. */
export async function storedScene(api: Api, name: string, signal?: AbortSignal): Promise<Scene> {
  const { objects } = await api.get<SceneInfo>(path(name), signal);
  return { name, objects };
}

/** Keep the objects under a name, in the place of those that may be there. */
export async function keepScene(api: Api, name: string, { objects }: Scene): Promise<Scene> {
  try {
    await api.post("v1/scenes", { name, objects });
  } catch (error) {
    if (!(error instanceof Problem) || error.status !== CONFLICT) throw error;
    await api.call({ method: "PUT", path: path(name), body: { objects } });
  }
  return { name, objects };
}

/** Fetch the objects of a scene that an address names without them. */
export function followStored(store: Store<State>, api: Api): void {
  const latest = new Latest();
  store.watch(["scene"], ({ scene: { name, objects } }) => {
    if (name === null || objects.length) return latest.cancel();
    latest
      .run((signal) => storedScene(api, name, signal))
      .then((scene) => scene?.objects.length && store.set({ scene }))
      .catch((error: unknown) => store.set({ refusal: asProblem(error, "This scene cannot be shown") }));
  });
}

function path(name: string): string {
  return `v1/scenes/${encodeURIComponent(name)}`;
}
