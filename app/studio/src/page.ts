/** The page around the panels: tabs, the robot's chain above the picture, what is drawn in it, light and dark. */

import type { Key } from "./key.ts";
import { PANELS } from "./panels/index.ts";
import type { Studio } from "./panels/panel.ts";
import { shownChain } from "./robot/chain.ts";
import { prefer } from "./prefs.ts";
import type { RobotModel } from "./robot/model.ts";
import type { State } from "./state.ts";
import type { Store } from "./store.ts";
import { share } from "./share.ts";
import { askForKey, showShortcuts } from "./ui/dialogs.ts";
import { button, element, toggle } from "./ui/dom.ts";
import { SIDES } from "./view/looking.ts";

const MARKS = [
  { key: "frames", text: "Frames", title: "The frame of every link" },
  { key: "axes", text: "Axes", title: "The axes of the joints" },
  { key: "names", text: "Names", title: "The names of the links" },
  { key: "dh", text: "DH frames", title: "The frames of the chain's DH table, with a and d" },
  { key: "bodies", text: "Bodies", title: "What contacts are computed of" },
] as const;

const DARK = matchMedia("(prefers-color-scheme: dark)");

export interface Places {
  tabs: HTMLElement;
  panel: HTMLElement;
  heading: HTMLElement;
  marks: HTMLElement;
  tools: HTMLElement;
}

/** Fill the places of the page, and keep them as the state is. */
export function furnish(places: Places, studio: Studio): void {
  tabs(places, studio);
  heading(places.heading, studio.store);
  marks(places.marks, studio);
  const help = button("Help", showShortcuts, { class: "tool", title: "What the keyboard does (?)" });
  const pages = { handbook: "Handbook", docs: "API" };
  const links = Object.entries(pages).map(([href, name]) => element("a", { class: "tool", href }, name));
  places.tools.append(help, themeSwitch(studio), ...links);
}

function tabs({ tabs: host, panel }: Places, studio: Studio): void {
  const { store } = studio;
  const made = PANELS.map((entry, index) => {
    const tab = button(entry.title, () => store.set({ panel: entry.id }), {
      class: "tab",
      role: "tab",
      id: `tab-${entry.id}`,
      "aria-controls": "panel",
      onkeydown: (event: KeyboardEvent) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        const next = (index + step + PANELS.length) % PANELS.length;
        store.set({ panel: PANELS[next]!.id });
        made[next]!.focus();
      },
    });
    return tab;
  });
  host.append(...made);
  let close: () => void = () => {};
  store.watch(["panel"], ({ panel: wanted }) => {
    close();
    close = () => {};
    panel.replaceChildren();
    // Without a name none opens: a panel that is opened twice would do twice what it does at once, such as an upload.
    if (wanted === "") return;
    const chosen = PANELS.find(({ id }) => id === wanted) ?? PANELS[0]!;
    panel.scrollTop = 0;
    panel.setAttribute("aria-labelledby", `tab-${chosen.id}`);
    for (const [index, tab] of made.entries()) {
      const isChosen = PANELS[index] === chosen;
      tab.setAttribute("aria-selected", String(isChosen));
      tab.tabIndex = isChosen ? 0 : -1;
      if (isChosen) tab.scrollIntoView({ block: "nearest", inline: "nearest" });
    }
    close = chosen.open(panel, studio);
  });
}

/** The robot's name, and the ends of the chain that every panel speaks of. */
function heading(host: HTMLElement, store: Store<State>): void {
  const name = element("h1");
  const pick = button("", () => store.set({ panel: "robot" }), { class: "robot-pick", title: "Choose another robot" });
  pick.append(name);
  const base = frameSelect("Base frame", (frame) => store.set({ base: frame }));
  const tip = frameSelect("Tip frame", (frame) => store.set({ tip: frame }));
  const status = element("p", { class: "status", role: "status" });
  host.append(
    pick,
    element("span", { class: "chain" }, base, element("span", { "aria-hidden": "true" }, "→"), tip),
    status,
  );
  store.watch(["model"], ({ model }) => {
    if (!model) return;
    name.textContent = model.title;
    document.title = `${model.title} · Gelenk`;
    for (const select of [base, tip])
      select.replaceChildren(...model.links.map((link) => element("option", { value: link }, link)));
  });
  store.watch(["model", "base", "tip"], (state) => {
    const chain = shownChain(state);
    if (!chain) return;
    base.value = chain.base;
    tip.value = chain.tip;
  });
  store.watch(["loading", "failure", "model", "meshes", "received"], ({ loading, failure, model, received }) => {
    status.textContent = loading
      ? "Loading …"
      : failure
        ? "Not on the screen: the panel Robot says why."
        : model
          ? arriving(model.meshes, received)
          : "";
  });
}

/** How far the meshes have come; nothing once they are there. */
function arriving({ wanted, shown, failed }: RobotModel["meshes"], received: number): string {
  if (shown + failed.length >= wanted) return "";
  return `Meshes: ${shown} of ${wanted}, ${(received / 1e6).toFixed(1)} MB …`;
}

function frameSelect(title: string, choose: (frame: string) => void): HTMLSelectElement {
  const select = element("select", {
    class: "select plain",
    "aria-label": title,
    title,
    onchange: () => choose(select.value),
  });
  return select;
}

function marks(host: HTMLElement, studio: Studio): void {
  const { store, view } = studio;
  const made = MARKS.map(({ key, text, title }) => {
    const flip = toggle(text, title, () => store.set({ [key]: !store.value[key] }));
    store.watch([key], (state) => flip.setAttribute("aria-pressed", String(state[key])));
    return flip;
  });
  const shared = button("Share", () => share(studio), { class: "toggle", title: "A link, a frame, the picture" });
  host.append(...made);
  if (!view) return void host.append(shared);
  host.append(button("Fit", () => view.fit(), { class: "toggle", title: "Look at the whole robot (double click)" }));
  for (const { text, title, from } of SIDES)
    host.append(button(text, () => view.from(from), { class: "toggle", title }));
  host.append(shared);
}

/** Follow the system, or be light or dark whatever it says; first of all, because others read the colours. */
export function followTheme(store: Store<State>): void {
  const follow = () => {
    const { theme } = store.value;
    if (theme === "auto") delete document.documentElement.dataset["theme"];
    else document.documentElement.dataset["theme"] = theme;
    store.set({ dark: theme === "auto" ? DARK.matches : theme === "dark" });
  };
  store.watch(["theme"], follow);
  DARK.addEventListener("change", follow);
}

/** Another key in the place of the one that is used; only where the service wants any. */
export function keySwitch(key: Key): HTMLElement {
  const change = async () => {
    const text = await askForKey(
      key.isSet ? "Calls are sent with a key; this one takes its place." : "None is used yet.",
    );
    if (text === null) return;
    key.set(text);
    location.reload(); // everything is asked again; the address bar has what is shown
  };
  const flip = button("Key", () => void change(), { class: "tool", title: "Use another key of the service" });
  flip.hidden = !key.isWanted;
  return flip;
}

function themeSwitch({ store }: Studio): HTMLElement {
  const change = () => {
    const wanted = store.value.dark ? "light" : "dark";
    // What the system has anyhow is followed, also when that changes.
    prefer(store, { theme: wanted === (DARK.matches ? "dark" : "light") ? "auto" : wanted });
  };
  const flip = button("", change, { class: "tool" });
  store.watch(["dark"], ({ dark }) => {
    flip.textContent = dark ? "Light" : "Dark";
    flip.title = `Change to ${dark ? "light" : "dark"} colours`;
  });
  return flip;
}
