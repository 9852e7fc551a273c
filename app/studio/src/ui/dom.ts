/** Elements without a framework. Nothing is ever parsed as HTML, and styles are classes: the page's policy has it so. */

import { info } from "./info.ts";

type Child = Node | string | null | undefined | false;
type Listener = (event: never) => void;
type Properties = Record<string, string | number | boolean | null | undefined | Listener>;

/** An element; `onclick` and the like are listeners, `true` is an attribute without a value, `false` none. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, String(value));
  }
  made.append(
    ...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false),
  );
  return made;
}

/** A title or label, and beside it what it means where it is a term of the field. */
export function explained(made: HTMLElement, title: string): HTMLElement {
  const explanation = info(title);
  return explanation ? element("div", { class: "explained" }, made, explanation) : made;
}

/** A titled part of a panel, with what the title means. */
export function section(title: string, ...children: Child[]): HTMLElement {
  return element("section", { class: "section" }, explained(element("h2", {}, title), title), ...children);
}

/** A titled part with choices beside its title. */
export function titled(title: string, choices: readonly HTMLElement[], ...children: Child[]): HTMLElement {
  const made = section(title, ...children);
  made.prepend(
    element("div", { class: "bar" }, made.firstElementChild, element("span", { class: "spring" }), ...choices),
  );
  return made;
}

export function button(text: string, onclick: () => void, properties: Properties = {}): HTMLButtonElement {
  return element("button", { type: "button", class: "button", onclick, ...properties }, text);
}

/** A choice of few: buttons in a row, one of them pressed. */
export class Choice<T extends string> {
  readonly host: HTMLElement;
  #buttons: Map<T, HTMLButtonElement>;

  constructor(title: string, options: readonly { value: T; text: string }[], choose: (value: T) => void) {
    this.#buttons = new Map(
      options.map(({ value, text }) => [value, button(text, () => choose(value), { class: "choice-option" })]),
    );
    this.host = element("div", { class: "choice", role: "group", "aria-label": title }, ...this.#buttons.values());
  }

  /** Take an option away, with the reason, or give it back. */
  allow(value: T, reason: string | null): void {
    const made = this.#buttons.get(value)!;
    made.disabled = reason !== null;
    made.title = reason ?? "";
  }

  show(chosen: T): void {
    for (const [value, made] of this.#buttons) made.setAttribute("aria-pressed", String(value === chosen));
  }
}

/** A button that is on or off. */
export function toggle(text: string, title: string, flip: () => void): HTMLButtonElement {
  return button(text, flip, { class: "toggle", title, "aria-pressed": "false" });
}

/** Has the keyboard reach what it observes, and move it by the arrow keys, while that is wider than its place. */
export function reaching(): ResizeObserver {
  return new ResizeObserver((entries) => {
    for (const { target } of entries) {
      if (target.scrollWidth > target.clientWidth) (target as HTMLElement).tabIndex = 0;
      else target.removeAttribute("tabindex");
    }
  });
}
