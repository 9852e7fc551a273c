/** A name for what becomes a robot of the service; where it is taken, a free one, or the place of the robot that has it. */

import { asProblem, Problem } from "../../api.ts";
import { isName } from "../../robot/upload.ts";
import { t } from "../../texts/index.ts";
import { button, element } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";

interface Naming {
  id: string;
  label: string;
  /** What the button says that adds it. */
  add: string;
  /** Add it under a name, or replace the robot of that name. */
  send: (name: string, replace: boolean) => Promise<void>;
  /** It was refused, which is shown already. */
  refused?: (problem: Problem) => void;
}

/** The field, its buttons, and what the service says; `submit` adds it, as the button does. */
export function naming({ id, label, add, send, refused }: Naming) {
  const problem = new ProblemView();
  const name = element("input", { type: "text", class: "text", id, autocomplete: "off", spellcheck: "false" });
  let taken = "";
  const submit = async (replace = false) => {
    const wanted = replace ? taken : name.value.trim();
    problem.show(
      isName(wanted)
        ? null
        : new Problem(
            422,
            t("This is no name"),
            "1 to 64 letters, digits, _, . or -, the first one a letter or digit.",
          ),
    );
    if (!isName(wanted)) return;
    adding.disabled = exchange.disabled = true;
    try {
      await send(wanted, replace);
      offer(null, "");
    } catch (error) {
      const found = asProblem(error);
      problem.show(found);
      offer(found, wanted);
      refused?.(found);
    } finally {
      adding.disabled = exchange.disabled = false;
    }
  };
  /** A robot of the catalogue cannot be replaced. */
  const offer = (found: Problem | null, wanted: string) => {
    const { free, is_ours } = found?.facts ?? {};
    const isTaken = found?.status === 409 && is_ours !== undefined;
    exchange.hidden = !isTaken || is_ours === true;
    taken = wanted;
    exchange.textContent = t("Replace {wanted}", { wanted });
    if (isTaken && typeof free === "string") name.value = free;
  };
  const adding = button(add, () => void submit(), { class: "button primary" });
  const exchange = button("", () => void submit(true), { hidden: true });
  const host = element(
    "div",
    { class: "keep" },
    element("label", { class: "field", for: id }, label),
    element("div", { class: "bar" }, name, adding, exchange),
    problem.host,
  );
  return { host, name, adding, problem, submit, forget: () => offer(null, "") };
}
