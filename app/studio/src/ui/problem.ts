/** An error as it is shown: what is wrong in a sentence, and what can be done. */

import { NO_ANSWER, type Problem } from "../api.ts";
import { t } from "../texts/index.ts";
import { element } from "./dom.ts";

export class ProblemView {
  readonly host = element("div", { class: "problem", role: "alert", hidden: true });

  show(problem: Problem | null): void {
    this.host.hidden = problem === null;
    if (!problem) {
      this.host.replaceChildren();
      return;
    }
    const advice = whatToDo(problem);
    this.host.replaceChildren(
      element("strong", {}, problem.title),
      element("p", {}, problem.detail),
      ...(advice ? [element("p", { class: "muted" }, advice)] : []),
    );
  }
}

function whatToDo(problem: Problem): string | null {
  if (problem.status === NO_ANSWER) return t("Start it again with ./dev serve, then try again.");
  const close = problem.facts["close"];
  if (Array.isArray(close) && close.length) return t("Similar names: {close}.", { close: close.join(", ") });
  if (problem.status === 404) return t("It may have been removed. The Robot panel lists what there is.");
  if (problem.status === 409) return t("Choose another name.");
  if (problem.status === 413) return t("Leave out what is not needed, such as collision meshes.");
  if (problem.status === 429 || problem.status === 503) return t("Wait a moment, then try again.");
  if (problem.status >= 500) return t("The service's log tells more.");
  return null;
}
