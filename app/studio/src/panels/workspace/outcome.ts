/** The result of a job on the screen: its cloud with a scale of colours and a section, and its numbers. */

import { t } from "../../texts/index.ts";
import type { WorkspaceSummary } from "../../types.ts";
import { button, element, section } from "../../ui/dom.ts";
import type { Studio } from "../panel.ts";
import { Cloud } from "./cloud.ts";
import type { Result } from "./job.ts";
import { Legend } from "./legend.ts";
import { type Actions, meaning, Results } from "./results.ts";
import { SectionControls } from "./section.ts";

export class Outcome {
  readonly hosts: readonly HTMLElement[];
  #legend = new Legend();
  #section: SectionControls;
  #results: Results;
  #elsewhere = element("div", { class: "bar", hidden: true });
  #picture: HTMLElement;
  #numbers: HTMLElement;
  #cloud: Cloud | null;
  #result: Result | null = null;

  constructor(
    private readonly studio: Studio,
    actions: Omit<Actions, "goToBest">,
  ) {
    const goToBest = (summary: WorkspaceSummary) => this.#goToBest(summary);
    this.#section = new SectionControls(studio.store);
    this.#results = new Results(studio.api, { ...actions, goToBest });
    this.#picture = section(t("Picture"), this.#legend.host, this.#section.host);
    this.#numbers = section(t("Result"), this.#elsewhere, this.#results.host);
    this.#cloud = studio.view && new Cloud(studio.view);
    this.hosts = [this.#picture, this.#numbers];
  }

  show(result: Result | null): void {
    this.#result = result;
    this.draw();
  }

  /** Draw the result on its own robot; on another one say whose it is. */
  draw(): void {
    const { model } = this.studio.store.value;
    const result = this.#result;
    const isHere = result !== null && model?.name === result.summary.robot;
    this.#picture.hidden = !isHere;
    this.#numbers.hidden = result === null;
    this.#elsewhere.hidden = isHere;
    this.#cloud?.clear();
    this.#results.clear();
    if (result === null) return;
    if (!isHere) {
      this.#offer(result.summary.robot);
      return;
    }
    const { table, summary } = result;
    const { title, range } = meaning(result);
    this.#legend.show(title, range);
    this.#cloud?.show(table, summary, range);
    this.measure();
    this.place();
  }

  /** The numbers, in the units of the page. */
  measure(): void {
    const { model } = this.studio.store.value;
    const summary = this.#result?.summary;
    if (!summary || model?.name !== summary.robot) return;
    this.#results.show(this.#result!, model.chain(summary.base_frame, summary.tip_frame), this.studio.store.value);
  }

  /** Where the base frame is, and where the cloud is cut. */
  place(): void {
    const { model } = this.studio.store.value;
    const summary = this.#result?.summary ?? null;
    const cut = this.#section.update(summary);
    if (summary && model?.name === summary.robot) this.#cloud?.place(model.link(summary.base_frame).matrixWorld, cut);
  }

  close(): void {
    this.#cloud?.close();
  }

  #offer(robot: string): void {
    this.#elsewhere.replaceChildren(
      element("span", {}, t("The last workspace is that of {robot}.", { robot })),
      button(t("Show {robot}", { robot }), () => this.studio.store.set({ robot, draft: null, base: null, tip: null })),
    );
  }

  #goToBest({ joint_names, measure }: WorkspaceSummary): void {
    const { store } = this.studio;
    const best = Object.fromEntries(joint_names.map((name, i) => [name, measure.joint_positions![i]!]));
    store.set({ positions: { ...store.value.positions, ...best } });
  }
}
