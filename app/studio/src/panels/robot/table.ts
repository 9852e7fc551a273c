/** A Denavit-Hartenberg table, typed: every change that makes sense is on the screen at once, errors are at their cell. */

import { asProblem, Latest, type Problem } from "../../api.ts";
import type { Convention, DhTable } from "../../types.ts";
import { button, Choice, element, toggle } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Studio } from "../panel.ts";
import { keep } from "./keep.ts";
import { PRESETS } from "./presets.ts";
import { Places } from "./places.ts";
import { TableRows } from "./rows.ts";

const CONVENTIONS: readonly { value: Convention; text: string }[] = [
  { value: "standard", text: "Standard" },
  { value: "modified", text: "Modified" },
];
const PRODUCTS: Record<Convention, string> = {
  standard: "A_i = R_z(\\theta_i)\\, T_z(d_i)\\, T_x(a_i)\\, R_x(\\alpha_i)",
  modified: "A_i = R_x(\\alpha_i)\\, T_x(a_i)\\, R_z(\\theta_i)\\, T_z(d_i)",
};
const FIRST_ROW: DhTable = {
  convention: "standard",
  joints: [{ name: "joint_1", type: "revolute", a: 0.5, alpha: 0, d: 0, theta: 0 }],
};

export function tableEditor(host: HTMLElement, { api, store }: Studio): () => void {
  const latest = new Latest();
  const problem = new ProblemView();
  const product = element("div", { class: "product" });
  let table: DhTable | null = null;
  const draw = (dh: DhTable) => store.set({ draft: dh, robot: "", base: null, tip: null });
  const edit = (dh: DhTable) => {
    if (JSON.stringify(dh) === JSON.stringify(table)) return;
    table = dh;
    draw(dh);
  };
  const degrees = () => store.value.degrees;
  const rows = new TableRows((joints) => edit({ ...table!, joints }), degrees);
  const places = new Places((end, pose) => {
    const { [end]: _, ...others } = table!;
    edit(pose ? { ...others, [end]: pose } : others);
  }, degrees);
  const convention = new Choice("Convention", CONVENTIONS, (wanted) => void convert(wanted));
  const convert = async (wanted: Convention) => {
    if (!table || wanted === table.convention) return;
    try {
      const answer = await latest.run((signal) =>
        api.post<{ dh: DhTable }>("v1/dh/convert", { dh: table, convention: wanted }, signal),
      );
      if (answer) draw(answer.dh);
      problem.show(null);
    } catch (error) {
      show(asProblem(error));
    }
  };
  /** Each place of a problem at its cell; what has none, below. */
  const show = (found: Problem | null) => {
    const elsewhere = places.fail(rows.fail(found?.places ?? []));
    problem.show(found && (elsewhere.length || found.places.length === 0) ? found : null);
  };
  const preset = presetList((chosen) => draw(structuredClone(chosen)));
  const details = toggle(
    "Names, velocity, effort",
    "The joints' names, and their limits of velocity and effort",
    () => {
      const isShown = details.getAttribute("aria-pressed") !== "true";
      details.setAttribute("aria-pressed", String(isShown));
      rows.detail(isShown);
    },
  );
  const kept = keep({ api, store }, () => table);
  host.append(
    element("div", { class: "bar" }, convention.host, element("span", { class: "spring" }), preset),
    product,
    rows.host,
    element(
      "div",
      { class: "bar" },
      button("Add a row", () => rows.add()),
      details,
    ),
    places.host,
    problem.host,
    kept,
  );
  store.set({ dh: true });
  const stops = [
    store.watch(["draft", "table", "degrees"], (state) => {
      const next = state.draft ?? state.table?.dh ?? (state.model ? null : FIRST_ROW);
      if (!next) return;
      if (next !== table || rows.isEmpty) {
        rows.build(next.joints);
        places.build(next);
      }
      table = next;
      convention.show(next.convention);
      product.replaceChildren(formula(PRODUCTS[next.convention]));
    }),
    store.watch(["failure"], ({ failure, draft }) => show(draft ? failure : null)),
    () => latest.cancel(),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

function presetList(choose: (table: DhTable) => void): HTMLElement {
  const select = element(
    "select",
    {
      class: "select",
      "aria-label": "Start from a table of the course",
      onchange: () => {
        const chosen = select.value === "new" ? FIRST_ROW : PRESETS[Number(select.value)]?.table;
        if (chosen) choose(chosen);
        select.value = "";
      },
    },
    element("option", { value: "" }, "Start from …"),
    element("option", { value: "new" }, "One row"),
    ...PRESETS.map(({ title }, index) => element("option", { value: index }, title)),
  );
  return select;
}
