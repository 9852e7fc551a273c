/** Panels whose calls need a robot that the service keeps: for a table that is only typed, they first offer to add it. */

import { shownChain } from "../robot/chain.ts";
import { t } from "../texts/index.ts";
import { element, section } from "../ui/dom.ts";
import type { Studio } from "./panel.ts";
import { keep } from "./robot/keep.ts";

/** Have `open` fill the host while the service keeps the robot on the screen; returns how to undo all of it. */
export function whileKept(host: HTMLElement, studio: Studio, open: () => () => void): () => void {
  const { store } = studio;
  const offer = section(
    t("Add the table to the robots"),
    element(
      "p",
      { class: "muted small" },
      t("This panel asks the service about the robot, which does not keep it yet."),
    ),
    keep(studio, () => store.value.draft),
  );
  let isOpen: boolean | null = null;
  let close: () => void = () => {};
  const stop = store.watch(["model", "draft"], (state) => {
    const isKept = state.draft === null && shownChain(state)?.path != null;
    if (isKept === isOpen || (!isKept && state.draft === null)) return;
    close();
    isOpen = isKept;
    host.replaceChildren();
    close = isKept ? open() : () => {};
    if (!isKept) host.append(offer);
  });
  return () => {
    stop();
    close();
  };
}
