/** The robot on the screen: what it is, where it comes from, what is odd about it; and its files. */

import { asProblem } from "../../api.ts";
import { jointName } from "../../robot/dh.ts";
import type { RobotModel } from "../../robot/model.ts";
import { chainTable } from "../../robot/table.ts";
import { t } from "../../texts/index.ts";
import type { DhTable } from "../../types.ts";
import { confirmed } from "../../ui/dialogs.ts";
import { button, element } from "../../ui/dom.ts";
import { drawing, figureOf, svgOf } from "../../ui/drawing.ts";
import { save } from "../../ui/files.ts";
import type { ProblemView } from "../../ui/problem.ts";
import type { Studio } from "../panel.ts";

export function about(studio: Studio, problem: ProblemView): { host: HTMLElement; close: () => void } {
  const { store } = studio;
  const host = element("div", { class: "about" });
  const close = store.watch(["model"], (state) => {
    host.replaceChildren();
    if (state.model) host.append(...describe(state.model), ...actions(state.model, studio, problem));
  });
  return { host, close };
}

function describe(model: RobotModel): HTMLElement[] {
  const info = model.info;
  const facts: [string, string | null | undefined][] = [
    [
      t("Joints"),
      t("{length} with a position of their own, {length2} links", {
        length: model.joints.length,
        length2: model.links.length,
      }),
    ],
    [t("Chain"), `${model.ends.base_frame} → ${model.ends.tip_frame}`],
    [t("Licence"), info?.licence],
    [t("Source"), info?.provenance],
  ];
  const shown = facts.filter(([, text]) => text);
  const warnings = info?.warnings ?? [];
  return [
    element("h3", {}, model.title),
    element("p", { class: "muted" }, info?.description ?? t("A table that the service does not keep yet.")),
    element(
      "dl",
      { class: "facts" },
      ...shown.flatMap(([title, text]) => [element("dt", {}, title), element("dd", {}, text!)]),
    ),
    ...(warnings.length ? [warningList(warnings, model.info?.source === "uploaded")] : []),
  ];
}

function warningList(warnings: readonly string[], open: boolean): HTMLElement {
  const title =
    warnings.length === 1
      ? t("1 remark on the description")
      : t("{length} remarks on the description", { length: warnings.length });
  return element(
    "details",
    { open },
    element("summary", {}, title),
    element("ul", { class: "remarks" }, ...warnings.map((text) => element("li", {}, text))),
  );
}

function actions(model: RobotModel, studio: Studio, problem: ProblemView): HTMLElement[] {
  const { api, store } = studio;
  const attempt = (work: () => Promise<void>) => () => {
    problem.show(null);
    work().catch((error: unknown) => problem.show(asProblem(error)));
  };
  const file = model.name ?? "table";
  const removal = attempt(async () => {
    const text = t("Its description and its meshes are removed from the service, for everyone who uses it.");
    if (!(await confirmed(t("Remove {name}?", { name: model.name }), text, t("Remove it")))) return;
    await api.call({ method: "DELETE", path: `v1/robots/${encodeURIComponent(model.name!)}` });
    store.set({ robot: "panda", base: null, tip: null });
  });
  const title = t("The frames of the chain's DH table, at this configuration");
  const picture = drawing(t("Frames drawn"), title, problem, () => frames(file, studio));
  const bar = element(
    "div",
    { class: "bar" },
    button(t("Download URDF"), () => save(`${file}.urdf`, "application/xml", model.urdf)),
    button(
      t("Download DH"),
      attempt(async () =>
        save(`${file}.dh.json`, "application/json", `${JSON.stringify(await table(studio), null, 2)}\n`),
      ),
    ),
    picture.ask,
    element("span", { class: "spring" }),
    model.info?.source === "uploaded" && button(t("Remove"), removal, { class: "button danger" }),
  );
  return [bar, picture.place];
}

/** The picture of the chain's table where the joints stand. */
async function frames(file: string, studio: Studio): Promise<HTMLElement> {
  const dh = await table(studio);
  const { positions } = studio.store.value;
  const variables = dh.joints.flatMap((row, i) => (row.mimic ? [] : [positions[jointName(row, i)] ?? 0]));
  const body = { dh, joint_positions: [variables] };
  const svg = await svgOf(studio.api, { method: "POST", path: "v1/dh/picture", body });
  return figureOf(svg, t("Frames of the DH table"), `${file}-dh`, t("Save the frames as SVG"));
}

/** The table of the chain on the screen. */
async function table({ api, store }: Studio): Promise<DhTable> {
  return (await chainTable(api, store.value, new AbortController().signal))!.dh;
}
