/** The picture alone, in a frame of another page: no panels, and a link to the studio as it is here. */

import { write } from "./address.ts";
import { comparePanel } from "./panels/compare/index.ts";
import type { Studio } from "./panels/panel.ts";
import { t } from "./texts/index.ts";
import { element } from "./ui/dom.ts";

/** Whether this page is the one for frames. */
export const isEmbedded = location.pathname.endsWith("/embed");

/** Leave the picture alone on the page. */
export function embed(stage: HTMLElement, studio: Studio): void {
  const { store } = studio;
  document.documentElement.dataset["mode"] = "embed";
  const link = element("a", { class: "tool away", target: "_blank", rel: "noopener", href: "." }, t("Open in Gelenk"));
  const lead = () => (link.href = `.${write(store.value)}`);
  for (const event of ["pointerenter", "focus", "click"]) link.addEventListener(event, lead);
  const status = element("p", { class: "status", role: "status" });
  stage.append(link, status);
  store.watch(["loading", "failure"], ({ loading, failure }) => {
    status.textContent = loading ? t("Loading …") : (failure?.detail ?? "");
  });
  // What is compared is part of the picture.
  if (store.value.panel === comparePanel.id)
    void import("./panels/compare/compare.ts").then(({ accompany }) => accompany(studio));
  store.watch(["model"], ({ model }) => {
    if (model) document.title = `${model.title} · Gelenk`;
  });
}
