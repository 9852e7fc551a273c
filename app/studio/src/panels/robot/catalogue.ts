/** The robots that the service has, to search and to pick from. */

import { asProblem } from "../../api.ts";
import JOINTS from "../../../thumbnails/joints.json" with { type: "json" };
import { t } from "../../texts/index.ts";
import type { RobotSummary } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { neutral, thumbnail } from "../../ui/thumbnail.ts";
import type { Studio } from "../panel.ts";
import { groups, titled, values, type Wanted } from "./groups.ts";

export function catalogue(host: HTMLElement, { api, store }: Studio): () => void {
  const stop = new AbortController();
  const problem = new ProblemView();
  const list = element("div", { class: "robots" });
  const count = element("p", { class: "muted small", role: "status" });
  let robots: RobotSummary[] = [];
  const search = element("input", {
    type: "search",
    class: "search",
    placeholder: t("Search by name or description"),
    "aria-label": t("Search the robots"),
    oninput: () => show(),
  });
  const filters = new Filters(() => show());
  const show = () => {
    const found = groups(robots, JOINTS, { words: search.value, ...filters.values });
    const shown = found.reduce((sum, group) => sum + group.robots.length, 0);
    count.textContent =
      shown === robots.length
        ? t("{shown} robots", { shown })
        : t("{shown} of {length} robots", { shown, length: robots.length });
    list.replaceChildren(
      ...found.flatMap(({ title, robots: members }) => [
        element("h3", { class: "robots-kind" }, title),
        element("ul", {}, ...members.map((robot) => entry(robot, store.value.robot, () => pick(robot.name)))),
      ]),
    );
  };
  const pick = (name: string) => store.set({ robot: name, draft: null, base: null, tip: null, target: null });
  host.append(search, filters.host, count, list, problem.host);
  const load = async () => {
    try {
      const { robots: found } = await api.get<{ robots: RobotSummary[] }>("v1/robots", stop.signal);
      problem.show(null);
      if (JSON.stringify(found) === JSON.stringify(robots)) return;
      const isFirst = robots.length === 0;
      robots = found;
      filters.offer(values(found, JOINTS));
      keepingPlace(list, show);
      if (isFirst) reveal(list);
    } catch (error) {
      if (!stop.signal.aborted) problem.show(asProblem(error));
    }
  };
  // What another page has added or removed meanwhile is there when somebody returns to this one.
  const back = () => {
    if (document.visibilityState === "visible") void load();
  };
  document.addEventListener("visibilitychange", back, { signal: stop.signal });
  window.addEventListener("focus", back, { signal: stop.signal });
  void load();
  const unwatch = store.watch(["robot"], ({ robot }) => {
    for (const made of list.querySelectorAll("button"))
      made.setAttribute("aria-current", String(made.dataset["robot"] === robot));
  });
  return () => {
    stop.abort();
    unwatch();
  };
}

type Filter = "joints" | "kind" | "maker";

/** What there is to choose from beside the words. */
class Filters {
  readonly values: Omit<Wanted, "words"> = { joints: "", kind: "", maker: "" };
  readonly #selects: Record<Filter, HTMLSelectElement>;
  readonly host: HTMLElement;

  constructor(changed: () => void) {
    const made = (filter: Filter, label: string) => {
      const select = element("select", {
        class: "select",
        "aria-label": label,
        onchange: () => {
          this.values[filter] = select.value;
          changed();
        },
      });
      return select;
    };
    this.#selects = {
      joints: made("joints", t("Joints")),
      kind: made("kind", t("Kind")),
      maker: made("maker", t("Maker")),
    };
    this.host = element("div", { class: "filters" }, ...Object.values(this.#selects));
  }

  offer(found: Record<Filter, string[]>): void {
    const any = { joints: t("Any joints"), kind: t("Any kind"), maker: t("Any maker") };
    for (const filter of ["joints", "kind", "maker"] as const) {
      const text = (value: string) => (filter === "joints" ? t("{value} joints", { value }) : titled(value));
      this.#selects[filter].replaceChildren(
        element("option", { value: "" }, any[filter]),
        ...found[filter].map((value) => element("option", { value }, text(value))),
      );
      this.#selects[filter].value = this.values[filter];
    }
  }
}

/** Build the list anew, with what is in sight and the focus as they were. */
function keepingPlace(list: HTMLElement, build: () => void): void {
  const { scrollTop } = list;
  const focused = list.contains(document.activeElement)
    ? (document.activeElement as HTMLElement).dataset["robot"]
    : null;
  build();
  list.scrollTop = scrollTop;
  if (focused) list.querySelector<HTMLElement>(`[data-robot="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
}

/** Scroll the list, and nothing around it, to the robot on the screen. */
function reveal(list: HTMLElement): void {
  const chosen = list.querySelector<HTMLElement>("[aria-current=true]");
  if (chosen) list.scrollTop = chosen.offsetTop - list.offsetTop - list.clientHeight / 2 + chosen.offsetHeight / 2;
}

function entry(robot: RobotSummary, chosen: string, onclick: () => void): HTMLElement {
  const marks = [robot.source === "uploaded" && "uploaded", robot.format === "dh" && "DH"].filter(Boolean).join(", ");
  return element(
    "li",
    {},
    element(
      "button",
      {
        type: "button",
        class: "robot",
        "data-robot": robot.name,
        "aria-current": String(robot.name === chosen),
        onclick,
      },
      robot.source === "uploaded" ? neutral() : thumbnail(robot.name),
      element("span", { class: "robot-name" }, robot.name, marks && element("span", { class: "mark" }, marks)),
      element(
        "span",
        { class: "robot-description", title: robot.description },
        robot.description || t("No description"),
      ),
    ),
  );
}
