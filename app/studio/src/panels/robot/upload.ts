/** A URDF or a zip with its meshes, dropped anywhere on the page or chosen here. */

import type { Problem } from "../../api.ts";
import { suggestedName, upload } from "../../robot/upload.ts";
import { element } from "../../ui/dom.ts";
import type { Studio } from "../panel.ts";
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
  const picker = element("input", { type: "file", accept: ".urdf,.xml,.zip", class: "file", id: "robot-file" });
  const chosen = element(
    "p",
    { class: "muted" },
    "A URDF with its xacro expanded, or a zip of it and its meshes. It may be dropped anywhere on the page.",
  );
  const which = element("select", { class: "select", id: "robot-which", onchange: () => void made.submit() });
  const among = element(
    "div",
    { class: "keep", hidden: true },
    element("label", { class: "field", for: "robot-which" }, "Description in the zip"),
    which,
  );
  const send = async (name: string, replace: boolean) => {
    if (!waiting) return;
    await upload(api, waiting, name, { replace, file: which.value });
    waiting = null;
    offer([]);
    chosen.textContent = `${name} is on the screen.`;
    store.set({ robot: "", draft: null });
    store.set({ robot: name, base: null, tip: null, target: null });
  };
  const offer = (files: readonly string[]) => {
    const first = element("option", { value: "" }, `Choose one of ${files.length}`);
    which.replaceChildren(first, ...files.map((file) => element("option", { value: file }, file)));
    among.hidden = files.length === 0;
  };
  const refused = ({ facts }: Problem) => {
    const files = facts["files"];
    if (!Array.isArray(files) || files.length < 2) return;
    made.problem.show(null); // the choice says it
    offer(files.map(String));
  };
  const made = naming({ id: "robot-name", label: "Name", add: "Add", send, refused });
  const receive = async (file: File) => {
    waiting = file;
    made.forget();
    offer([]);
    chosen.textContent = `${file.name}, ${Math.ceil(file.size / 1024)} kB`;
    made.name.value = await suggestedName(file);
    await made.submit();
  };
  picker.addEventListener("change", () => {
    const file = picker.files?.[0];
    if (file) void receive(file);
  });
  made.adding.disabled = true;
  host.append(chosen, element("label", { class: "field", for: "robot-file" }, "File"), picker, among, made.host);
  if (waiting) void receive(waiting);
  return () => {};
}
