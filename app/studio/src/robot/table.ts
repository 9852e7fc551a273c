/** The Denavit-Hartenberg table of the chain on the screen. */

import type { Api } from "../api.ts";
import type { State } from "../state.ts";
import type { ChainEnds, DhTable, TableAnswer } from "../types.ts";

/** The links that the service writes a table between. */
export const TABLE_CHAIN: ChainEnds = { base_frame: "base", tip_frame: "tool" };

/** A table, and the frame that it starts from. */
export interface ChainTable {
  dh: DhTable;
  base: string;
}

export function draftTable(dh: DhTable): ChainTable {
  return { dh, base: TABLE_CHAIN.base_frame };
}

/** The table that is typed, or that the robot is kept as; else the one that the service finds for the chain. */
export async function chainTable(api: Api, state: Readonly<State>, signal: AbortSignal): Promise<ChainTable | null> {
  const { draft, model, base, tip } = state;
  if (draft) return draftTable(draft);
  if (model?.name == null) return null;
  if (model.info?.dh && isWhole(state)) return draftTable(model.info.dh);
  const answer = await api.get<TableAnswer>(tablePath(model.name, "standard", base, tip), signal);
  return { dh: answer.dh, base: answer.base_frame };
}

/** Whether the chain is the one that a table describes. */
function isWhole({ model, base, tip }: Readonly<State>): boolean {
  const ends = [base ?? model?.ends.base_frame, tip ?? model?.ends.tip_frame];
  return ends[0] === TABLE_CHAIN.base_frame && ends[1] === TABLE_CHAIN.tip_frame;
}

export function tablePath(robot: string, convention: string, base: string | null, tip: string | null): string {
  const query = new URLSearchParams({ convention });
  if (base) query.set("base_frame", base);
  if (tip) query.set("tip_frame", tip);
  return `v1/robots/${encodeURIComponent(robot)}/dh?${query}`;
}
