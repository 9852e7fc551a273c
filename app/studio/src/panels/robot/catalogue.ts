/** The robots that the service has, to search and to pick from. */

import { asProblem } from "../../api.ts";
import type { RobotSummary } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Studio } from "../panel.ts";

export function catalogue(host: HTMLElement, { api, store }: Studio): () => void {
  const stop = new AbortController();
  const problem = new ProblemView();
  const list = element("ul", { class: "robots" });
  const count = element("p", { class: "muted small", role: "status" });
  let robots: RobotSummary[] = [];
  const search = element("input", {
    type: "search",
    class: "search",
    placeholder: "Search by name or description",
    "aria-label": "Search the robots",
    oninput: () => show(),
  });
  const show = () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = robots.filter((robot) =>
      words.every((word) => `${robot.name} ${robot.description} ${robot.format}`.toLowerCase().includes(word)),
    );
    count.textContent = words.length ? `${found.length} of ${robots.length} robots` : `${robots.length} robots`;
    list.replaceChildren(...found.map((robot) => entry(robot, store.value.robot, () => pick(robot.name))));
  };
  const pick = (name: string) => store.set({ robot: name, draft: null, base: null, tip: null, target: null });
  host.append(search, count, list, problem.host);
  const load = async () => {
    try {
      const { robots: found } = await api.get<{ robots: RobotSummary[] }>("v1/robots", stop.signal);
      problem.show(null);
      found.sort((a, b) => (a.source === b.source ? 0 : a.source === "uploaded" ? -1 : 1));
      if (JSON.stringify(found) === JSON.stringify(robots)) return;
      const isFirst = robots.length === 0;
      robots = found;
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
      element("span", { class: "robot-name" }, robot.name, marks && element("span", { class: "mark" }, marks)),
      element("span", { class: "robot-description", title: robot.description }, robot.description || "No description"),
    ),
  );
}
