/** Small pictures of robots, fetched when they come into sight; for robots without one a neutral picture. */

import pictures from "gelenk:thumbnails";

import { element } from "./dom.ts";

const [WIDTH, HEIGHT] = [256, 192]; // px, as they are drawn

export function thumbnail(robot: string): HTMLElement {
  const file = Object.hasOwn(pictures, robot) ? pictures[robot] : undefined;
  return file ? image(`studio/${file}`) : neutral();
}

export function neutral(): HTMLElement {
  return image("studio/neutral.svg");
}

/** What it shows stands beside it in words. */
function image(src: string): HTMLElement {
  return element("img", { class: "thumbnail", src, alt: "", loading: "lazy", width: WIDTH, height: HEIGHT });
}
