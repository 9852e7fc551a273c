/** A typed table becomes a robot of the service, so that everything else can be asked of it. */

import { isName } from "../../robot/upload.ts";
import type { DhTable, RobotInfo } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { asProblem, Problem } from "../../api.ts";
import type { Studio } from "../panel.ts";

export function keep({ api, store }: Pick<Studio, "api" | "store">, table: () => DhTable | null): HTMLElement {
  const problem = new ProblemView();
  const name = element("input", {
    type: "text",
    class: "text",
    id: "table-name",
    value: "my_arm",
    autocomplete: "off",
    spellcheck: "false",
  });
  const send = (replace: boolean) => async () => {
    const dh = table();
    const wanted = name.value.trim();
    problem.show(
      isName(wanted)
        ? null
        : new Problem(422, "This is no name", "1 to 64 letters, digits, _, . or -, the first one a letter or digit."),
    );
    if (!dh || !isName(wanted)) return;
    try {
      const path = `v1/robots/${encodeURIComponent(wanted)}`;
      if (replace) await api.call<RobotInfo>({ method: "PUT", path, body: { dh } });
      else await api.call<RobotInfo>({ method: "POST", path: "v1/robots", body: { name: wanted, dh } });
      exchange.hidden = true;
      store.set({ robot: wanted, draft: null, base: null, tip: null });
    } catch (error) {
      const found = asProblem(error);
      problem.show(found);
      exchange.hidden = found.status !== 409;
    }
  };
  const exchange = button("Replace the one of this name", () => void send(true)(), { hidden: true });
  return element(
    "div",
    { class: "keep" },
    element("label", { class: "field", for: "table-name" }, "Name at the service"),
    element(
      "div",
      { class: "bar" },
      name,
      button("Add to the robots", () => void send(false)(), { class: "button primary" }),
      exchange,
    ),
    problem.host,
  );
}
