/** How far a job is, and the buttons that begin and cancel one. */

import { t } from "../../texts/index.ts";
import type { JobInfo } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";

const WORDS: Record<JobInfo["state"], string> = {
  queued: t("Waiting for its turn"),
  running: t("Computing"),
  succeeded: t("Done"),
  failed: t("Failed"),
  cancelled: t("Cancelled"),
};

export class Progress {
  readonly host: HTMLElement;
  #bar = element("progress", { class: "progress", max: 1, value: 0, "aria-label": t("Progress") });
  #words = element("p", { class: "muted small", role: "status" });
  #begin: HTMLButtonElement;
  #cancel: HTMLButtonElement;

  constructor(begin: () => void, cancel: () => void) {
    this.#begin = button(t("Compute"), begin, { class: "button primary" });
    this.#cancel = button(t("Cancel"), cancel, { hidden: true });
    this.host = element(
      "div",
      { class: "part" },
      element("div", { class: "bar" }, this.#begin, this.#cancel, this.#bar),
      this.#words,
    );
    this.show(null);
  }

  /** A job, or that there is none. */
  show(job: JobInfo | null): void {
    const isOver = job === null || !["queued", "running"].includes(job.state);
    this.#begin.hidden = !isOver;
    this.#cancel.hidden = isOver;
    this.#bar.hidden = job === null;
    this.#bar.value = job?.progress ?? 0;
    this.host.dataset["state"] = job?.state ?? "none";
    const share =
      job && !["succeeded", "queued"].includes(job.state)
        ? t(" at {progress} %", { progress: Math.floor(100 * job.progress) })
        : "";
    const reason = job?.error ? `: ${job.error.detail}` : "";
    this.#words.textContent = job ? `${WORDS[job.state]}${share}${reason}.` : "";
    this.#words.hidden = job === null;
    if (job && !isOver) this.#words.textContent += t(" It goes on when this panel is closed.");
  }
}
