/** Formulas, set by KaTeX. It builds elements (`render`, never `renderToString`): the page allows no inline style. */

import katex from "katex";
import "katex/dist/katex.min.css";

import { element } from "./dom.ts";

export function formula(latex: string, display = false): HTMLElement {
  const host = element(display ? "div" : "span", { class: display ? "formula display" : "formula" });
  katex.render(latex, host, { displayMode: display, throwOnError: false, output: "htmlAndMathml" });
  return host;
}
