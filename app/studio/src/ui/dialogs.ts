/** What the page asks or tells in front of everything else. */

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
      "aria-label": "Key",
    });
    let given: string | null = null;
    const use = (event: Event) => {
      event.preventDefault(); // nothing is sent: the key goes with the calls
      given = field.value.trim() || null;
      shown.close();
    };
    const shown = dialog(
      "This service wants a key",
      () => done(given),
      element("p", {}, reason),
      element(
        "form",
        { onsubmit: use },
        element("label", { class: "setting" }, element("span", { class: "field" }, "Key"), field),
        element("p", { class: "muted small" }, "It is kept for this tab alone, and sent to this service alone."),
        element(
          "div",
          { class: "bar" },
          element("button", { type: "submit", class: "button primary" }, "Use it"),
          button("Cancel", () => shown.close()),
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
        button("Cancel", close(false)),
        button(does, close(true), { class: "button danger" }),
      ),
    );
  });
}

const SHORTCUTS: readonly { where: string; keys: readonly (readonly [string, string])[] }[] = [
  {
    where: "Anywhere",
    keys: [
      ["?", "This list"],
      ["Tab, Shift Tab", "To the next control, or the one before"],
    ],
  },
  { where: "On the tabs", keys: [["← →", "The panel beside"]] },
  {
    where: "On the picture",
    keys: [
      ["← → ↑ ↓", "Turn"],
      ["+ −", "Nearer, farther"],
      ["Home", "The whole robot"],
    ],
  },
  {
    where: "In a number",
    keys: [
      ["↑ ↓", "A step up or down, where it has steps; with Shift ten"],
      ["Enter", "Take what is typed"],
      ["Escape", "Forget what is typed"],
    ],
  },
  {
    where: "On a slider",
    keys: [
      ["← → ↑ ↓", "A hundredth of its range"],
      ["Page Up, Page Down", "A tenth"],
    ],
  },
  { where: "On the time of a motion", keys: [["Space", "Play, pause"]] },
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
    "Keyboard",
    () => {},
    element("table", { class: "shortcuts" }, element("tbody", {}, ...rows)),
    element(
      "div",
      { class: "bar" },
      button("Close", () => shown.close(), { class: "button primary" }),
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
