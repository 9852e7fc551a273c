/** What is compared with the robot on the screen: its table in the other convention, another robot, a typed table. */

import JOINTS from "../../../thumbnails/joints.json" with { type: "json" };
import { asProblem } from "../../api.ts";
import type { State } from "../../state.ts";
import { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import type { DhTable, Pose, RobotSummary } from "../../types.ts";
import { Choice, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { chosenOf, isSame, UNITS } from "../../ui/quantity.ts";
import type { Studio } from "../panel.ts";
import { groups } from "../robot/groups.ts";
import { Places } from "../robot/places.ts";
import { PRESETS } from "../robot/presets.ts";
import { TableRows } from "../robot/rows.ts";
import { uploads } from "../robot/upload.ts";
import type { Second } from "./second.ts";
import { type Wanted, wanted, wanting } from "./wanted.ts";

type Part = Wanted["with"];

/** The part that the choice opens; fills the host, and returns how to undo that. */
type Opening = (host: HTMLElement, studio: Studio, second: Second) => () => void;

const PARTS: readonly { value: Part; text: string }[] = [
  { value: "convention", text: t("Other convention") },
  { value: "robot", text: t("Another robot") },
  { value: "table", text: t("Own table") },
];
const OPENINGS: Record<Part, Opening> = { convention: conventions, robot: robots, table: tables };

export function choice(host: HTMLElement, studio: Studio, second: Second): () => void {
  const { store } = studio;
  const body = element("div", { class: "part" });
  const choose = (value: Part) => {
    const { table } = wanted(store.value);
    const first = second.facts.value.tables?.first.dh ?? PRESETS[0]!.table;
    // A table of one's own begins as the first one's.
    const typed = value === "table" && !table ? { table: JSON.stringify(first) } : {};
    store.set(wanting(store.value, { with: value === "convention" ? null : value, ...typed }));
  };
  const parts = new Choice(t("What is compared with it"), PARTS, choose);
  host.append(parts.host, body);
  let shown: Part | null = null;
  let close = () => {};
  const stop = store.watch(["options"], (state) => {
    const { with: part } = wanted(state);
    parts.show(part);
    if (part === shown) return;
    close();
    body.replaceChildren();
    shown = part;
    close = OPENINGS[part](body, studio, second);
  });
  return () => {
    stop();
    close();
  };
}

function conventions(host: HTMLElement): () => void {
  const text = t(
    "The same arm by a table of the other convention. Standard has frame i at the end of link i, on the axis of joint i + 1; modified at its beginning, on the axis of joint i. So the frames differ, and the tips meet.",
  );
  host.append(element("p", { class: "muted small" }, text));
  return () => {};
}

/** Those that the service has, and a file that becomes one of them. */
function robots(host: HTMLElement, { api, store, view }: Studio): () => void {
  const stop = new AbortController();
  const problem = new ProblemView();
  const choose = (robot: string) => store.set(wanting(store.value, { robot: robot || null, q: null }));
  const select = element("select", { class: "select", id: "compare-robot", onchange: () => choose(select.value) });
  const own = element("details", {}, element("summary", {}, t("Upload a file")));
  host.append(element("label", { class: "field", for: "compare-robot" }, t("Robot")), select, own, problem.host);
  // What is uploaded becomes the second robot, not the one on the screen.
  const uploaded = new Store<State>({ ...store.value, robot: "" });
  const close = uploads(own, { api, store: uploaded, view });
  const load = async () => {
    try {
      const { robots: found } = await api.get<{ robots: RobotSummary[] }>("v1/robots", stop.signal);
      offer(select, found);
      select.value = wanted(store.value).robot;
    } catch (error) {
      if (!stop.signal.aborted) problem.show(asProblem(error));
    }
  };
  const stops = [
    close,
    () => stop.abort(),
    store.watch(["options"], (state) => (select.value = wanted(state).robot)),
    uploaded.watch(["robot"], ({ robot }) => {
      void load();
      if (robot) choose(robot);
    }),
  ];
  return () => stops.forEach((each) => each());
}

function offer(select: HTMLSelectElement, found: readonly RobotSummary[]): void {
  const all = groups(found, JOINTS, { words: "", joints: "", kind: "", maker: "" });
  select.replaceChildren(
    element("option", { value: "" }, t("Choose a robot")),
    ...all.map(({ title, robots: members }) =>
      element("optgroup", { label: title }, ...members.map(({ name }) => element("option", { value: name }, name))),
    ),
  );
}

/** A table to type, with what the service says at its cells. */
function tables(host: HTMLElement, { store }: Studio, second: Second): () => void {
  const now = () => wanted(store.value).table!;
  const edit = (table: DhTable) => store.set(wanting(store.value, { table: JSON.stringify(table) }));
  const units = () => store.value;
  const rows = new TableRows(
    (joints) => edit({ ...now(), joints }),
    units,
    () => {},
  );
  const places = new Places((end: "base" | "tool", pose: Pose | undefined) => {
    const { [end]: _, ...others } = now();
    edit(pose ? { ...others, [end]: pose } : others);
  }, units);
  const starts = element(
    "select",
    { class: "select", "aria-label": t("Start from a table"), onchange: () => start(starts.value) },
    element("option", { value: "" }, t("Start from …")),
    element("option", { value: "first" }, t("The table of the first")),
    ...PRESETS.map(({ title }, index) => element("option", { value: index }, title)),
  );
  const start = (value: string) => {
    const table = value === "first" ? second.facts.value.tables?.first.dh : PRESETS[Number(value)]?.table;
    starts.value = "";
    if (table) edit(structuredClone(table));
  };
  const conventions = [
    { value: "standard", text: t("Standard") },
    { value: "modified", text: t("Modified") },
  ] as const;
  // The numbers stay: whoever has copied a table may have taken it for one of the other convention.
  const convention = new Choice(t("Convention"), conventions, (chosen) => edit({ ...now(), convention: chosen }));
  host.append(
    element("div", { class: "bar" }, convention.host, element("span", { class: "spring" }), starts),
    rows.host,
    places.host,
  );
  let shown = chosenOf(store.value);
  let built = "";
  const stops = [
    store.watch(["options", ...UNITS], (state) => {
      const { table } = wanted(state);
      const text = JSON.stringify(table);
      if (!table || (text === built && isSame(shown, state))) return;
      const isKept = isSame(shown, state) && rows.update(table.joints);
      shown = chosenOf(state);
      if (!isKept) rows.build(table.joints);
      if (!isKept || built === "") places.build(table);
      built = text;
      convention.show(table.convention);
    }),
    second.facts.watch(["failure"], ({ failure }) => {
      const found = failure?.places ?? [];
      places.fail(rows.fail(found));
    }),
  ];
  return () => stops.forEach((each) => each());
}
