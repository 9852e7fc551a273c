/** Whether the service answers. What asks it meanwhile waits here, and a line on the page says so. */

import { t } from "./texts/index.ts";
import { button, element } from "./ui/dom.ts";

const PAUSE = 2000; // between two looks whether it is back, [ms]

export class Connection {
  #back: Promise<void> | null = null;
  #ask: () => void = () => {};

  /**
   * @param url that answers where the service runs.
   * @param returned is told when it answers again.
   */
  constructor(
    private readonly url: string,
    private readonly returned: () => void,
  ) {}

  /** Wait until it answers again; rejects where the caller no longer wants to. */
  back(signal?: AbortSignal): Promise<void> {
    this.#back ??= this.#look().finally(() => (this.#back = null));
    return Promise.race([this.#back, aborted(signal)]);
  }

  async #look(): Promise<void> {
    const line = element(
      "p",
      { class: "lost", role: "alert" },
      t("The service does not answer. Is it still running? This page goes on by itself when it is back. "),
      button(t("Try now"), () => this.#ask(), { class: "button small" }),
    );
    document.body.append(line);
    do {
      await new Promise<void>((done) => {
        this.#ask = done;
        setTimeout(done, PAUSE);
      });
    } while (!(await this.#answers()));
    line.remove();
    this.returned();
  }

  async #answers(): Promise<boolean> {
    try {
      return (await fetch(this.url, { cache: "no-store" })).ok;
    } catch {
      return false;
    }
  }
}

function aborted(signal?: AbortSignal): Promise<never> {
  return new Promise((_, fail) => {
    if (signal?.aborted) fail(signal.reason);
    signal?.addEventListener("abort", () => fail(signal.reason));
  });
}
