/** A workspace of the service: asked for, followed while it is computed, and fetched. */

import { type Api, asProblem, Latest, NO_ANSWER, Problem } from "../../api.ts";
import { type Table, readTable } from "../../npy.ts";
import { t } from "../../texts/index.ts";
import type { JobInfo, WorkspaceSummary } from "../../types.ts";

export interface Result {
  id: string;
  summary: WorkspaceSummary;
  table: Table;
  /** The same as a file. */
  npy: ArrayBuffer;
}

export const NPY = "application/x-npy";

const LOOK = 500; // [ms]
const RETRY = 1000; // after the service has refused to tell events, [ms]
const LOST = new Problem(
  NO_ANSWER,
  t("The service has fallen silent"),
  t("The job may be running all the same: as soon as the service answers, its progress goes on here."),
);

/** What the one who follows a job is told. */
export interface Listener {
  progress(job: JobInfo): void;
  result(result: Result): void;
  failed(problem: Problem): void;
}

/** The last one, so that a panel that is opened again need not fetch it again. */
let last: Result | null = null;

export class Follower {
  #latest = new Latest();
  #events: EventSource | null = null;
  #retry = 0;

  /** @param result the API through which results are fetched. */
  constructor(
    private readonly api: Api,
    private readonly result: Api,
    private readonly listener: Listener,
  ) {}

  /** Follow a job from now on, whatever state it is in. */
  async follow(id: string): Promise<void> {
    this.stop();
    await this.#guarded(async (signal) => {
      const job = await this.api.get<JobInfo>(pathOf(id), signal);
      if (signal.aborted) return;
      this.listener.progress(job);
      if (job.state === "queued" || job.state === "running") this.#goOn(id);
      else if (job.state === "succeeded") await this.#fetch(id, signal);
    });
  }

  /** Cancel a job; one that has come to its end meanwhile stays. */
  async cancel(id: string): Promise<JobInfo> {
    return this.api.call<JobInfo>({ method: "DELETE", path: pathOf(id) });
  }

  /** Remove a job with its result. */
  async remove(id: string): Promise<JobInfo> {
    if (last?.id === id) last = null;
    return this.api.call<JobInfo>({ method: "DELETE", path: `${pathOf(id)}?finished=remove` });
  }

  /** Follow nothing any more; the job itself goes on. */
  stop(): void {
    this.#latest.cancel();
    clearTimeout(this.#retry);
    this.#events?.close();
    this.#events = null;
  }

  #goOn(id: string): void {
    // An event stream of the browser carries no key: then the job is looked at again and again.
    if (this.api.key.isSet) this.#retry = window.setTimeout(() => void this.follow(id), LOOK);
    else this.#listen(id);
  }

  /** The service sends what is new; when the connection is lost, the browser takes it up again. */
  #listen(id: string): void {
    const events = new EventSource(this.api.url(`${pathOf(id)}/events`));
    this.#events = events;
    events.addEventListener("progress", ({ data }) => this.listener.progress(JSON.parse(data) as JobInfo));
    events.addEventListener("finished", ({ data }) => {
      const job = JSON.parse(data) as JobInfo;
      this.stop();
      this.listener.progress(job);
      if (job.state === "succeeded") void this.#guarded((signal) => this.#fetch(id, signal));
    });
    events.addEventListener("error", () => {
      const isRefused = events.readyState === EventSource.CLOSED;
      if (isRefused) this.#retry = window.setTimeout(() => void this.follow(id), RETRY);
      else this.listener.failed(LOST);
    });
  }

  async #fetch(id: string, signal: AbortSignal): Promise<void> {
    if (last?.id !== id) {
      const path = `${pathOf(id)}/result`;
      const [summary, npy] = await Promise.all([
        this.result.get<WorkspaceSummary>(path, signal),
        this.api.bytes(path, NPY, signal),
      ]);
      last = { id, summary, table: readTable(npy), npy };
    }
    if (!signal.aborted) this.listener.result(last);
  }

  async #guarded(work: (signal: AbortSignal) => Promise<void>): Promise<void> {
    try {
      await this.#latest.run(work);
    } catch (error) {
      this.listener.failed(asProblem(error));
    }
  }
}

export function pathOf(id: string): string {
  return `v1/jobs/${encodeURIComponent(id)}`;
}
