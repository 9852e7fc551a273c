/** Frames of two chains beside each other, in the first one's base: which meet, and where the first is that does not. */

import { Matrix4, Vector3 } from "three";

import { shownChain } from "../../robot/chain.ts";
import { frames } from "../../robot/dh.ts";
import { kindOf } from "../../robot/model.ts";
import { asMatrix, difference } from "../../robot/pose.ts";
import type { ChainTable } from "../../robot/table.ts";
import type { Positions, State } from "../../state.ts";
import type { CompareAnswer } from "../../types.ts";

/** Within these two frames count as one, as the service has it, [m] and [rad]. */
const NEAR = { position: 1e-5, angle: 1e-4 };

/** A frame of the first, and the one of the second with its number, in the base of the first. */
export interface Pair {
  /** Null for the tips. */
  index: number | null;
  first: Matrix4;
  second: Matrix4;
  /** How far they are apart, [m] and [rad]. */
  position: number;
  angle: number;
  meets: boolean;
}

export interface Tables {
  first: ChainTable;
  second: ChainTable;
}

/** What the service found, and whether it asked of the first one's table whether it describes the second. */
export interface Verdict {
  answer: CompareAnswer;
  isSwapped: boolean;
}

/** Where the second chain is put so that it agrees with the first as well as the verdict says. */
export interface Alignment {
  base: Matrix4;
  tool: Matrix4;
}

/** The base and tool that were found, in the place of those that a table has.
 *
 * @param isAsked whether they are what somebody looks for; else they count only where they make the two agree, as what
 *   comes nearest to an arm with one wrong number has no frame in its place.
 */
export function alignment(tables: Tables | null, verdict: Verdict | null, isAsked: boolean): Alignment {
  if (!tables || !verdict || !(isAsked || verdict.answer.equivalent))
    return { base: new Matrix4(), tool: new Matrix4() };
  const { answer, isSwapped } = verdict;
  const { dh } = isSwapped ? tables.first : tables.second;
  const base = asMatrix(answer.found.includes("base") ? answer.base : dh.base).multiply(asMatrix(dh.base).invert());
  const tool = asMatrix(dh.tool)
    .invert()
    .multiply(asMatrix(answer.found.includes("tool") ? answer.tool : dh.tool));
  return isSwapped ? { base: base.invert(), tool: tool.invert() } : { base, tool };
}

/** How a joint of the second follows the first one's with its number; null where one turns and the other slides. */
export interface Link {
  sign: number;
  offset: number;
}

/** A link for each joint that both chains have, by order from the base. */
export function links(first: Readonly<State>, second: Readonly<State>, verdict: Verdict | null): (Link | null)[] {
  const [leaders, followers] = [first, second].map((state) => shownChain(state)?.joints ?? []);
  const count = Math.min(leaders!.length, followers!.length);
  return leaders!.slice(0, count).map((joint, i) => {
    if (kindOf(joint) !== kindOf(followers![i]!)) return null;
    const [sign, offset] = [verdict?.answer.signs?.[i] ?? 1, verdict?.answer.offsets?.[i] ?? 0];
    // The table's variable is sign · q + offset.
    return verdict?.isSwapped ? { sign, offset: -sign * offset } : { sign, offset };
  });
}

/** Positions of the second robot that follow those of the first; what follows nothing is at home. */
export function following(first: Readonly<State>, second: Readonly<State>, found: readonly (Link | null)[]): Positions {
  const [leader, follower] = [shownChain(first)!, shownChain(second)!];
  const moved = found.flatMap((link, i) =>
    link ? [[follower.joints[i]!.name, link.sign * leader.configuration[i]! + link.offset]] : [],
  );
  const home = follower.model.home(follower.base, follower.tip);
  return { ...home, ...(Object.fromEntries(moved) as Positions) };
}

/** Where the first number that differs is in its table, between two points of the first one's base. */
export interface Wrong {
  difference: NonNullable<CompareAnswer["first_difference"]>;
  /** Whether it is the second one's. */
  isOfSecond: boolean;
  from: Vector3;
  to: Vector3;
}

/** Null where nothing differs, or what does is no number of a row. */
export function wrong(
  first: Readonly<State>,
  second: Readonly<State>,
  tables: Tables | null,
  verdict: Verdict | null,
  { base }: Alignment,
): Wrong | null {
  const difference = verdict?.answer.first_difference;
  if (!tables || !difference?.row) return null;
  const isOfSecond = !verdict!.isSwapped;
  const [table, { positions }] = isOfSecond ? [tables.second, second] : [tables.first, first];
  const frame = frames(table.dh, positions).rows[difference.row - 1];
  if (!frame || !(difference.parameter in frame.values)) return null;
  // An angle is where the length along its axis begins, and ends.
  const ends = difference.parameter === "a" || difference.parameter === "alpha" ? frame.a : frame.d;
  const T = isOfSecond ? base : new Matrix4();
  const [from, to] = ends.map((point) => point.clone().applyMatrix4(T));
  return { difference, isOfSecond, from: from!, to: to! };
}

/** Frames by their number, then the tips; both models are where their states say. */
export function pairs(
  first: Readonly<State>,
  second: Readonly<State>,
  tables: Tables | null,
  { base, tool }: Alignment,
): Pair[] {
  const [one, other] = [shownChain(first), shownChain(second)];
  if (!one || !other) return [];
  const tip = pair(
    null,
    one.model.pose(one.base, one.tip),
    base.clone().multiply(other.model.pose(other.base, other.tip)).multiply(tool),
  );
  if (!tables) return [tip];
  const [ours, theirs] = [framesOf(tables.first, first.positions), framesOf(tables.second, second.positions)];
  const count = Math.min(ours.length, theirs.length);
  const found = ours.slice(0, count).map((T, i) => pair(i, T, base.clone().multiply(theirs[i]!)));
  return [...found, tip];
}

function framesOf({ dh }: ChainTable, positions: Positions): Matrix4[] {
  const { first, rows } = frames(dh, positions);
  return [first, ...rows.map(({ T }) => T)];
}

function pair(index: number | null, first: Matrix4, second: Matrix4): Pair {
  const { position, angle } = difference(first, second);
  return { index, first, second, position, angle, meets: position < NEAR.position && angle < NEAR.angle };
}
