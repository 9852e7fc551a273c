/** Which ellipsoids are drawn and at what scale, in words beside the picture. */

import { chosen, choosing } from "../../state.ts";
import { t } from "../../texts/index.ts";
import type { PartAnswer } from "../../types.ts";
import { element, toggle } from "../../ui/dom.ts";
import { lengthText } from "../../ui/quantity.ts";
import type { Studio } from "../panel.ts";
import type { Answers } from "./calls.ts";
import { CUT, fitting, isCut, type Scale, TipPicture } from "./picture.ts";
import { isWeak } from "./singularity.ts";

const SHOWN = ["both", "velocity", "force", "none"] as const;

function shows(value: (typeof SHOWN)[number], which: "velocity" | "force"): boolean {
  return value === "both" || value === which;
}

export class EllipsoidControls {
  readonly host: HTMLElement;
  readonly words = element("p", { class: "muted small" });
  #picture: TipPicture | null;
  #toggles: Record<"velocity" | "force" | "hold", HTMLButtonElement>;
  #held: Scale | null = null;
  #answers: Answers | null = null;

  constructor(private readonly studio: Studio) {
    this.#picture = studio.view && new TipPicture(studio.view);
    const { store } = studio;
    const flip = (which: "velocity" | "force") => () => {
      const shown = { ...this.#shown, [which]: !this.#shown[which] };
      const name = SHOWN.find(
        (value) => shown.velocity === shows(value, "velocity") && shown.force === shows(value, "force"),
      );
      store.set(choosing(store.value, "jacobian.ellipsoids", name === SHOWN[0] ? null : name!));
    };
    const hold = () => {
      this.#held = this.#held ? null : this.#scale();
      this.draw();
    };
    this.#toggles = {
      velocity: toggle(t("Velocity"), t("Where joint rates of norm one take the tip"), flip("velocity")),
      force: toggle(t("Force"), t("What joint torques of norm one bear at the tip"), flip("force")),
      hold: toggle(t("Hold scale"), t("Keep the scale of the picture while the joints move"), hold),
    };
    this.#toggles.velocity.classList.add("velocity");
    this.#toggles.force.classList.add("force");
    this.host = element("span", { class: "toggles" }, ...Object.values(this.#toggles));
  }

  show(answers: Answers): void {
    if (answers.part !== this.#answers?.part || answers.chain.model !== this.#answers.chain.model) this.#held = null;
    this.#answers = answers;
    this.draw();
  }

  draw(): void {
    const { velocity, force } = this.#shown;
    this.#toggles.velocity.setAttribute("aria-pressed", String(velocity));
    this.#toggles.force.setAttribute("aria-pressed", String(force));
    this.#toggles.hold.setAttribute("aria-pressed", String(this.#held !== null));
    this.words.textContent = this.#words();
    const answers = this.#answers;
    if (!answers || !this.#picture) return;
    const { joint, unit } = this.studio.store.value;
    const { report, columns, chain } = answers;
    const here = report.lost_directions.filter(({ lost_here }) => lost_here).map(({ twist }) => twist);
    const drawn = {
      part: this.#drawable(),
      turns: answers.part.value === "rotation",
      velocity,
      force,
      lost: here.length ? here : this.#weakest(),
      column: columns[chain.joints.findIndex(({ name }) => name === joint)] ?? null,
      scale: this.#scale(),
    };
    this.#picture.show(chain, drawn, unit);
  }

  close(): void {
    this.#picture?.close();
  }

  get #shown(): { velocity: boolean; force: boolean } {
    const value = chosen(this.studio.store.value, "jacobian.ellipsoids", SHOWN);
    return { velocity: shows(value, "velocity"), force: shows(value, "force") };
  }

  get #part(): PartAnswer | null {
    return this.#answers?.axes.results[0]![this.#answers.part.value] ?? null;
  }

  /** Of both parts together there is no picture: of that the translation is drawn. */
  #drawable(): PartAnswer | null {
    const part = this.#answers?.part.value === "combined" ? "translation" : this.#answers?.part.value;
    return (part && this.#answers?.axes.results[0]![part]) ?? null;
  }

  #scale(): Scale {
    return this.#held ?? fitting(this.#drawable(), this.studio.store.value.unit);
  }

  /** The shortest axis as a twist, where it is nearly lost. */
  #weakest(): number[][] {
    const part = this.#part;
    if (!part || !isWeak(part)) return [];
    const axis = part.velocity_ellipsoid.axes.at(-1)!;
    if (axis.length === 6) return [axis];
    return [this.#answers!.part.value === "rotation" ? [0, 0, 0, ...axis] : [...axis, 0, 0, 0]];
  }

  #words(): string {
    const part = this.#drawable();
    if (!this.#answers || !part?.velocity_ellipsoid.axes.length) return "";
    const isBoth = this.#answers.part.value === "combined";
    const name = isBoth ? "translation" : this.#answers.part.value;
    const space = this.#answers.axes.spaces.find((entry) => entry.part === name)!;
    const { velocity, force } = this.#scale();
    const scale = (unit: string, metres: number) =>
      t("In the picture 1 {unit} is {metres} long.", { unit, metres: lengthText(metres, this.studio.store.value) });
    return [
      isBoth ? t("Six dimensions have no picture: drawn is the translation. 1 rad counts as 1 m.") : "",
      this.#shown.velocity ? scale(space.velocity_unit, velocity) : "",
      this.#shown.force ? scale(space.force_unit, force) : "",
      this.#shown.force && isCut(part.force_ellipsoid)
        ? t("The force is cut off at {CUT} times its shortest axis.", { CUT })
        : "",
      this.#held ? "" : t("The scale follows the longest axis."),
    ]
      .filter(Boolean)
      .join(" ");
  }
}
