/** The state in the address bar, behind `#`: readable, exact to the last digit, and never sent to a server. */

import { asMotion } from "./panels/trajectory/link.ts";
import { asTheme, type Prefs } from "./prefs.ts";
import { FIRST, type Linked, type State, type Writing } from "./state.ts";
import { asObjects } from "./scene/objects.ts";
import type { Store } from "./store.ts";
import { isPose } from "./robot/pose.ts";
import { type Units, UNITS } from "./ui/quantity.ts";
import { asLook } from "./view/looking.ts";
import { type DhTable, DIRECTIONS, type InverseOptions } from "./types.ts";

/** What can be drawn on a robot besides itself. */
export const MARKS = ["frames", "axes", "names", "dh", "dimensions", "bodies"] as const;
const FLAGS = [...UNITS, "parallel", ...MARKS] as const;
const OPTION = /^[a-z]+\.[a-z]+$/; // `panel.option`
const PARTS: readonly string[] = ["transforms", "pose", "jacobian", "singular", "motion"];
const AGAIN = "gelenk:address"; // as the browser's `popstate`, where the address stays the same
const WRITE_AFTER = 250; // browsers refuse more than some hundred changes of the address in half a minute

export interface Address {
  linked: Linked;
  /** Positions in the order of the model's joints. */
  positions: number[] | null;
}

/** What a link says; of what it leaves to whoever opens it, their preferences. */
export function read(hash: string, prefs: Pick<Prefs, "theme" | keyof Units>): Address {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const linked: Linked = { ...FIRST };
  linked.panel = given.get("panel") ?? FIRST.panel;
  linked.draft = json<DhTable>(given.get("dh-table"));
  // A link with a panel alone shows it for the first robot; one without anything leaves the choice to the person.
  linked.robot = linked.draft ? "" : (given.get("robot") ?? (given.has("panel") ? FIRST.robot : ""));
  linked.base = given.get("base");
  linked.tip = given.get("tip");
  const target = json<unknown>(given.get("target"));
  linked.target = isPose(target) ? target : null;
  linked.inverse = inverseOptions(json<unknown>(given.get("ik")));
  linked.writing = writing(given.get("worked")?.split(",") ?? []);
  linked.motion = asMotion(json(given.get("motion")));
  linked.scene = {
    name: given.get("scene"),
    origin: given.get("scene"),
    objects: asObjects(json(given.get("objects"))),
  };
  const shown = new Set((given.get("show") ?? "").split(","));
  for (const flag of FLAGS) linked[flag] = shown.has(flag);
  for (const unit of UNITS) linked[unit] ||= prefs[unit];
  linked.theme = asTheme(given.get("theme")) ?? prefs.theme;
  linked.camera = asLook(given.get("camera")?.split(",").map(Number) ?? []);
  linked.options = Object.fromEntries([...given].filter(([key]) => OPTION.test(key)));
  const numbers = given.get("q")?.split(",").map(Number) ?? null;
  return { linked, positions: numbers?.every(Number.isFinite) ? numbers : null };
}

export function write(state: Readonly<State>): string {
  const parts: [string, string][] = [];
  if (state.draft) parts.push(["dh-table", JSON.stringify(state.draft)]);
  else parts.push(["robot", state.robot]);
  parts.push(["panel", state.panel]);
  if (state.base) parts.push(["base", state.base]);
  if (state.tip) parts.push(["tip", state.tip]);
  if (state.model) parts.push(["q", state.model.joints.map((joint) => state.positions[joint.name] ?? 0).join(",")]);
  if (state.target) parts.push(["target", JSON.stringify(state.target)]);
  if (state.inverse) parts.push(["ik", JSON.stringify(state.inverse)]);
  const worked = writtenAs(state.writing);
  if (worked !== writtenAs(FIRST.writing)) parts.push(["worked", worked]);
  if (state.motion) parts.push(["motion", JSON.stringify(state.motion)]);
  if (state.scene.name) parts.push(["scene", state.scene.name]);
  else if (state.scene.objects.length) parts.push(["objects", JSON.stringify(state.scene.objects)]);
  const shown = FLAGS.filter((flag) => state[flag]);
  if (shown.length) parts.push(["show", shown.join(",")]);
  if (state.theme !== "auto") parts.push(["theme", state.theme]);
  if (state.camera) parts.push(["camera", [...state.camera.eye, ...state.camera.at].join(",")]);
  parts.push(...Object.entries(state.options).sort());
  return "#" + parts.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
}

/** Keep the address bar as the state is; another robot, panel or exercise is a step that the browser's Back undoes. */
export function mirror(
  store: Store<State>,
  restore: (address: Address) => void,
  keep: (hash: string, title: string) => void,
): void {
  let timer = 0;
  let written = location.hash;
  let place = placeOf(store.value);
  const update = () => {
    const { model, robot, draft, loading } = store.value;
    if (loading || !model || model.name !== (draft ? null : robot)) return;
    const hash = write(store.value);
    keep(hash, model.title);
    if (hash === written) return;
    const step = placeOf(store.value) !== place;
    place = placeOf(store.value);
    written = hash;
    if (step) history.pushState(null, "", hash);
    else history.replaceState(null, "", hash);
  };
  store.watch(
    [
      "panel",
      "robot",
      "draft",
      "base",
      "tip",
      "target",
      "inverse",
      "writing",
      "motion",
      "scene",
      "positions",
      "model",
      "loading",
      "options",
      "theme",
      "camera",
      ...FLAGS,
    ],
    () => {
      clearTimeout(timer);
      timer = window.setTimeout(update, WRITE_AFTER);
    },
  );
  const show = () => {
    clearTimeout(timer);
    written = location.hash;
    restore(read(location.hash, store.value));
    place = placeOf(store.value);
  };
  const follow = () => {
    if (location.hash !== written) show();
  };
  window.addEventListener("popstate", follow);
  window.addEventListener("hashchange", follow);
  window.addEventListener(AGAIN, show);
}

/** Show what a link says, also if it is still in the address bar since the state is ahead of it. */
export function goTo(hash: string): void {
  if (location.hash === hash) window.dispatchEvent(new Event(AGAIN));
  else location.hash = hash;
}

function placeOf({ panel, robot, options }: Readonly<State>): string {
  return `${panel} ${robot} ${options["exercises.task"]}`;
}

/** Options as far as the panel can show them; whether their values go together is for the service to say. */
function inverseOptions(given: unknown): InverseOptions | null {
  if (typeof given !== "object" || given === null) return null;
  const { task, ...rest } = given as InverseOptions;
  const wanted = Array.isArray(task) ? DIRECTIONS.filter((direction) => task.includes(direction)) : [];
  return wanted.length ? { ...rest, task: wanted } : rest;
}

/** `jacobian,full,values`: the part of the worked solution, and what is written otherwise than usual. */
function writtenAs({ part, notation, symbolic }: Writing): string {
  return [part, notation === "full" && "full", !symbolic && "values"].filter(Boolean).join(",");
}

function writing(words: readonly string[]): Writing {
  const part = words.find((word) => PARTS.includes(word)) as Writing["part"] | undefined;
  return {
    part: part ?? FIRST.writing.part,
    notation: words.includes("full") ? "full" : "short",
    symbolic: !words.includes("values"),
  };
}

function json<T>(text: string | null): T | null {
  try {
    return text === null ? null : (JSON.parse(text) as T);
  } catch {
    return null;
  }
}
