/** A plan as a file: a table, or what a robot's controller reads; the service writes each. */

import { type Api, asProblem, type Call } from "../../api.ts";
import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { save } from "../../ui/files.ts";
import { ProblemView } from "../../ui/problem.ts";

interface Form {
  text: string;
  title: string;
  ending: string;
  type: string;
  /** Where the type alone does not say it. */
  format?: string;
}

const FORMS: readonly Form[] = [
  {
    text: "CSV",
    title: t("Times, positions, velocities and accelerations as a table, a row every sample period"),
    ...{ ending: "csv", type: "text/csv" },
  },
  {
    text: t("ROS, JSON"),
    title: t("The message JointTrajectory of ROS 2, a point every sample period"),
    ...{ ending: "json", type: "application/json", format: "joint_trajectory" },
  },
  {
    text: t("ROS, YAML"),
    title: t("The message JointTrajectory of ROS 2, with frames and units in comments"),
    ...{ ending: "yaml", type: "application/yaml", format: "joint_trajectory" },
  },
  {
    text: t("URScript"),
    title: t("A program for an arm of Universal Robots: for its simulator first, and slowly"),
    ...{ ending: "script", type: "text/x-urscript", format: "urscript" },
  },
];

export class Saving {
  readonly host: HTMLElement;
  readonly problem = new ProblemView();

  /** @param wanted the motion, as a call that the service answers, and what the file is called. */
  constructor(
    private readonly api: Api,
    private readonly wanted: () => { name: string; path: string; body: object },
  ) {
    const buttons = FORMS.map((form) => {
      const made = button(form.text, () => void this.#save(form, made), { class: "button small", title: form.title });
      return made;
    });
    this.host = element(
      "div",
      { class: "bar", role: "group", "aria-label": t("Save as") },
      element("span", { class: "field" }, t("Save as")),
      ...buttons,
    );
  }

  async #save({ ending, type, format }: Form, pressed: HTMLButtonElement): Promise<void> {
    const { name, path, body } = this.wanted();
    const call: Call = { method: "POST", path: format ? `${path}?format=${format}` : path, body, accept: type };
    pressed.disabled = true;
    try {
      save(`${name}.${ending}`, type, await this.api.textOf(call));
      this.problem.show(null);
    } catch (error) {
      this.problem.show(asProblem(error));
    } finally {
      pressed.disabled = false;
    }
  }
}
