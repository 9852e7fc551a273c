/** What others can have of the page as it is: a link, a frame for another page, a line for a notebook, the picture. */

import { MARKS, write } from "./address.ts";
import type { Studio } from "./panels/panel.ts";
import type { State } from "./state.ts";
import { t } from "./texts/index.ts";
import { copyButton } from "./ui/copy.ts";
import { dialog } from "./ui/dialogs.ts";
import { button, element } from "./ui/dom.ts";
import { save } from "./ui/files.ts";

/** Show the dialog. */
export function share({ store, view, api }: Studio): void {
  if (document.querySelector("dialog[open]")) return;
  const state = store.value;
  const title = state.model?.title ?? "Gelenk";
  const remark = element("p", { class: "muted small" });
  void framing(api.url("embed")).then((text) => (remark.textContent = text));
  const shown = dialog(
    t("Share"),
    () => {},
    text(t("A link to this page"), api.url(`.${write(state)}`)),
    text(t("A frame with this picture, for another page"), frame(api.url(`embed${write(state)}`), title)),
    remark,
    state.model?.name ? text(t("The same in a notebook"), notebook(state)) : null,
    element(
      "div",
      { class: "bar" },
      button(t("Close"), () => shown.close(), { class: "button primary" }),
      view &&
        button(t("Save the picture"), () => void view.picture().then((png) => save(`${title}.png`, "image/png", png)), {
          title: t("A PNG of what is drawn, without the names on it"),
        }),
    ),
  );
}

function text(title: string, content: string): HTMLElement {
  return element(
    "section",
    { class: "part" },
    element(
      "div",
      { class: "bar" },
      element("h3", {}, title),
      element("span", { class: "spring" }),
      copyButton(() => content, title),
    ),
    element("code", { class: "shared", tabindex: "0" }, content),
  );
}

function frame(url: string, title: string): string {
  const escaped = (words: string) => words.replaceAll("&", "&amp;").replaceAll('"', "&quot;");
  return `<iframe src="${escaped(url)}" title="${escaped(title)}" width="640" height="420"></iframe>`;
}

/** A call of `gelenk.show`, in Python. */
function notebook(state: Readonly<State>): string {
  const { model, base, tip, positions } = state;
  const marks = MARKS.filter((mark) => state[mark]);
  const named = [
    ...(base === null ? [] : [`base_frame=${JSON.stringify(base)}`]),
    ...(tip === null ? [] : [`tip_frame=${JSON.stringify(tip)}`]),
    ...(marks.length ? [`marks=${JSON.stringify(marks)}`] : []),
  ];
  const numbers = model!.joints.map(({ name }) => positions[name] ?? 0);
  const given = [JSON.stringify(model!.name), `[${numbers.join(", ")}]`, ...named];
  return `import gelenk\ngelenk.show(${given.join(", ")})`;
}

/** Which pages the service lets show it. */
async function framing(url: string): Promise<string> {
  try {
    const policy = (await fetch(url)).headers.get("Content-Security-Policy") ?? "";
    const allowed = /frame-ancestors ([^;]*)/.exec(policy)?.[1] ?? "'none'";
    if (allowed === "'none'")
      return "This service lets no other page show it yet: its setting GELENK_FRAME_ANCESTORS names those that may.";
    return allowed === "*" ? t("Any page may show it.") : t("Pages of {allowed} may show it.", { allowed });
  } catch {
    return t("The service does not answer now, so that it is unknown which pages may show it.");
  }
}
