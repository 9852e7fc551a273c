/** What the tip has lost, or is about to lose; where the nearest singularity is, and the way out. */

import type { Joint } from "../../robot/model.ts";
import { t } from "../../texts/index.ts";
import type { PartAnswer, SingularityReport } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { lengthText, rounded, type Units } from "../../ui/quantity.ts";
import { distanceText } from "../ik/distance.ts";
import { directions } from "./axes.ts";

/** An axis that is shorter than this share of the longest is called weak. */
const WEAK = 0.1;

const KINDS: Record<string, string> = {
  wrist: t("wrist (two of its axes on one line)"),
  elbow: t("elbow (the arm stretched or folded)"),
  shoulder: t("shoulder (the wrist where the first joint does not move it)"),
};

export class SingularityView {
  readonly host: HTMLElement;
  #verdict = element("p", { role: "status" });
  #words = element("ul", { class: "words" });
  #nearest = element("p");
  #go: HTMLButtonElement;
  #there: number[] | null = null;

  /** @param go moves the chain to a configuration. */
  constructor(
    private readonly units: () => Units,
    go: (configuration: number[]) => void,
  ) {
    this.#go = button(t("Go there"), () => this.#there && go(this.#there), { class: "button small", hidden: true });
    this.host = element(
      "div",
      { class: "part singularity" },
      this.#verdict,
      this.#words,
      element("div", { class: "nearest" }, this.#nearest, this.#go),
    );
  }

  show(report: SingularityReport, part: PartAnswer | null): void {
    const weakens = !report.singular && part !== null && isWeak(part);
    this.host.dataset["singular"] = String(report.singular);
    this.#verdict.dataset["tone"] = report.singular ? "bad" : weakens ? "weak" : "good";
    this.#verdict.textContent = report.singular
      ? t("Singular: rank {rank} of {structural_rank}.", { rank: report.rank, structural_rank: report.structural_rank })
      : weakens
        ? t("Close to singular: the smallest σ is 1/{isotropy} of the largest.", {
            isotropy: rounded(1 / part.isotropy!),
          })
        : report.structural_rank === 0
          ? t("The tip never moves in this way.")
          : t("Regular: the tip moves in every direction that it has at all.");
    this.#words.replaceChildren(
      ...[...lost(report, this.units()), ...(weakens ? weak(part) : []), ...joints(report)].map(item),
    );
  }

  /** The nearest singularity of the last answer that had one; null while it is being looked for. */
  nearest(report: SingularityReport | null, joints: readonly Joint[] = []): void {
    const found = report?.nearest ?? null;
    this.#there = found?.joint_positions ?? null;
    this.#go.hidden = found === null || found.distance === 0;
    this.host.dataset["distance"] = found ? String(found.distance) : "";
    if (report === null) this.#nearest.textContent = t("Nearest singularity: …");
    else if (!found) this.#nearest.textContent = sentence(report.nearest_reason ?? t("no singularity was found"));
    else if (found.distance === 0) this.#nearest.textContent = t("Nearest singularity: here.");
    else {
      const kinds = found.kinds.length ? ` (${found.kinds.join(", ")})` : "";
      this.#nearest.textContent = t("Nearest singularity found{kinds}: {joints} away, by {joints2}{within_limits}.", {
        kinds,
        joints: distanceText(joints, found.distance, this.units()),
        joints2: found.joints.join(", "),
        within_limits: found.within_limits ? "" : t("; beyond the joint limits"),
      });
    }
  }
}

/** Whether a direction is nearly lost. */
export function isWeak({ isotropy }: PartAnswer): boolean {
  return isotropy !== null && isotropy > 0 && isotropy < WEAK;
}

type Words = (Node | string)[];

function item(words: Words): HTMLElement {
  return element("li", {}, ...words);
}

function lost({ lost_directions, kinds }: SingularityReport, units: Units): Words[] {
  const here = lost_directions.filter(({ lost_here }) => lost_here);
  return [
    ...kinds.map((kind): Words => [t("Its name: {KINDS}.", { KINDS: KINDS[kind] ?? kind })]),
    ...here.map(({ twist }): Words => [t("The tip cannot "), ...motion(twist), t(": drawn in red.")]),
    ...here.map(({ wrench }): Words => [t("No joint feels "), ...load(wrench, units), t(" at the tip.")]),
  ];
}

function weak(part: PartAnswer): Words[] {
  const { axes, semi_axes } = part.velocity_ellipsoid;
  const sigma = element("span", {}, `σ = ${rounded(semi_axes.at(-1)!)}`);
  return [[t("It is weakest along "), ...spans(directions(axes.at(-1)!)), t(" with "), sigma, t(", drawn in red.")]];
}

function joints({ dependent_joints, internal_motions, exit, singular }: SingularityReport): Words[] {
  const redundant = internal_motions.filter(({ only_here }) => !only_here).length;
  return [
    ...(dependent_joints.length
      ? [
          [
            t("Joints that undo each other here: {dependent_joints}.", {
              dependent_joints: dependent_joints.join(", "),
            }),
          ],
        ]
      : []),
    ...(redundant ? [[t("{redundant} the tip at rest in these directions.", { redundant: count(redundant) })]] : []),
    ...(exit
      ? [
          [
            t("{singular}: above all {joint}.", {
              singular: singular ? t("The way out") : t("Away from singularities"),
              joint: exit.joint,
            }),
          ],
        ]
      : []),
  ];
}

function motion(twist: number[]): Words {
  const [v, w] = [twist.slice(0, 3), twist.slice(3)];
  if (size(w) < 1e-6) return [t("move along "), ...spans(directions(v))];
  if (size(v) < 1e-6) return [t("turn about "), ...spans(directions(w))];
  return [t("move as "), ...spans(directions(twist))];
}

function load(wrench: number[], units: Units): Words {
  const [f, m] = [wrench.slice(0, 3), wrench.slice(3)];
  if (size(m) < 1e-6) return [t("a force along "), ...spans(directions(f))];
  if (size(f) < 1e-6) return [t("a moment about "), ...spans(directions(m))];
  return [
    t("a force along "),
    ...spans(directions(f)),
    t(" with a moment ({m}) about ", { m: lengthText(size(m) / size(f), units) }),
    ...spans(directions(m)),
  ];
}

function spans(made: HTMLElement[]): Words {
  return made.flatMap((span, i) => (i ? [" ", span] : [span]));
}

function size(numbers: number[]): number {
  return Math.hypot(...numbers);
}

function count(motions: number): string {
  return motions === 1
    ? t("One motion of the joints leaves")
    : t("{motions} independent motions of the joints leave", { motions });
}

function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1) + ".";
}
