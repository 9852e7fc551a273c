/** What is compared with the robot on the screen, and how: options of the state, so that a link has them. */

import { chosen, choosing, type State } from "../../state.ts";
import type { DhTable } from "../../types.ts";

/** The table of the same arm in the other convention; a robot that the service keeps; a table that is typed. */
export const KINDS = ["convention", "robot", "table"] as const;
const PLACINGS = ["beside", "over"] as const;
const LINKS = ["linked", "free"] as const;
/** What may be another where two are the same: what a table leaves out; base and tool; zeros and senses of joints too. */
export const FREEDOMS = ["given", "ends", "all"] as const;

export interface Wanted {
  with: (typeof KINDS)[number];
  robot: string;
  table: DhTable | null;
  placing: (typeof PLACINGS)[number];
  link: (typeof LINKS)[number];
  find: (typeof FREEDOMS)[number];
  /** Positions of the second chain where it is moved by itself, base to tip. */
  q: number[] | null;
}

export function wanted(state: Readonly<State>): Wanted {
  const { options } = state;
  const q = options["compare.q"]?.split(",").map(Number) ?? null;
  return {
    with: chosen(state, "compare.with", KINDS),
    robot: options["compare.robot"] ?? "",
    table: asTable(options["compare.table"]),
    placing: chosen(state, "compare.placing", PLACINGS),
    link: chosen(state, "compare.link", LINKS),
    find: chosen(state, "compare.find", FREEDOMS),
    q: q?.every(Number.isFinite) ? q : null,
  };
}

/** The options with other values for some of these; null takes one away. */
export function wanting(
  state: Readonly<State>,
  values: Partial<Record<keyof Wanted, string | null>>,
): Pick<State, "options"> {
  let made: Pick<State, "options"> = state;
  for (const [name, value] of Object.entries(values)) made = choosing({ ...state, ...made }, `compare.${name}`, value);
  return { options: made.options };
}

/** What has the form of a table; whether the service takes its numbers is for the service to say. */
function asTable(text: string | undefined): DhTable | null {
  try {
    const table = JSON.parse(text ?? "null") as Partial<DhTable> | null;
    return table && Array.isArray(table.joints) && table.joints.every((row) => typeof row === "object" && row !== null)
      ? (table as DhTable)
      : null;
  } catch {
    return null;
  }
}
