/** Workspace: where the tip gets to, computed by a job of the service, and looked into. */

import { asProblem } from "../../api.ts";
import "../../styles/workspace.css";

import { shownChain } from "../../robot/chain.ts";
import { surroundings } from "../../scene/objects.ts";
import { choosing } from "../../state.ts";
import { t } from "../../texts/index.ts";
import type { JobInfo } from "../../types.ts";
import { titled } from "../../ui/dom.ts";
import { ProblemView } from "../../ui/problem.ts";
import { UNITS } from "../../ui/quantity.ts";
import { RequestView } from "../../ui/request.ts";
import { whileKept } from "../kept.ts";
import type { Panel, Studio } from "../panel.ts";
import { Follower } from "./job.ts";
import { Outcome } from "./outcome.ts";
import { Progress } from "./progress.ts";
import { Settings } from "./settings.ts";

export const workspacePanel: Panel = {
  id: "workspace",
  title: t("Workspace"),
  open: (host, studio) =>
    whileKept(host, studio, () => {
      const panel = new WorkspacePanel(host, studio);
      return () => panel.close();
    }),
};

/** The job that is shown: in the address bar, so that it is there again after a reload. */
const JOB = "workspace.job";

class WorkspacePanel {
  #request: RequestView;
  #problem = new ProblemView();
  #settings: Settings;
  #progress: Progress;
  #outcome: Outcome;
  #follower: Follower;
  #followed: string | null = null;
  #stops: (() => void)[];

  constructor(
    host: HTMLElement,
    private readonly studio: Studio,
  ) {
    const { store, api } = studio;
    this.#request = new RequestView(api, t("the job"));
    const resultRequest = new RequestView(api, t("its result"));
    this.#settings = new Settings(store);
    this.#progress = new Progress(
      () => void this.#guarded(() => this.#begin()),
      () => void this.#guarded(() => this.#cancel()),
    );
    this.#outcome = new Outcome(studio, {
      remove: () => void this.#guarded(() => this.#remove()),
      failed: (error) => this.#problem.show(asProblem(error)),
    });
    this.#follower = new Follower(api, resultRequest.api, {
      progress: (job) => {
        this.#problem.show(null);
        this.#progress.show(job);
      },
      result: (result) => this.#outcome.show(result),
      failed: (problem) => {
        this.#problem.show(problem);
        if (problem.status === 404) this.#remember(null);
      },
    });
    host.append(
      titled(t("Workspace"), [this.#settings.kinds.host], this.#settings.host, this.#progress.host, this.#problem.host),
      ...this.#outcome.hosts,
      this.#request.host,
      resultRequest.host,
    );
    this.#stops = [
      store.watch(["options", ...UNITS], () => this.#settings.update()),
      store.watch(["options"], ({ options }) => this.#follow(options[JOB] ?? null)),
      store.watch(["model"], () => this.#outcome.draw()),
      store.watch(["options", "positions", "dark", ...UNITS], () => this.#outcome.place()),
      store.watch(UNITS, () => this.#outcome.measure()),
    ];
  }

  /** The job goes on. */
  close(): void {
    for (const stop of this.#stops) stop();
    this.#follower.stop();
    this.#outcome.close();
  }

  #remember(job: string | null): void {
    const { store } = this.studio;
    store.set(choosing(store.value, JOB, job));
  }

  #follow(job: string | null): void {
    if (job === this.#followed) return;
    this.#followed = job;
    this.#progress.show(null);
    this.#outcome.show(null);
    if (job === null) this.#follower.stop();
    else void this.#follower.follow(job);
  }

  async #begin(): Promise<void> {
    const { value } = this.studio.store;
    const chain = shownChain(value);
    if (!chain?.path) return;
    const call = { ...this.#settings.call, ...chain.ends, ...surroundings(value.scene, chain.others) };
    const job = await this.#request.api.post<JobInfo>(`${chain.path}/workspace`, call);
    this.#remember(job.id);
  }

  async #cancel(): Promise<void> {
    if (this.#followed) this.#progress.show(await this.#follower.cancel(this.#followed));
  }

  async #remove(): Promise<void> {
    if (this.#followed) await this.#follower.remove(this.#followed);
    this.#remember(null);
  }

  async #guarded(work: () => Promise<void>): Promise<void> {
    this.#problem.show(null);
    try {
      await work();
    } catch (error) {
      this.#problem.show(asProblem(error));
    }
  }
}
