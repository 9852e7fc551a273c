/** Asks the service what the robot touches where it is, and how far the nearest pair is apart. */

import { type Api, asProblem, Paced, type Problem } from "../api.ts";
import { type ShownChain, shownChain } from "../robot/chain.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import type { CollisionAnswer, CollisionResult } from "../types.ts";
import { type Scene, sceneField } from "./objects.ts";

/** What the service says of the configuration on the screen. */
export interface Contacts {
  /** The nearest pair; in contact every pair that is. */
  pairs: NonNullable<CollisionResult["pairs"]>;
  inCollision: boolean;
  /** Null where nothing can touch anything, [m]. */
  clearance: number | null;
  warnings: readonly string[];
}

/** The call that asks for it. */
export function call(chain: ShownChain, scene: Scene): Record<string, unknown> {
  return {
    ...chain.ends,
    joint_positions: [chain.configuration],
    ...sceneField(scene),
    ...chain.others,
    clearance: true,
  };
}

/** Keep the contacts as the robot and the scene are, where there is a scene or the panel wants them. */
export function followContacts(store: Store<State>, api: Api): void {
  const paced = new Paced<Readonly<State>>(async (state) => {
    const chain = shownChain(state)!;
    const ask = (more: object) =>
      api.post<CollisionAnswer>(`${chain.path}/collisions`, { ...call(chain, state.scene), ...more });
    try {
      const answer = await ask({});
      const [{ in_collision: inCollision, clearance, pairs }] = answer.results as [CollisionResult];
      const all = inCollision ? (await ask({ pairs: "all" })).results[0]!.pairs : pairs;
      set({ pairs: all ?? [], inCollision, clearance: clearance ?? null, warnings: answer.warnings }, null);
    } catch (error) {
      set(null, asProblem(error, t("Contacts cannot be computed")));
    }
  });
  const set = (contacts: Contacts | null, refusal: Problem | null) => {
    if (isWanted(store.value)) store.set({ contacts, refusal });
  };
  store.watch(["model", "base", "tip", "positions", "scene", "panel"], (state) => {
    if (isWanted(state)) paced.want(state);
    else store.set({ contacts: null, refusal: null });
  });
}

function isWanted(state: Readonly<State>): boolean {
  return (state.scene.objects.length > 0 || state.panel === "cell") && shownChain(state)?.path != null;
}
