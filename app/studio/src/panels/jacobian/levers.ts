/** The lever arms of a force at the tip of a planar arm: its numbers, and the picture of them. */

import type { Api } from "../../api.ts";
import { shownChain } from "../../robot/chain.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { t } from "../../texts/index.ts";
import { element, section } from "../../ui/dom.ts";
import { drawing, figureOf, svgOf } from "../../ui/drawing.ts";
import { SI } from "../../ui/quantity.ts";
import { NumberField } from "../../ui/number.ts";
import { ProblemView } from "../../ui/problem.ts";

const AXES = ["x", "y", "z"] as const;
const TITLE = t("Lever arms of the force");

/** @param api of the calls, which the service refuses for an arm that moves in space. */
export function levers(api: Api, store: Store<State>): HTMLElement {
  const force = [10, 0, 0];
  const problem = new ProblemView();
  const picture = drawing(
    t("Levers drawn"),
    t("The arm with the lever arm of the force about each joint"),
    problem,
    async () => {
      const { path, ends, configuration } = shownChain(store.value)!;
      const body = { ...ends, joint_positions: [configuration], wrenches: [force], task: AXES };
      const svg = await svgOf(api, { method: "POST", path: `${path}/statics`, body });
      return figureOf(svg, TITLE, "levers", t("Save the lever arms as SVG"));
    },
  );
  const cells = AXES.map((axis, i) => cell(axis, force[i]!, (value) => (force[i] = value)));
  return section(
    TITLE,
    element("p", { class: "muted small" }, t("Force at the tip in the base’s axes [N]; of planar arms.")),
    element("div", { class: "place" }, ...cells),
    element("div", { class: "bar" }, picture.ask),
    problem.host,
    picture.place,
  );
}

function cell(axis: string, value: number, change: (value: number) => void): HTMLElement {
  const field = new NumberField({
    label: t("Force along {axis}", { axis }),
    kind: "number",
    units: () => SI,
    change: (typed) => typed !== null && change(typed),
  });
  field.set(value);
  return element("label", { class: "number-cell" }, element("span", { class: "field" }, axis), field.input);
}
