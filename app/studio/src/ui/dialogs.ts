/** What the page asks or tells in front of everything else. */

import { t } from "../texts/index.ts";
import { button, element } from "./dom.ts";

/** Ask for a key; null where it is left at that. */
export function askForKey(reason: string): Promise<string | null> {
  return new Promise((done) => {
    const field = element("input", {
      class: "text",
      type: "password",
      autocomplete: "off",
      spellcheck: "false",
      required: true,
      "aria-label": t("Key"),
    });
    let given: string | null = null;
    const use = (event: Event) => {
      event.preventDefault(); // nothing is sent: the key goes with the calls
      given = field.value.trim() || null;
      shown.close();
    };
    const shown = dialog(
      t("This service wants a key"),
      () => done(given),
      element("p", {}, reason),
      element(
        "form",
        { onsubmit: use },
        element("label", { class: "setting" }, element("span", { class: "field" }, t("Key")), field),
        element("p", { class: "muted small" }, t("It is kept for this tab alone, and sent to this service alone.")),
        element(
          "div",
          { class: "bar" },
          element("button", { type: "submit", class: "button primary" }, t("Use it")),
          button(t("Cancel"), () => shown.close()),
        ),
      ),
    );
    field.focus();
  });
}

/** Ask whether something is to be done that cannot be undone; the button that does it is named. */
export function confirmed(title: string, text: string, does: string): Promise<boolean> {
  return new Promise((done) => {
    let isWanted = false;
    const close = (wanted: boolean) => () => {
      isWanted = wanted;
      shown.close();
    };
    const shown = dialog(
      title,
      () => done(isWanted),
      element("p", {}, text),
      element(
        "div",
        { class: "bar" },
        button(t("Cancel"), close(false)),
        button(does, close(true), { class: "button danger" }),
      ),
    );
  });
}

const SHORTCUTS: readonly { where: string; keys: readonly (readonly [string, string])[] }[] = [
  {
    where: t("Anywhere"),
    keys: [
      ["?", t("This list")],
      [t("Ctrl Z"), t("Undo; in a field, first what is being typed")],
      [t("Ctrl Shift Z, Ctrl Y"), t("Redo")],
      [t("Tab, Shift Tab"), t("To the next control, or the one before")],
    ],
  },
  {
    where: t("While presenting"),
    keys: [
      [t("Page Up, Page Down"), t("The panel before, the next one")],
      ["H", t("Hide the panel, or show it")],
      [t("Escape"), t("Leave")],
    ],
  },
  { where: t("On the tabs"), keys: [["← →", t("The panel beside")]] },
  {
    where: t("On the picture"),
    keys: [
      ["← → ↑ ↓", t("Turn")],
      ["+ −", t("Nearer, farther")],
      [t("Home"), t("The whole robot")],
    ],
  },
  {
    where: t("In a number"),
    keys: [
      ["↑ ↓", t("A step up or down, where it has steps; with Shift ten")],
      [t("Enter"), t("Take what is typed")],
      [t("Escape"), t("Forget what is typed")],
    ],
  },
  {
    where: t("On a slider"),
    keys: [
      ["← → ↑ ↓", t("A hundredth of its range")],
      [t("Page Up, Page Down"), t("A tenth")],
    ],
  },
  {
    where: t("On the construction of a DH table"),
    keys: [
      ["← →", t("A motion back, or on")],
      [t("Home, End"), t("To the first frame, to the last")],
      [t("Space"), t("Play, pause")],
    ],
  },
  {
    where: t("On the tour"),
    keys: [
      ["← →", t("A step back, or on")],
      [t("Escape"), t("Leave")],
    ],
  },
  { where: t("On the time of a motion"), keys: [[t("Space"), t("Play, pause")]] },
];

/** What the keyboard does. */
export function showShortcuts(): void {
  if (document.querySelector("dialog[open]")) return;
  const rows = SHORTCUTS.flatMap(({ where, keys }) => [
    element("tr", {}, element("th", { scope: "rowgroup", colspan: "2" }, where)),
    ...keys.map(([key, does]) =>
      element("tr", {}, element("td", {}, element("kbd", {}, key)), element("td", {}, does)),
    ),
  ]);
  const shown = dialog(
    t("Keyboard"),
    () => {},
    element("table", { class: "shortcuts" }, element("tbody", {}, ...rows)),
    element(
      "div",
      { class: "bar" },
      button(t("Close"), () => shown.close(), { class: "button primary" }),
    ),
  );
}

/** "?" wherever nothing is being typed. */
export function listenForHelp(): void {
  document.addEventListener("keydown", (event) => {
    const isTyped = event.target instanceof HTMLInputElement && event.target.type !== "range";
    if (event.key !== "?" || isTyped || event.target instanceof HTMLTextAreaElement) return;
    event.preventDefault();
    showShortcuts();
  });
}

/** A dialog in front of the page; gone when it is closed, by Escape too. */
export function dialog(title: string, closed: () => void, ...children: (HTMLElement | null)[]): HTMLDialogElement {
  const made = element(
    "dialog",
    {
      class: "dialog",
      "aria-label": title,
      onclose: () => {
        made.remove();
        closed();
      },
    },
    element("h2", {}, title),
    ...children,
  );
  document.body.append(made);
  made.showModal();
  return made;
}
