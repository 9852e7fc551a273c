/** The key that calls are sent with where the service wants one: asked for when it does, kept for this tab alone. */

import { t } from "./texts/index.ts";

const NAME = "gelenk.key";
const FIRST = t("Whoever runs it makes them, and can give you one.");

/** Asks a person for a key, with the reason; null where there is none to be had. */
export type Asker = (reason: string) => Promise<string | null>;

export class Key {
  /** Whether the service has ever wanted one. */
  isWanted = false;
  #text = remembered();
  #asking: Promise<boolean> | null = null;
  #isRefused = false;

  constructor(
    private readonly ask: Asker,
    private readonly changed: (key: Key) => void = () => {},
  ) {
    this.isWanted = this.isSet;
  }

  get isSet(): boolean {
    return this.#text !== "";
  }

  get text(): string {
    return this.#text;
  }

  /** What a call carries. */
  get headers(): Record<string, string> {
    return this.isSet ? { Authorization: `Bearer ${this.#text}` } : {};
  }

  /** Use another one; none where it is empty. */
  set(text: string): void {
    this.#text = text.trim();
    remember(this.#text);
    this.changed(this);
  }

  /** Whether there is another key than the one that was refused, with that reason; several calls that are refused ask
   * but once. */
  async renew(refused: string, reason: string): Promise<boolean> {
    this.isWanted = true;
    this.changed(this);
    if (this.#text !== refused) return true;
    if (this.#isRefused) return false;
    this.#asking ??= this.#renewed(refused === "" ? FIRST : reason).finally(() => (this.#asking = null));
    return this.#asking;
  }

  async #renewed(reason: string): Promise<boolean> {
    const text = await this.ask(reason);
    this.#isRefused = text === null;
    if (text !== null) this.set(text);
    return text !== null;
  }
}

function remembered(): string {
  try {
    return sessionStorage.getItem(NAME) ?? "";
  } catch {
    return ""; // a browser that keeps nothing: then it lasts until the page is left
  }
}

function remember(text: string): void {
  try {
    sessionStorage.setItem(NAME, text);
  } catch {
    // As above.
  }
}
