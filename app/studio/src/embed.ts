/** The picture alone, in a frame of another page: no panels, and a link to the studio as it is here. */

import { write } from "./address.ts";
import type { State } from "./state.ts";
import type { Store } from "./store.ts";
import { element } from "./ui/dom.ts";

/** Whether this page is the one for frames. */
export const isEmbedded = location.pathname.endsWith("/embed");

/** Leave the picture alone on the page. */
export function embed(stage: HTMLElement, store: Store<State>): void {
  document.documentElement.dataset["mode"] = "embed";
  const link = element("a", { class: "tool away", target: "_blank", rel: "noopener", href: "." }, "Open in Gelenk");
  const lead = () => (link.href = `.${write(store.value)}`);
  for (const event of ["pointerenter", "focus", "click"]) link.addEventListener(event, lead);
  const status = element("p", { class: "status", role: "status" });
  stage.append(link, status);
  store.watch(["loading", "failure"], ({ loading, failure }) => {
    status.textContent = loading ? "Loading …" : (failure?.detail ?? "");
  });
  store.watch(["model"], ({ model }) => {
    if (model) document.title = `${model.title} · Gelenk`;
  });
}
