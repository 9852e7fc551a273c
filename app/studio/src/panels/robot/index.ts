/** Robot: choose one of the catalogue, bring one along, or type a table. */

import { t } from "../../texts/index.ts";
import { Choice, element, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import type { Panel, Studio } from "../panel.ts";
import { about } from "./about.ts";
import { catalogue } from "./catalogue.ts";
import { tableEditor } from "./table.ts";
import { hasDropped, uploads } from "./upload.ts";

export const robotPanel: Panel = { id: "robot", title: t("Robot"), open };

type Part = "catalogue" | "upload" | "table";

const PARTS: readonly { value: Part; text: string }[] = [
  { value: "catalogue", text: t("Catalogue") },
  { value: "upload", text: t("Upload") },
  { value: "table", text: t("DH table") },
];

let last: Part = "catalogue";

/** The part that is shown when the panel is opened next. */
export function showPart(part: Part): void {
  last = part;
}

function open(host: HTMLElement, studio: Studio): () => void {
  const { store } = studio;
  const request = new RequestView(studio.api);
  const problem = new ProblemView();
  const body = element("div", { class: "part" });
  const card = about({ ...studio, api: request.api }, problem);
  let close: () => void = () => {};
  const show = (part: Part) => {
    last = part;
    close();
    body.replaceChildren();
    parts.show(part);
    const made = { catalogue, upload: uploads, table: tableEditor }[part](body, { ...studio, api: request.api });
    close = made;
  };
  const parts = new Choice(t("Where the robot comes from"), PARTS, show);
  host.append(
    section(t("Choose a robot"), parts.host, body),
    problem.host,
    section(t("On the screen"), card.host),
    request.host,
  );
  show(store.value.draft && !hasDropped() ? "table" : last);
  const stops = [
    card.close,
    store.watch(["failure", "draft"], ({ failure, draft }) => problem.show(draft ? null : failure)),
    store.watch(["robot", "draft"], ({ robot, draft }) => {
      if (!robot && !draft) return;
      request.show(
        draft
          ? { method: "POST", path: "v1/dh/to-urdf", body: { name: "draft", dh: draft } }
          : { method: "GET", path: `v1/robots/${encodeURIComponent(robot)}` },
      );
    }),
  ];
  return () => {
    close();
    for (const stop of stops) stop();
  };
}
