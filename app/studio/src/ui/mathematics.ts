/** Formulas, set by KaTeX. It builds elements (`render`, never `renderToString`): the page allows no inline style. */

import { element } from "./dom.ts";

type Katex = typeof import("katex").default;

/** The robot is on the screen sooner where its page does not wait for this: it comes with the first formula. */
let katex: Katex | null = null;
let arrival: Promise<Katex> | null = null;

/** Rows of matrices are this much further apart than KaTeX has them: as far where a row has a fraction or a root as where
 * none has. `worked.css` has numbers beside them as far apart. */
const MACROS = { "\\arraystretch": "1.1" };

/** A formula: at once, or as soon as KaTeX is there; `made` is told then. */
export function formula(latex: string, display = false, made: (host: HTMLElement) => void = () => {}): HTMLElement {
  const host = element(display ? "div" : "span", { class: display ? "formula display" : "formula" });
  const set = (by: Katex): void => {
    by.render(latex, host, { displayMode: display, throwOnError: false, output: "htmlAndMathml", macros: MACROS });
    made(host);
  };
  if (katex) {
    set(katex);
    return host;
  }
  arrival ??= import("katex").then((module) => (katex = module.default));
  arrival.then(set).catch(() => {
    arrival = null;
    host.textContent = latex;
  });
  return host;
}
