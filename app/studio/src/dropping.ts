/** Files dropped anywhere on the page. */

import { drop } from "./panels/robot/upload.ts";

/** @param open shows where a dropped file goes. */
export function acceptDrops(sign: HTMLElement, open: () => void): void {
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
    drop(file);
    open();
  });
}
