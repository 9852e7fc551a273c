/** The studio: wires state, service, view and panels. */

import "./styles/studio.css";
// Style sheets are imported by what is loaded at once: the bundler has later chunks bring none.
import "katex/dist/katex.min.css";

import { mirror, read } from "./address.ts";
import { Api } from "./api.ts";
import { Connection } from "./connection.ts";
import { divide } from "./divider.ts";
import { acceptDrops } from "./dropping.ts";
import { embed, isEmbedded } from "./embed.ts";
import { Key } from "./key.ts";
import { undoing } from "./history/controls.ts";
import { Steps } from "./history/steps.ts";
import { followTheme, furnish, keySwitch } from "./page.ts";
import type { Studio } from "./panels/panel.ts";
import { showPart } from "./panels/robot/index.ts";
import { presenting } from "./present.ts";
import { preferred } from "./prefs.ts";
import { Loader } from "./robot/load.ts";
import { showBodies } from "./scene/bodies.ts";
import { followContacts } from "./scene/contacts.ts";
import { showScene } from "./scene/layer.ts";
import { followFiles, followStored } from "./scene/stored.ts";
import { keepLast } from "./start/last.ts";
import { leave, start as choose } from "./start/start.ts";
import { FIRST, initial, isNone } from "./state.ts";
import { Store } from "./store.ts";
import { t, translatePage } from "./texts/index.ts";
import { askForKey, listenForHelp } from "./ui/dialogs.ts";
import { element } from "./ui/dom.ts";
import { drawFigures } from "./view/figure.ts";
import { Grabbing } from "./view/grab.ts";
import { followCamera } from "./view/looking.ts";
import { mark } from "./view/marks.ts";
import { castShadow } from "./view/shadow.ts";
import { TableLayer } from "./view/table.ts";
import { View } from "./view/view.ts";

const place = (id: string): HTMLElement => document.getElementById(id)!;

function start(): void {
  translatePage();
  const prefs = preferred();
  const { linked, positions } = read(location.hash, prefs);
  if (isEmbedded && isNone(linked)) linked.robot = FIRST.robot;
  const store = new Store(initial(linked, prefs.width));
  const key = new Key(askForKey, ({ isWanted }) => (keyTool.hidden = !isWanted));
  const keyTool = keySwitch(key);
  const root = new URL(".", document.baseURI);
  const api = new Api(root, key, new Connection(new URL("healthz", root).href, () => loader.again()));
  followTheme(store);
  const view = makeView(place("view"));
  const studio: Studio = { store, api, view };
  const measure = () => view && store.set({ unit: view.unit });
  const loader = new Loader(api, store, () => {
    view?.settle();
    measure();
    store.set({ meshes: store.value.meshes + 1 });
  });
  // Before whoever makes more of a change.
  const steps = isEmbedded ? null : new Steps(store, (doc, at) => loader.restore(doc, at));
  store.watch(["positions"], ({ model, positions: wanted }) => model?.place(wanted));
  if (view) {
    drawFigures(view, store);
    castShadow(view, store);
    followCamera(view, store);
    store.watch(["model"], measure);
    store.watch(["dark"], () => view.dress());
    mark(view, store);
    const table = new TableLayer(view, store);
    if (!isEmbedded) new Grabbing(view, store, table);
    showScene(view, store, api);
    showBodies(view, store, api);
  }
  followContacts(store, api);
  followStored(store, api);
  followFiles(store, api);
  if (isEmbedded) embed(place("view").parentElement!, studio);
  else furnishAll(studio, keyTool, steps!);
  loader.follow(positions);
  mirror(
    store,
    ({ linked: wanted, positions: at }) => loader.restore({ ...wanted, starting: !isEmbedded && isNone(wanted) }, at),
    isEmbedded ? () => {} : keepLast,
  );
  // For the console, and for scripts that drive the page.
  Object.assign(globalThis, { studio });
}

/** All that stands around the picture. */
function furnishAll(studio: Studio, keyTool: HTMLElement, steps: Steps): void {
  const [tabs, panel, heading, marks, tools] = ["tabs", "panel", "heading", "marks", "tools"].map(place);
  furnish({ tabs: tabs!, panel: panel!, heading: heading!, marks: marks!, tools: tools! }, studio);
  divide(place("divider"), place("main"), studio.store);
  tools!.prepend(keyTool);
  heading!.append(undoing(steps, place("view").parentElement!));
  marks!.append(presenting(place("view").parentElement!, studio.store));
  choose(place("start"), studio);
  place("brand").addEventListener("click", () => studio.store.set({ starting: true }));
  listenForHelp();
  acceptDrops(place("drop"), (panelOfFile) => {
    if (panelOfFile === "robot") showPart("upload");
    leave(studio.store, panelOfFile);
  });
}

function makeView(host: HTMLElement): View | null {
  try {
    return new View(host);
  } catch {
    host.append(
      element(
        "p",
        { class: "no-view" },
        t("This browser shows no 3-D pictures (WebGL is off). The numbers work all the same."),
      ),
    );
    return null;
  }
}

start();
