/** The robot on the screen: what it is, where it comes from, what is odd about it; and its files. */

import { asProblem } from "../../robot/load.ts";
import type { RobotModel } from "../../robot/model.ts";
import { tablePath } from "../../robot/table.ts";
import type { State } from "../../state.ts";
import type { TableAnswer } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { save } from "../../ui/files.ts";
import type { ProblemView } from "../../ui/problem.ts";
import type { Studio } from "../panel.ts";

export function about(studio: Studio, problem: ProblemView): { host: HTMLElement; close: () => void } {
  const { store } = studio;
  const host = element("div", { class: "about" });
  const close = store.watch(["model"], (state) => {
    host.replaceChildren();
    if (state.model) host.append(...describe(state.model), actions(state.model, studio, problem));
  });
  return { host, close };
}

function describe(model: RobotModel): HTMLElement[] {
  const info = model.info;
  const facts: [string, string | null | undefined][] = [
    ["Joints", `${model.joints.length} with a position of their own, ${model.links.length} links`],
    ["Chain", `${model.ends.base_frame} → ${model.ends.tip_frame}`],
    ["Licence", info?.licence],
    ["Source", info?.provenance],
  ];
  const shown = facts.filter(([, text]) => text);
  const warnings = info?.warnings ?? [];
  return [
    element("h3", {}, model.title),
    element("p", { class: "muted" }, info?.description ?? "A table that the service does not keep yet."),
    element(
      "dl",
      { class: "facts" },
      ...shown.flatMap(([title, text]) => [element("dt", {}, title), element("dd", {}, text!)]),
    ),
    ...(warnings.length ? [warningList(warnings)] : []),
  ];
}

function warningList(warnings: readonly string[]): HTMLElement {
  const title = `${warnings.length} ${warnings.length === 1 ? "remark" : "remarks"} on the description`;
  return element(
    "details",
    {},
    element("summary", {}, title),
    element("ul", { class: "remarks" }, ...warnings.map((text) => element("li", {}, text))),
  );
}

function actions(model: RobotModel, studio: Studio, problem: ProblemView): HTMLElement {
  const { api, store } = studio;
  const attempt = (work: () => Promise<void>) => () => {
    problem.show(null);
    work().catch((error: unknown) => problem.show(asProblem(error)));
  };
  const file = model.name ?? "table";
  const removal = attempt(async () => {
    await api.call({ method: "DELETE", path: `v1/robots/${encodeURIComponent(model.name!)}` });
    store.set({ robot: "panda", base: null, tip: null });
  });
  return element(
    "div",
    { class: "bar" },
    button("Download URDF", () => save(`${file}.urdf`, "application/xml", model.urdf)),
    button(
      "Download DH",
      attempt(async () => save(`${file}.dh.json`, "application/json", await table(model, studio))),
    ),
    element("span", { class: "spring" }),
    model.info?.source === "uploaded" && button("Remove", removal, { class: "button danger" }),
  );
}

/** The table of the chain as JSON: what `dh` of a request takes. */
async function table(model: RobotModel, { api, store }: Studio): Promise<string> {
  const { draft, base, tip, table: shown }: Readonly<State> = store.value;
  const dh = draft ?? shown?.dh ?? (await api.get<TableAnswer>(tablePath(model.name!, "standard", base, tip))).dh;
  return `${JSON.stringify(dh, null, 2)}\n`;
}
