/** Cell: what stands around the robot, and what of it the robot touches. */

import "../../styles/cell.css";

import { asProblem } from "../../api.ts";
import { shownChain } from "../../robot/chain.ts";
import { call } from "../../scene/contacts.ts";
import { ADDED, changed, EMPTY } from "../../scene/objects.ts";
import { keepScene, sceneNames, storedScene } from "../../scene/stored.ts";
import { t } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import { button, Choice, element, section, titled } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { column, UNITS, withUnit } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { ObjectFields } from "./fields.ts";
import { chosenObject, Handles } from "./handles.ts";
import { inFront, meshAdder } from "./meshes.ts";

export const cellPanel: Panel = {
  id: "cell",
  title: t("Cell"),
  open: (host, studio) => whileKept(host, studio, () => open(host, studio)),
};

function open(host: HTMLElement, studio: Studio): () => void {
  const { store, api, view } = studio;
  const request = new RequestView(api);
  const fields = new ObjectFields(store);
  const handles = view && new Handles(view, store);
  const modes = handles && dragModes(handles);
  const list = element("ul", { class: "objects" });
  const verdict = element("div", { class: "contacts", role: "status" });
  const problem = new ProblemView();
  const edited = titled(t("Object"), modes ? [modes] : [], fields.host);
  host.append(
    section(
      t("Scene"),
      element("div", { class: "bar" }, ...adders(studio), meshAdder(studio, problem)),
      list,
      kept(studio, problem),
    ),
    edited,
    section(t("Contact"), verdict, problem.host),
    request.host,
  );
  const stops = [
    store.watch(["scene", "chosen", "contacts"], () => list.replaceChildren(...entries(studio))),
    store.watch(["scene", "chosen", "model", ...UNITS], (state) => {
      edited.hidden = chosenObject(state) === null;
      fields.show();
    }),
    store.watch(["contacts", ...UNITS], () => verdict.replaceChildren(...told(studio))),
    store.watch(["refusal"], ({ refusal }) => problem.show(refusal)),
    store.watch(["scene", "positions", "model", "base", "tip"], (state) => {
      const chain = shownChain(state);
      if (chain?.path)
        request.show({ method: "POST", path: `${chain.path}/collisions`, body: call(chain, state.scene) });
    }),
    () => handles?.close(),
    () => store.set({ chosen: null }),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Buttons that add an object in front of the robot, and edit it. */
function adders({ store }: Studio): HTMLElement[] {
  return ADDED.map(({ kind, text, shape }) =>
    button(text, () => {
      const { scene, unit } = store.value;
      const { pose, ...added } = inFront(store.value, text.toLowerCase(), shape(unit));
      const object = kind === "half_space" ? added : { ...added, pose };
      store.set({ scene: changed(scene, [...scene.objects, object]), chosen: object.name });
    }),
  );
}

/** A line for each object; pressed it is edited, pressed again no longer. */
function entries({ store }: Studio): HTMLElement[] {
  const { scene, chosen, contacts } = store.value;
  const touched = new Set(contacts?.inCollision ? contacts.pairs.flatMap(({ a, b }) => [a, b]) : []);
  return scene.objects.map(({ name, shape, attached_to: frame }) => {
    const isChosen = name === chosen;
    const entry = button("", () => store.set({ chosen: isChosen ? null : name }), {
      class: "object",
      "aria-pressed": String(isChosen),
      "data-tone": touched.has(name) ? "bad" : null,
    });
    const about = frame ? t("{type}, on {frame}", { type: word(shape.type), frame }) : word(shape.type);
    entry.append(element("span", {}, name), element("span", { class: "muted small" }, about));
    return element("li", {}, entry);
  });
}

/** Choosing a scene that the service keeps, and keeping this one. */
function kept({ store, api }: Studio, problem: ProblemView): HTMLElement {
  const guarded = async (work: () => Promise<void>) => {
    try {
      await work();
      problem.show(null);
    } catch (error) {
      problem.show(asProblem(error));
    }
  };
  const chosen = element("select", {
    class: "select",
    "aria-label": t("Stored scenes"),
    onchange: () => void guarded(async () => store.set({ scene: await storedScene(api, chosen.value), chosen: null })),
  });
  const name = element("input", { class: "search", "aria-label": t("Name of the scene"), placeholder: t("Name") });
  const list = async () => {
    const names = await sceneNames(api);
    const none = element("option", { value: "", disabled: true, selected: true }, t("Stored scenes"));
    chosen.replaceChildren(none, ...names.map((each) => element("option", { value: each }, each)));
    const now = store.value.scene.name;
    if (now !== null && names.includes(now)) chosen.value = name.value = now;
  };
  const keep = async () => {
    store.set({ scene: await keepScene(api, name.value.trim(), store.value.scene) });
    await list();
  };
  void guarded(list);
  return element(
    "div",
    { class: "bar stored" },
    chosen,
    name,
    button(t("Store"), () => void guarded(keep), { title: t("Keep the scene under this name") }),
    button(t("Clear"), () => store.set({ scene: EMPTY, chosen: null }), { title: t("Begin with an empty scene") }),
  );
}

function dragModes(handles: Handles): HTMLElement {
  const options = [
    { value: "translate", text: t("Move") },
    { value: "rotate", text: t("Turn") },
  ] as const;
  const choice = new Choice<"translate" | "rotate">(t("Dragging in the picture"), options, (mode) => {
    handles.turnTo(mode);
    choice.show(mode);
  });
  choice.show("translate");
  return choice.host;
}

/** What is in contact, or nearest to it. */
function told({ store }: Studio): HTMLElement[] {
  const { contacts } = store.value;
  if (!contacts) return [];
  const { pairs, inCollision, clearance, warnings } = contacts;
  const length = (value: number) => withUnit(column(value, "length", store.value, 4), "length", store.value);
  const text = inCollision
    ? t("In contact")
    : clearance === null
      ? t("Nothing can touch anything")
      : t("Free: {clearance} to the nearest", { clearance: length(clearance) });
  const rows = pairs.map(({ a, b, distance }) =>
    element("tr", {}, element("td", {}, a), element("td", {}, b), element("td", { class: "value" }, length(distance))),
  );
  const titles = [t("Of"), t("To"), t("Distance")].map((title) => element("th", { scope: "col" }, title));
  return [
    element("p", { class: "verdict-text", "data-tone": inCollision ? "bad" : "good" }, text),
    ...(rows.length
      ? [
          element(
            "table",
            { class: "findings pairs" },
            element("thead", {}, element("tr", {}, ...titles)),
            element("tbody", {}, ...rows),
          ),
        ]
      : []),
    ...warnings.map((warning) => element("p", { class: "muted small" }, warning)),
  ];
}
