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
import { followTheme, furnish, keySwitch } from "./page.ts";
import type { Studio } from "./panels/panel.ts";
import { showPart } from "./panels/robot/index.ts";
import { preferred } from "./prefs.ts";
import { Loader } from "./robot/load.ts";
import { showBodies } from "./scene/bodies.ts";
import { followContacts } from "./scene/contacts.ts";
import { showScene } from "./scene/layer.ts";
import { followFiles, followStored } from "./scene/stored.ts";
import { initial } from "./state.ts";
import { Store } from "./store.ts";
import { askForKey, listenForHelp } from "./ui/dialogs.ts";
import { element } from "./ui/dom.ts";
import { followCamera } from "./view/looking.ts";
import { mark } from "./view/marks.ts";
import { View } from "./view/view.ts";

const place = (id: string): HTMLElement => document.getElementById(id)!;

function start(): void {
  const prefs = preferred();
  const { linked, positions } = read(location.hash, prefs);
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
  store.watch(["positions"], ({ model, positions: wanted }) => model?.place(wanted));
  if (view) {
    followCamera(view, store);
    store.watch(["model"], measure);
    store.watch(["dark"], () => view.dress());
    mark(view, store);
    showScene(view, store, api);
    showBodies(view, store, api);
  }
  followContacts(store, api);
  followStored(store, api);
  followFiles(store, api);
  if (isEmbedded) embed(place("view").parentElement!, store);
  else furnishAll(studio, keyTool);
  loader.follow(positions);
  mirror(store, (address) => {
    loader.startAt(address.positions);
    const { robot, draft } = store.value;
    const isSame = address.linked.robot === robot && JSON.stringify(address.linked.draft) === JSON.stringify(draft);
    store.set(isSame ? { ...address.linked, robot, draft } : address.linked);
    const { model } = store.value;
    if (isSame && model)
      store.set({ positions: model.complete(address.positions, model.ends.base_frame, model.ends.tip_frame) });
  });
  // For the console, and for scripts that drive the page.
  Object.assign(globalThis, { studio });
}

/** All that stands around the picture. */
function furnishAll(studio: Studio, keyTool: HTMLElement): void {
  const [tabs, panel, heading, marks, tools] = ["tabs", "panel", "heading", "marks", "tools"].map(place);
  furnish({ tabs: tabs!, panel: panel!, heading: heading!, marks: marks!, tools: tools! }, studio);
  divide(place("divider"), place("main"), studio.store);
  tools!.prepend(keyTool);
  listenForHelp();
  acceptDrops(place("drop"), (panelOfFile) => {
    if (panelOfFile === "robot") showPart("upload");
    studio.store.set({ panel: "" });
    studio.store.set({ panel: panelOfFile });
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
        "This browser shows no 3-D pictures (WebGL is off). The numbers work all the same.",
      ),
    );
    return null;
  }
}

start();
