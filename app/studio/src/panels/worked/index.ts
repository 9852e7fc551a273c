/** Worked solution: transforms, Jacobian and singularities of the table as a lecturer writes them, beside the numbers. */

import "../../styles/worked.css";

import { jointName } from "../../robot/dh.ts";
import type { Writing } from "../../state.ts";
import { button, Choice, element, section } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { RequestView } from "../../ui/request.ts";
import type { Panel, Studio } from "../panel.ts";
import { JointList } from "../pose/joints.ts";
import { Derivation, type Derived } from "./derivation.ts";
import { numbersAt } from "./numbers.ts";
import { Remarks } from "./remarks.ts";
import { Sheet } from "./sheet.ts";
import { PARTS, sections } from "./solution.ts";

export const workedPanel: Panel = { id: "worked", title: "Worked solution", open };

const NOTATIONS: readonly { value: Writing["notation"]; text: string }[] = [
  { value: "short", text: "c₁₂" },
  { value: "full", text: "cos(q₁ + q₂)" },
];
const LENGTHS = [
  { value: "symbols", text: "Symbols" },
  { value: "values", text: "Values" },
] as const;

function open(host: HTMLElement, { api, store }: Studio): () => void {
  const write = (change: Partial<Writing>) => store.set({ writing: { ...store.value.writing, ...change } });
  const parts = new Choice("Part of the solution", PARTS, (part) => write({ part }));
  const notation = new Choice("Cosines and sines", NOTATIONS, (chosen) => write({ notation: chosen }));
  const lengths = new Choice("Lengths", LENGTHS, (chosen) => write({ symbolic: chosen === "symbols" }));
  const request = new RequestView(api);
  const problem = new ProblemView();
  const joints = new JointList(store);
  joints.host.classList.add("compact");
  const remarks = new Remarks();
  const status = element("p", { class: "muted", role: "status" });
  const stop = button("Stop", () => derivation.cancel(), { class: "button small", hidden: true });
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
    else sheet.show(sections(found.answer, writing.part), numbers);
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
      status.textContent = isBusy ? "Working it out …" : "";
      stop.hidden = !isBusy;
    },
  });
  host.append(
    section(
      "Write down",
      parts.host,
      element("div", { class: "bar" }, notation.host, lengths.host, element("span", { class: "spring" }), status, stop),
    ),
    element("details", { class: "posture", open: true }, element("summary", {}, "Joints"), joints.host),
    problem.host,
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
    store.watch(["model", "base", "tip", "degrees"], () => joints.build()),
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
