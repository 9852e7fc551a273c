/** Worked solution: transforms, Jacobian and singularities of the table as a lecturer writes them, beside the numbers. */

import "../../styles/worked.css";

import { jointName, places } from "../../robot/dh.ts";
import type { Writing } from "../../state.ts";
import { t } from "../../texts/index.ts";
import { button, Choice, element, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { isSame, SI, UNITS } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { jointHue } from "../../view/colours.ts";
import type { Panel, Studio } from "../panel.ts";
import { JointList } from "../pose/joints.ts";
import { Derivation, type Derived } from "./derivation.ts";
import { numbersAt } from "./numbers.ts";
import { Remarks } from "./remarks.ts";
import { Sheet } from "./sheet.ts";
import { PARTS, sections } from "./solution.ts";

export const workedPanel: Panel = { id: "worked", title: t("Worked solution"), open };

const NOTATIONS: readonly { value: Writing["notation"]; text: string }[] = [
  { value: "short", text: "c₁₂" },
  { value: "full", text: "cos(q₁ + q₂)" },
];
const LENGTHS = [
  { value: "symbols", text: t("Symbols") },
  { value: "values", text: t("Values") },
] as const;

const IN_SI = t("All that follows is in metres and radians, whatever the rest of the page shows.");

function open(host: HTMLElement, { api, store }: Studio): () => void {
  const write = (change: Partial<Writing>) => store.set({ writing: { ...store.value.writing, ...change } });
  const parts = new Choice(t("Part of the solution"), PARTS, (part) => write({ part }));
  const notation = new Choice(t("Cosines and sines"), NOTATIONS, (chosen) => write({ notation: chosen }));
  const lengths = new Choice(t("Lengths"), LENGTHS, (chosen) => write({ symbolic: chosen === "symbols" }));
  const request = new RequestView(api);
  const problem = new ProblemView();
  const joints = new JointList(store);
  joints.host.classList.add("compact");
  const remarks = new Remarks();
  const units = element("p", { class: "units muted small" }, IN_SI);
  const status = element("p", { class: "muted", role: "status" });
  const stop = button(t("Stop"), () => derivation.cancel(), { class: "button small", hidden: true });
  let found: Derived | null = null;
  let shown = "";
  const go = (configuration: number[]) => {
    const moved = found!.table.joints.map((row, index) => [jointName(row, index), configuration[index]!]);
    store.set({ positions: { ...store.value.positions, ...Object.fromEntries(moved) } });
  };
  const sheet = new Sheet(go);
  /** Set the formulas, unless they stand there already, and the numbers of this moment. */
  const refresh = () => {
    if (!found) return;
    const { positions, writing } = store.value;
    const numbers = numbersAt(found.table, positions, found.answer.determinant);
    const wanted = `${writing.part} ${found.key}`;
    if (wanted === shown) sheet.update(numbers);
    else sheet.show(sections(found.answer, writing.part), numbers, places(found.table.joints).map(jointHue));
    shown = wanted;
  };
  const clear = () => {
    found = null;
    shown = "";
    sheet.clear();
    remarks.host.hidden = true;
  };
  const derivation = new Derivation(request.api, store, {
    derived: (answer) => {
      found = answer;
      refresh();
      remarks.show(answer);
    },
    failed: (reason) => {
      problem.show(reason);
      if (reason) clear();
    },
    busy: (isBusy) => {
      status.textContent = isBusy ? t("Working it out …") : "";
      stop.hidden = !isBusy;
    },
  });
  host.append(
    section(
      t("Write down"),
      parts.host,
      element("div", { class: "bar" }, notation.host, lengths.host, element("span", { class: "spring" }), status, stop),
    ),
    element("details", { class: "posture", open: true }, element("summary", {}, t("Joints")), joints.host),
    problem.host,
    units,
    sheet.host,
    remarks.host,
    request.host,
  );
  const stops = [
    store.watch(["writing"], ({ writing }) => {
      parts.show(writing.part);
      notation.show(writing.notation);
      lengths.show(writing.symbolic ? "symbols" : "values");
      refresh();
    }),
    store.watch(["model", "base", "tip"], clear),
    store.watch(["model", "base", "tip", ...UNITS], () => joints.build()),
    store.watch([...UNITS], (state) => (units.hidden = isSame(state, SI))),
    store.watch(["positions"], () => {
      joints.update();
      refresh();
    }),
    derivation.follow(),
    () => sheet.clear(),
    () => store.set({ joint: null }),
  ];
  return () => {
    for (const end of stops) end();
  };
}
