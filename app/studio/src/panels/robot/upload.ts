/** A URDF or a zip with its meshes, dropped anywhere on the page or chosen here. */

import { asProblem, Problem } from "../../api.ts";
import { isName, suggestedName, upload } from "../../robot/upload.ts";
import { button, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Studio } from "../panel.ts";

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
  const problem = new ProblemView();
  const picker = element("input", { type: "file", accept: ".urdf,.xml,.zip", class: "file", id: "robot-file" });
  const name = element("input", {
    type: "text",
    class: "text",
    id: "robot-name",
    autocomplete: "off",
    spellcheck: "false",
  });
  const chosen = element(
    "p",
    { class: "muted" },
    "A URDF with its xacro expanded, or a zip of one URDF and its meshes. It may be dropped anywhere on the page.",
  );
  const send = (replace: boolean) => async () => {
    if (!waiting) return;
    const wanted = name.value.trim();
    problem.show(
      isName(wanted)
        ? null
        : new Problem(422, "This is no name", "1 to 64 letters, digits, _, . or -, the first one a letter or digit."),
    );
    if (!isName(wanted)) return;
    busy(true);
    try {
      await upload(api, waiting, wanted, replace);
      waiting = null;
      exchange.hidden = true;
      chosen.textContent = `${wanted} is on the screen.`;
      store.set({ robot: "", draft: null });
      store.set({ robot: wanted, base: null, tip: null, target: null });
    } catch (error) {
      const found = asProblem(error);
      problem.show(found);
      exchange.hidden = found.status !== 409;
    } finally {
      busy(false);
    }
  };
  const add = button("Add", () => void send(false)(), { class: "button primary" });
  const exchange = button("Replace the one of this name", () => void send(true)(), { hidden: true });
  const busy = (isBusy: boolean) => {
    for (const made of [add, exchange]) made.disabled = isBusy || !waiting;
  };
  const receive = async (file: File) => {
    waiting = file;
    problem.show(null);
    exchange.hidden = true;
    chosen.textContent = `${file.name}, ${Math.ceil(file.size / 1024)} kB`;
    name.value = await suggestedName(file);
    await send(false)();
  };
  picker.addEventListener("change", () => {
    const file = picker.files?.[0];
    if (file) void receive(file);
  });
  host.append(
    chosen,
    element("label", { class: "field", for: "robot-file" }, "File"),
    picker,
    element("label", { class: "field", for: "robot-name" }, "Name"),
    element("div", { class: "bar" }, name, add, exchange),
    problem.host,
  );
  busy(false);
  if (waiting) void receive(waiting);
  return () => {};
}
