/** What undo and redo restore, and what the difference of two such documents is called. Not the camera, marks, theme,
 * units, nor what the service keeps or answers. */

import { changed, type Scene } from "../scene/objects.ts";
import type { State } from "../state.ts";
import { t } from "../texts/index.ts";
import type { DhTable } from "../types.ts";

const KEYS = [
  "robot",
  "draft",
  "base",
  "tip",
  "positions",
  "target",
  "inverse",
  "motion",
  "scene",
  "writing",
  "options",
] as const;

export const DOCUMENT: readonly (keyof State)[] = KEYS;

export type Doc = Pick<State, (typeof KEYS)[number]>;

/** A change that can be undone. */
export interface Step {
  name: string;
  /** The panel that shows what has changed; null where the picture does. */
  panel: string | null;
}

/** Options that are no input: places to go, and what the service is doing. */
const ELSEWHERE = /^exercises\.|^workspace\.job$/;
const SYMBOLS: Readonly<Record<string, string>> = { alpha: "α", theta: "θ" };

export function docOf(state: Readonly<State>): Doc {
  return Object.fromEntries(KEYS.map((key) => [key, state[key]])) as unknown as Doc;
}

/** The step from one document to another; null where nothing differs that a person would want to undo, such as a target
 * or motion that a panel begins with, or a scene that has been stored. */
export function step(before: Doc, after: Doc): Step | null {
  for (const { panel, named } of KINDS) {
    const name = named(before, after);
    if (name !== null) return { name, panel };
  }
  return optionStep(before, after);
}

/** What of the state becomes another for a document; the positions are for whoever knows the robot. */
export function restored(doc: Doc, state: Readonly<State>): Omit<Doc, "positions"> {
  const { positions: _, ...rest } = doc;
  const options = { ...select(state.options, true), ...select(doc.options, false) };
  return {
    ...rest,
    options: isSame(options, state.options) ? state.options : options,
    // Whether the service still keeps under its name what it kept then is unknown.
    scene: isSame(doc.scene.objects, state.scene.objects) ? state.scene : changed(doc.scene, doc.scene.objects),
  };
}

interface Kind {
  panel: string | null;
  named: (before: Doc, after: Doc) => string | null;
}

/** By what a change is called first: who drags the target moves the robot too. */
const KINDS: readonly Kind[] = [
  { panel: null, named: robotChange },
  { panel: null, named: sceneChange },
  { panel: "ik", named: (one, other) => (one.target && differ(one, other, "target") ? t("Move the target") : null) },
  {
    panel: null,
    named: (one, other) => (differ(one, other, "base") || differ(one, other, "tip") ? t("Choose the chain") : null),
  },
  { panel: "trajectory", named: motionChange },
  { panel: null, named: movement },
  {
    panel: "ik",
    named: (one, other) => (differ(one, other, "inverse") ? t("Change what the inverse looks for") : null),
  },
  { panel: "worked", named: (one, other) => (differ(one, other, "writing") ? t("Change the worked solution") : null) },
];

function robotChange(before: Doc, after: Doc): string | null {
  if (after.draft === null) return before.robot === after.robot ? null : t("Show {robot}", { robot: after.robot });
  if (before.draft === null) return t("Change the table");
  return differ(before, after, "draft") ? tableChange(before.draft, after.draft) : null;
}

function tableChange(before: DhTable, after: DhTable): string {
  const more = after.joints.length - before.joints.length;
  if (more === 1) return t("Add a row");
  if (more === -1) return t("Remove a row");
  const cells = after.joints.flatMap((row, i) => {
    const old: Readonly<Record<string, unknown>> = { ...before.joints[i] };
    const parts = Object.entries(row).filter(([part, value]) => !isSame(value, old[part]));
    return parts.map(([part]) => t("Change {SYMBOLS} of row {i}", { SYMBOLS: SYMBOLS[part] ?? part, i: i + 1 }));
  });
  return more === 0 && cells.length === 1 ? cells[0]! : t("Change the table");
}

function sceneChange({ scene: before }: Doc, { scene: after }: Doc): string | null {
  if (before.objects === after.objects || isOnItsWay(before) || isOnItsWay(after)) return null;
  const [olds, news] = [before, after].map(({ objects }) => new Map(objects.map((one) => [one.name, one]))) as [
    Map<string, object>,
    Map<string, object>,
  ];
  const added = [...news.keys()].filter((name) => !olds.has(name));
  const removed = [...olds.keys()].filter((name) => !news.has(name));
  const others = [...news.keys()].filter((name) => olds.has(name) && !isSame(olds.get(name), news.get(name)));
  const [only, ...more] = [
    ...added.map((name) => t("Add {name}", { name })),
    ...removed.map((name) => t("Remove {name}", { name })),
    ...others.map((name) => t("Change {name}", { name })),
  ];
  return more.length ? t("Change the scene") : (only ?? null);
}

/** Whether the objects have not yet come from the service. */
function isOnItsWay({ name, objects }: Scene): boolean {
  return name !== null && objects.length === 0;
}

/** A motion of another chain is that chain's, and comes with it. */
function motionChange({ motion: before }: Doc, { motion: after }: Doc): string | null {
  if (!before || !after || isSame(before, after)) return null;
  const isOfOneChain = (["robot", "base_frame", "tip_frame"] as const).every((key) => before[key] === after[key]);
  return isOfOneChain ? t("Change the motion") : null;
}

function movement({ positions: before }: Doc, { positions: after }: Doc): string | null {
  if (before === after) return null;
  const moved = Object.keys(after).filter((name) => name in before && before[name] !== after[name]);
  if (moved.length === 0) return null;
  return moved.length === 1 ? t("Move {moved}", { moved: moved[0] }) : t("Move the robot");
}

function optionStep({ options: before }: Doc, { options: after }: Doc): Step | null {
  if (before === after) return null;
  const names = Object.keys({ ...before, ...after }).filter((name) => !ELSEWHERE.test(name));
  const found = names.find((name) => before[name] !== after[name]);
  if (found === undefined) return null;
  const panel = found.split(".")[0]!;
  return { name: panel === "compare" ? t("Change the comparison") : t("Change a setting"), panel };
}

function select(options: Doc["options"], isElsewhere: boolean): Doc["options"] {
  return Object.fromEntries(Object.entries(options).filter(([name]) => ELSEWHERE.test(name) === isElsewhere));
}

function differ(before: Doc, after: Doc, key: keyof Doc): boolean {
  return !isSame(before[key], after[key]);
}

function isSame(one: unknown, other: unknown): boolean {
  return one === other || JSON.stringify(one) === JSON.stringify(other);
}
