/** A Denavit-Hartenberg table, typed: every change that makes sense is on the screen at once, errors are at their cell. */

import "../../styles/construction.css";

import { asProblem, Latest, type Problem } from "../../api.ts";
import { t } from "../../texts/index.ts";
import type { Convention, DhTable } from "../../types.ts";
import { button, Choice, element, toggle } from "../../ui/dom.ts";
import { formula } from "../../ui/mathematics.ts";
import type { Lit } from "../../state.ts";
import { ProblemView } from "../../ui/problem.ts";
import { chosenOf, isSame, UNITS } from "../../ui/quantity.ts";
import type { Studio } from "../panel.ts";
import { keep } from "./keep.ts";
import { PRESETS } from "./presets.ts";
import { Places } from "./places.ts";
import { TableRows } from "./rows.ts";

const CONVENTIONS: readonly { value: Convention; text: string }[] = [
  { value: "standard", text: t("Standard") },
  { value: "modified", text: t("Modified") },
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
  let units = chosenOf(store.value);
  const unitsNow = () => store.value;
  const light = (lit: Lit | null) => store.set({ lit });
  const rows = new TableRows((joints) => edit({ ...table!, joints }), unitsNow, light);
  const places = new Places((end, pose) => {
    const { [end]: _, ...others } = table!;
    edit(pose ? { ...others, [end]: pose } : others);
  }, unitsNow);
  const convention = new Choice(t("Convention"), CONVENTIONS, (wanted) => void convert(wanted));
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
    t("Names, velocity, effort"),
    t("The joints' names, and their limits of velocity and effort"),
    () => {
      const isShown = details.getAttribute("aria-pressed") !== "true";
      details.setAttribute("aria-pressed", String(isShown));
      rows.detail(isShown);
    },
  );
  const build = async () => {
    try {
      const { construct } = await import("../../construction/index.ts");
      if (table) await construct(api, store, table);
    } catch (error) {
      problem.show(asProblem(error));
    }
  };
  const kept = keep({ api, store }, () => table);
  host.append(
    element("div", { class: "bar" }, convention.host, element("span", { class: "spring" }), preset),
    product,
    rows.host,
    element(
      "div",
      { class: "bar" },
      button(t("Add a row"), () => rows.add()),
      details,
      button(t("Construction"), () => void build(), {
        title: t("How the table's frames come about, motion by motion"),
      }),
    ),
    places.host,
    problem.host,
    kept,
  );
  store.set({ dh: true });
  const stops = [
    store.watch(["draft", "table", ...UNITS], (state) => {
      const next = state.draft ?? state.table?.dh ?? (state.model ? null : FIRST_ROW);
      if (!next) return;
      if (next !== table || rows.isEmpty || !isSame(units, state)) {
        // What has been dragged in the picture changes numbers alone: the fields stay, with the focus in one of them.
        const isKept = isSame(units, state) && rows.update(next.joints);
        units = chosenOf(state);
        if (!isKept) rows.build(next.joints);
        places.build(next);
        rows.light(store.value.lit);
      }
      table = next;
      convention.show(next.convention);
      product.replaceChildren(formula(PRODUCTS[next.convention]));
    }),
    store.watch(["failure"], ({ failure, draft }) => show(draft ? failure : null)),
    store.watch(["lit"], ({ lit }) => rows.light(lit)),
    () => latest.cancel(),
    () => light(null),
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
      "aria-label": t("Start from a table of the course"),
      onchange: () => {
        const chosen = select.value === "new" ? FIRST_ROW : PRESETS[Number(select.value)]?.table;
        if (chosen) choose(chosen);
        select.value = "";
      },
    },
    element("option", { value: "" }, t("Start from …")),
    element("option", { value: "new" }, t("One row")),
    ...PRESETS.map(({ title }, index) => element("option", { value: index }, title)),
  );
  return select;
}
