/** Pictures that the service draws. As an image such a picture runs nothing and loads nothing, whatever is in it. */

import { type Api, asProblem, type Call } from "../api.ts";
import { button, element } from "./dom.ts";
import { save } from "./files.ts";
import type { ProblemView } from "./problem.ts";

export function svgOf(api: Api, call: Call, signal?: AbortSignal): Promise<string> {
  return api.textOf({ ...call, accept: "image/svg+xml" }, signal);
}

export function imageOf(svg: string, name: string): HTMLImageElement {
  return element("img", { class: "drawing", src: `data:image/svg+xml,${encodeURIComponent(svg)}`, alt: name });
}

/** A picture, and what saves it. */
export function figureOf(svg: string, title: string, file: string, saveTitle: string): HTMLElement {
  const caption = element("span", { class: "spring" }, title);
  const keep = button("SVG", () => save(`${file}.svg`, "image/svg+xml", svg), {
    class: "button small",
    title: saveTitle,
    "aria-label": saveTitle,
  });
  return element("figure", {}, imageOf(svg, title), element("figcaption", { class: "bar" }, caption, keep));
}

/** A button that has the service draw a figure, and the place where it then is. */
export function drawing(
  text: string,
  title: string,
  problem: ProblemView,
  draw: () => Promise<HTMLElement>,
  place = element("div"),
) {
  const ask = async () => {
    problem.show(null);
    try {
      place.replaceChildren(await draw());
    } catch (error) {
      place.replaceChildren();
      problem.show(asProblem(error));
    }
  };
  return { ask: button(text, () => void ask(), { title }), place };
}
