/** Exercises: draws, shows and grades the course's exercises. What does it is loaded when the panel is first opened. */

import "../../styles/exercises.css";

import { asProblem } from "../../api.ts";
import { element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Panel, Studio } from "../panel.ts";

export const exercisesPanel: Panel = { id: "exercises", title: "Exercises", open };

function open(host: HTMLElement, studio: Studio): () => void {
  const problem = new ProblemView();
  host.append(element("p", { class: "section muted", role: "status" }, "Loading …"));
  let isOpen = true;
  let close = () => {
    isOpen = false;
  };
  import("./exercises.ts").then(
    (loaded) => {
      if (!isOpen) return;
      host.replaceChildren();
      close = loaded.open(host, studio);
    },
    (error: unknown) => {
      host.replaceChildren(problem.host);
      problem.show(asProblem(error, "The exercises are not loaded"));
    },
  );
  return () => close();
}
