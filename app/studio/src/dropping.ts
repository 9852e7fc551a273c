/** Files dropped anywhere on the page. */

import { dropMesh } from "./panels/cell/meshes.ts";
import { drop } from "./panels/robot/upload.ts";
import { isMesh } from "./scene/stored.ts";

/** @param open shows the panel that a dropped file goes to. */
export function acceptDrops(sign: HTMLElement, open: (panel: "cell" | "robot") => void): void {
  const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  window.addEventListener("dragover", (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    sign.hidden = false;
  });
  window.addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) sign.hidden = true;
  });
  window.addEventListener("drop", (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    sign.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    if (isMesh(file)) dropMesh(file);
    else drop(file);
    open(isMesh(file) ? "cell" : "robot");
  });
}
