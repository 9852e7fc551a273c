/** The page around the panels: tabs, the robot's chain above the picture, what is drawn in it, light and dark. */

import type { Key } from "./key.ts";
import { PANELS } from "./panels/index.ts";
import type { Studio } from "./panels/panel.ts";
import { shownChain } from "./robot/chain.ts";
import { keep, prefer } from "./prefs.ts";
import type { RobotModel } from "./robot/model.ts";
import type { State } from "./state.ts";
import type { Store } from "./store.ts";
import { share } from "./share.ts";
import { language, t } from "./texts/index.ts";
import { askForKey, showShortcuts } from "./ui/dialogs.ts";
import { button, element, toggle } from "./ui/dom.ts";
import { tourButton } from "./tour/index.ts";
import { SIDES } from "./view/looking.ts";
import { Measuring } from "./view/measure.ts";

const MARKS = [
  { key: "frames", text: t("Frames"), title: t("The frame of every link") },
  { key: "axes", text: t("Axes"), title: t("The axes of the joints") },
  { key: "names", text: t("Names"), title: t("The names of the links") },
  { key: "dh", text: t("DH frames"), title: t("The frames of the chain's DH table, with a and d") },
  { key: "dimensions", text: t("Dimensions"), title: t("a, d, α and θ of all rows, with the DH frames") },
  { key: "bodies", text: t("Bodies"), title: t("What contacts are computed of") },
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
  const help = button(t("Help"), showShortcuts, { class: "tool", title: t("What the keyboard does (?)") });
  const pages = { handbook: t("Handbook"), docs: "API" };
  const links = Object.entries(pages).map(([href, name]) => element("a", { class: "tool", href }, name));
  places.tools.append(tourButton(studio, t("Tour"), "tool"), help, themeSwitch(studio), languageSwitch(), ...links);
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
  const pick = button("", () => store.set({ panel: "robot" }), {
    class: "robot-pick",
    title: t("Choose another robot"),
  });
  pick.append(name);
  const base = frameSelect(t("Base frame"), (frame) => store.set({ base: frame }));
  const tip = frameSelect(t("Tip frame"), (frame) => store.set({ tip: frame }));
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
      ? t("Loading …")
      : failure
        ? t("Not on the screen: the panel Robot says why.")
        : model
          ? arriving(model.meshes, received)
          : "";
  });
}

/** How far the meshes have come; nothing once they are there. */
function arriving({ wanted, shown, failed }: RobotModel["meshes"], received: number): string {
  if (shown + failed.length >= wanted) return "";
  return t("Meshes: {shown} of {wanted}, {received} MB …", { shown, wanted, received: (received / 1e6).toFixed(1) });
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
  const shared = button(t("Share"), () => share(studio), { class: "toggle", title: t("A link, a frame, the picture") });
  host.append(...made);
  if (!view) return void host.append(shared);
  host.append(
    button(t("Fit"), () => view.fit(), { class: "toggle", title: t("Look at the whole robot (double click)") }),
  );
  const measuring = new Measuring(view, store);
  const measure = toggle(t("Measure"), t("The distance of two points: of frames, or of what is drawn"), () => {
    measuring.flip();
    measure.setAttribute("aria-pressed", String(measuring.isOn));
  });
  const parallel = toggle(t("Parallel"), t("Parallel projection, as in drawings: what is far away is as large"), () =>
    store.set({ parallel: !store.value.parallel }),
  );
  store.watch(["parallel"], (state) => parallel.setAttribute("aria-pressed", String(state.parallel)));
  host.append(measure, parallel);
  host.before(measuring.host);
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
      key.isSet ? t("Calls are sent with a key; this one takes its place.") : t("None is used yet."),
    );
    if (text === null) return;
    key.set(text);
    location.reload(); // everything is asked again; the address bar has what is shown
  };
  const flip = button(t("Key"), () => void change(), { class: "tool", title: t("Use another key of the service") });
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
    flip.textContent = dark ? t("Light") : t("Dark");
    flip.title = dark ? t("Change to light colours") : t("Change to dark colours");
  });
  return flip;
}

/** To the other language, which is named in itself; everything is asked again, and the address bar has what is shown. */
function languageSwitch(): HTMLElement {
  // Each in its own language; the letters are part of the name that is read out.
  const [other, name] =
    language === "en" ? (["de", "DE: die Seite auf Deutsch"] as const) : (["en", "EN: the page in English"] as const);
  const change = () => {
    keep({ language: other });
    location.reload();
  };
  return button(other.toUpperCase(), change, { class: "tool", lang: other, title: name, "aria-label": name });
}
