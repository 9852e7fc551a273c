/** The first screen, where the address names no robot: six doors, and where the person was. */

import { drop } from "../panels/robot/upload.ts";
import { showPart } from "../panels/robot/index.ts";
import type { Studio } from "../panels/panel.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";
import type { RobotSummary } from "../types.ts";
import { button, element } from "../ui/dom.ts";
import { neutral, thumbnail } from "../ui/thumbnail.ts";
import { tourButton } from "../tour/index.ts";
import { isSeen } from "../tour/seen.ts";
import { last } from "./last.ts";

interface Door {
  /** Names and titles; the first of these that the service has. */
  robots: Readonly<Record<string, string>>;
  text: string;
}

const DOORS: readonly Door[] = [
  { robots: { planar_2r: t("Two links") }, text: t("An arm in the plane: each formula fits on one line.") },
  { robots: { scara: "SCARA" }, text: t("Four joints, one of them a slide.") },
  {
    robots: { anthropomorphic_wrist: t("Arm with a wrist") },
    text: t("Anthropomorphic, with a spherical wrist: eight ways to one pose."),
  },
  { robots: { ur5e: "UR5e", ur5: "UR5" }, text: t("Universal Robots: six axes, in many laboratories.") },
  { robots: { panda: "Panda" }, text: t("Seven axes: one more than a pose needs.") },
];

/** Fill the place of the first screen, and show it while the state says so. */
export function start(host: HTMLElement, studio: Studio): void {
  const { store } = studio;
  const goOn = element("p", { class: "go-on" });
  const tour = element(
    "p",
    { class: "tour-offer", hidden: isSeen() },
    tourButton(studio, t("New here? Take the tour"), "button"),
  );
  const doors = element("ul", { class: "doors" });
  const page = element(
    "div",
    { class: "start-page" },
    element("h1", {}, t("Which robot?")),
    element(
      "p",
      { class: "muted" },
      t("Move it, read its pose, solve its inverse, plan its motion: with every number checked."),
    ),
    goOn,
    tour,
    doors,
    element(
      "p",
      { class: "bar" },
      element("a", { href: "#panel=robot", onclick: () => showPart("catalogue") }, t("All robots of the catalogue")),
      button(t("Type a DH table"), () => choose("table")),
      element("a", { href: "#panel=exercises" }, t("Exercises")),
    ),
  );
  const choose = (part: "upload" | "table") => {
    showPart(part);
    leave(store, "robot");
  };
  const build = (has: ReadonlySet<string> | null) => {
    const focused = [...doors.children].findIndex((door) => door.contains(document.activeElement));
    doors.replaceChildren(...DOORS.map((door) => card(door, has)), own(choose));
    doors.children[focused]?.querySelector<HTMLElement>(".door")?.focus();
  };
  host.append(page);
  store.watch(["starting"], ({ starting }) => {
    const hasFocus = host.contains(document.activeElement);
    host.hidden = !starting;
    document.documentElement.toggleAttribute("data-starting", starting);
    if (!starting && hasFocus) document.getElementById("panel")?.focus();
    if (!starting) return;
    tour.hidden = isSeen();
    document.title = "Gelenk";
    goOn.replaceChildren(...continued());
    if (doors.childElementCount) return;
    build(null);
    void studio.api
      .get<{ robots: RobotSummary[] }>("v1/robots")
      .then(({ robots }) => build(new Set(robots.map(({ name }) => name))))
      .catch(() => {}); // the cards are there; what fails says so when a robot is chosen
  });
  store.watch(["robot", "draft"], ({ robot, draft }) => {
    if (robot !== "" || draft !== null) store.set({ starting: false });
  });
}

/** Open a panel, in the place of the first screen too; a robot that has stayed behind that is named again. */
export function leave(store: Store<State>, panel: string): void {
  const { starting, model, table } = store.value;
  const draft = model?.name === null ? (table?.dh ?? null) : null;
  const behind = starting && { robot: model?.name ?? "", draft };
  store.set({ starting: false, panel: "", ...behind });
  store.set({ panel });
}

function continued(): Node[] {
  const kept = last();
  if (!kept) return [];
  return [
    element(
      "a",
      { class: "button primary", href: kept.hash },
      t("Go on where you were: {title}", { title: kept.title }),
    ),
  ];
}

function card({ robots, text }: Door, has: ReadonlySet<string> | null): HTMLElement {
  // Before the service has said what it has, the last one: it has been there longest.
  const names = Object.keys(robots);
  const name = names.find((robot) => has?.has(robot)) ?? names.at(-1)!;
  return element(
    "li",
    {},
    element("a", { class: "door", href: `#robot=${name}&panel=pose` }, ...inside(thumbnail(name), robots[name]!, text)),
  );
}

/** A description of one's own: chosen here, or dropped anywhere on the page. */
function own(choose: (part: "upload") => void): HTMLElement {
  const picker = element("input", {
    type: "file",
    accept: ".urdf,.xacro,.xml,.zip",
    hidden: true,
    onchange: () => {
      const file = picker.files?.[0];
      if (!file) return;
      drop(file);
      picker.value = "";
      choose("upload");
    },
  });
  const made = button("", () => picker.click(), { class: "door" });
  made.append(
    ...inside(
      neutral(),
      t("Your own file"),
      t("A URDF, xacro or MJCF, or a zip with its meshes. Or drop it on this page."),
    ),
  );
  return element("li", {}, made, picker);
}

function inside(picture: HTMLElement, title: string, text: string): HTMLElement[] {
  return [picture, element("span", { class: "door-title" }, title), element("span", { class: "door-text" }, text)];
}
