/** A URDF or a zip with its meshes, dropped anywhere on the page or chosen here. */

import type { Problem } from "../../api.ts";
import { isArchive, suggestedName, upload } from "../../robot/upload.ts";
import { textsOf } from "../../robot/zip.ts";
import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import type { Studio } from "../panel.ts";
import { argumentFields, declared, declaredIn } from "./arguments.ts";
import { naming } from "./naming.ts";

/** The file that was dropped last, until an upload of it has succeeded. */
let waiting: File | null = null;

/** A file has been dropped on the page: it is uploaded when this part is opened next. */
export function drop(file: File): void {
  waiting = file;
}

export function hasDropped(): boolean {
  return waiting !== null;
}

export function uploads(host: HTMLElement, { api, store }: Studio): () => void {
  const picker = element("input", { type: "file", accept: ".urdf,.xacro,.xml,.zip", class: "file", id: "robot-file" });
  const chosen = element(
    "p",
    { class: "muted" },
    t(
      "A URDF, xacro or MJCF, or a zip of it with its meshes and the files it includes. It may be dropped anywhere on the page.",
    ),
  );
  const which = element("select", { class: "select", id: "robot-which", onchange: () => void choose() });
  const among = element(
    "div",
    { class: "keep", hidden: true },
    element("label", { class: "field", for: "robot-which" }, t("Description in the zip")),
    which,
  );
  const send = async (name: string, replace: boolean) => {
    if (!waiting) return;
    fields.mark(null);
    await upload(api, waiting, name, { replace, file: which.value, given: fields.given() });
    waiting = null;
    offer([]);
    fields.offer(new Map());
    chosen.textContent = t("{name} is on the screen.", { name });
    store.set({ robot: "", draft: null });
    store.set({ robot: name, base: null, tip: null, target: null });
  };
  const offer = (files: readonly string[]) => {
    const first = element("option", { value: "" }, t("Choose one of {length}", { length: files.length }));
    which.replaceChildren(first, ...files.map((file) => element("option", { value: file }, file)));
    among.hidden = files.length === 0;
  };
  const fields = argumentFields();
  let texts = new Map<string, string>();
  const choose = async () => {
    const presets = declaredIn(texts, which.value);
    fields.offer(presets);
    if (presets.size === 0) await made.submit();
  };
  const refused = (problem: Problem) => {
    if (fields.mark(problem)) made.problem.show(null); // the field says it
    const files = problem.facts["files"];
    if (!Array.isArray(files) || files.length < 2) return;
    made.problem.show(null); // the choice says it
    offer(files.map(String));
  };
  const made = naming({ id: "robot-name", label: t("Name"), add: t("Add"), send, refused });
  const receive = async (file: File) => {
    waiting = file;
    made.forget();
    made.problem.show(null);
    offer([]);
    chosen.textContent = `${file.name}, ${Math.ceil(file.size / 1024)} kB`;
    made.name.value = await suggestedName(file);
    texts = isArchive(file) ? await textsOf(file, /\.(urdf|xacro)$/i) : new Map();
    const presets = isArchive(file) ? declaredIn(texts, "") : declared(await file.text());
    fields.offer(presets);
    if (presets.size === 0) await made.submit();
    else made.adding.disabled = false;
  };
  picker.addEventListener("change", () => {
    const file = picker.files?.[0];
    if (file) void receive(file);
  });
  made.adding.disabled = true;
  host.append(
    chosen,
    element("label", { class: "field", for: "robot-file" }, t("File")),
    picker,
    among,
    fields.host,
    made.host,
  );
  if (waiting) void receive(waiting);
  return () => {};
}
