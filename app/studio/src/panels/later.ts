/** Panels that few open: what they do is loaded when one is first opened. */

import { asProblem } from "../api.ts";
import { t } from "../texts/index.ts";
import { element } from "../ui/dom.ts";
import { ProblemView } from "../ui/problem.ts";
import type { Panel } from "./panel.ts";

/** How a panel opens whose `open` is in another chunk; `failure` titles the problem where that does not come. */
export function later(load: () => Promise<Pick<Panel, "open">>, failure: string): Panel["open"] {
  return (host, studio) => {
    const problem = new ProblemView();
    host.append(element("p", { class: "section muted", role: "status" }, t("Loading …")));
    let isOpen = true;
    let close = () => {
      isOpen = false;
    };
    load().then(
      (loaded) => {
        if (!isOpen) return;
        host.replaceChildren();
        close = loaded.open(host, studio);
      },
      (error: unknown) => {
        if (!isOpen) return;
        host.replaceChildren(problem.host);
        problem.show(asProblem(error, failure));
      },
    );
    return () => close();
  };
}
