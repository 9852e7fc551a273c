/** A part of the motion that few need: folded, and opened where the service has something against it. */

import { element } from "../../ui/dom.ts";

/** A field of the request, and what the service says of it. */
export interface Refused {
  pointer: string;
  detail: string;
}

export class Folded {
  readonly host: HTMLDetailsElement;
  readonly body = element("div", { class: "settings-body" });
  #summary = element("span", { class: "muted small" });
  #error = element("p", { class: "segment-error", role: "alert", hidden: true });

  /** @param fields of the request that are set here; an input has that as its name for which it stands. */
  constructor(
    title: string,
    private readonly fields: readonly string[],
  ) {
    this.host = element(
      "details",
      { class: "folded" },
      element("summary", {}, `${title} `, this.#summary),
      this.body,
      this.#error,
    );
  }

  summarise(text: string): void {
    this.#summary.textContent = text;
  }

  /** Show what is said of the fields here; returns the rest. */
  fail(places: readonly Refused[]): Refused[] {
    const own = places.filter(({ pointer }) => this.fields.some((field) => isIn(pointer, field)));
    for (const input of this.body.querySelectorAll("input"))
      input.setAttribute("aria-invalid", String(own.some(({ pointer }) => isIn(pointer, input.name))));
    this.#error.hidden = own.length === 0;
    this.#error.textContent = own.map(({ detail }) => detail).join("; ");
    if (own.length) this.host.open = true;
    return places.filter((place) => !own.includes(place));
  }
}

/** Whether a JSON pointer is to a field, or into it. */
export function isIn(pointer: string, field: string): boolean {
  return `${pointer}/`.startsWith(`#/${field}/`);
}
