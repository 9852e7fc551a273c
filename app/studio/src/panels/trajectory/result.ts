/** What came of a plan: the player, the profiles, the audit, and the motion in the picture. */

import type { Api } from "../../api.ts";
import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import { chosenOf, isSame, SI } from "../../ui/quantity.ts";
import type { View } from "../../view/view.ts";
import type { Plan } from "./answer.ts";
import type { ClearancePlot } from "./clearance.ts";
import { Curve } from "./curve.ts";
import type { Draft } from "./draft.ts";
import { drawings } from "./drawings.ts";
import { Filming } from "./filming.ts";
import { belongs, request } from "./motion.ts";
import { Player } from "./player.ts";
import { Profiles } from "./profiles.ts";
import { Saving } from "./saving.ts";
import { type MotionMarks, tipPath } from "./scene.ts";
import { choiceText } from "./tool.ts";
import { Torques } from "./torques.ts";
import { auditTable, failureBox, replacedLaws, timingTable } from "./verdict.ts";

export class Result {
  readonly host: HTMLElement;
  #plan: Plan | null = null;
  #units = SI;
  #curve: Curve | null = null;
  #player = new Player((time) => this.#move(time));
  #profiles: Profiles;
  #title = element("h2", { tabindex: -1 });
  #saving: Saving;
  #filming: Filming;
  #ended = element("div");
  #replaced = element("ul", { class: "replaced", "aria-label": t("Laws that were replaced"), hidden: true });
  #drawings = element("div");
  #body = element("div", { class: "part" });

  constructor(
    private readonly draft: Draft,
    private readonly api: Api,
    private readonly clearance: ClearancePlot,
    private readonly marks: MotionMarks | null,
    view: View | null,
  ) {
    this.#saving = new Saving(api, () => {
      const { motion, scene, others } = this.#plan!;
      return { name: motion.robot, path: `${draft.chain.path}/trajectory`, body: request(motion, scene, others) };
    });
    this.#filming = new Filming(view, () => ({
      name: this.#plan!.motion.robot,
      duration: this.#curve!.duration,
      show: (time) => draft.goTo(this.#curve!.at(time)),
      leave: () => {
        if (this.#plan && belongs(this.#plan.motion, draft.chain)) this.#player.seek(this.#player.time);
      },
    }));
    this.#profiles = new Profiles(draft.store, (time) => this.#player.seek(time));
    clearance.go = (time) => this.#player.seek(time);
    this.host = element(
      "section",
      { class: "section", hidden: true },
      element("div", { class: "bar" }, this.#title, element("span", { class: "spring" }), this.#saving.host),
      this.#saving.problem.host,
      this.#ended,
      this.#replaced,
      this.#player.host,
      this.#filming.host,
      this.#profiles.host,
      clearance.host,
      this.#drawings,
      this.#body,
    );
  }

  /** The plan of the chain on the screen, if there is one. */
  update(): void {
    const { store, chain } = this.draft;
    const { plan } = store.value;
    const shown = plan && belongs(plan.motion, chain) ? plan : null;
    this.host.hidden = shown === null;
    const isOther = shown !== this.#plan;
    if (isOther) {
      this.#plan = shown;
      this.#curve = shown && new Curve(shown.answer);
      this.#player.load(this.#curve?.duration ?? 0);
    }
    const hasOtherUnits = !isSame(store.value, this.#units);
    this.#units = chosenOf(store.value);
    if (isOther || hasOtherUnits) this.#tell();
    if (hasOtherUnits) this.clearance.draw();
    if (!isOther) return;
    this.#saving.problem.show(null);
    this.#filming.forget();
    this.drawWay();
    void this.clearance.show(chain, shown, this.#curve);
    this.#drawings.replaceChildren(...(shown && this.#curve ? [drawings(this.api, chain, shown, this.#curve)] : []));
  }

  /** The way of the tip, in the colours of the page and the size of the robot. */
  drawWay(): void {
    const { chain, store } = this.draft;
    const failure = this.#plan?.answer.failure ?? null;
    this.marks?.showWay(this.#curve && tipPath(chain, this.#curve), failure, store.value.unit);
  }

  drawProfiles(): void {
    this.#profiles.draw();
    this.clearance.draw();
  }

  /** Bring a joint's lines to the front. */
  point(joint: string | null): void {
    this.#profiles.point(joint);
  }

  /** The robot goes to the beginning. */
  begin(): void {
    this.#player.seek(0);
  }

  /** Bring it into sight, and the keyboard to it. */
  reveal(): void {
    const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.host.scrollIntoView({ block: "start", behavior: isCalm ? "instant" : "smooth" });
    this.#title.focus({ preventScroll: true });
  }

  stop(): void {
    this.#player.pause();
    this.#filming.stop();
    this.#profiles.stop();
    this.clearance.stop();
  }

  #tell(): void {
    if (!this.#plan || !this.#curve) return this.#profiles.show(null, 0);
    const { answer } = this.#plan;
    const { chain, units } = this.draft;
    const torques = answer.joint_torques ? new Torques(answer, this.#curve) : null;
    this.#profiles.show({ curve: this.#curve, torques, answer, joints: chain.joints }, this.#player.time);
    const go = (time: number) => this.#player.seek(time);
    this.#title.textContent = t("Motion of {duration} s", { duration: answer.duration.toFixed(3) });
    const failure = failureBox(answer, units, go, (configuration) => this.draft.goTo(configuration));
    const timing = timingTable(answer);
    const choice = choiceText(answer, units);
    const notes = [
      ...answer.notes,
      ...answer.segments.flatMap(({ index, notes }) =>
        notes.map((note) => t("Segment {index}: {note}", { index: index + 1, note })),
      ),
    ];
    const replaced = replacedLaws(this.#plan.motion, answer.segments);
    this.#replaced.hidden = replaced.length === 0;
    this.#replaced.replaceChildren(
      ...replaced.map((text) => element("li", {}, t("{text}; the notes say why.", { text }))),
    );
    this.#ended.hidden = failure === null;
    this.#ended.replaceChildren(...(failure ? [failure] : []));
    this.#body.replaceChildren(
      ...(choice ? [choice] : []),
      auditTable(answer, chain.joints, units, go),
      ...(timing ? [timing] : []),
      ...(notes.length ? [remarks(notes)] : []),
    );
  }

  #move(time: number): void {
    this.#profiles.at(time);
    this.clearance.at(time);
    this.draft.goTo(this.#curve!.at(time));
  }
}

function remarks(notes: string[]): HTMLElement {
  return element(
    "details",
    {},
    element("summary", {}, t("Notes ({length})", { length: notes.length })),
    element("ul", { class: "remarks" }, ...notes.map((note) => element("li", {}, note))),
  );
}
