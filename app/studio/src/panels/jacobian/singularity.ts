/** What the tip has lost, or is about to lose; where the nearest singularity is, and the way out. */

import type { Joint } from "../../robot/model.ts";
import type { PartAnswer, SingularityReport } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { rounded } from "../../ui/quantity.ts";
import { directions } from "./axes.ts";

/** An axis that is shorter than this share of the longest is called weak. */
const WEAK = 0.1;

const KINDS: Record<string, string> = {
  wrist: "wrist (two of its axes on one line)",
  elbow: "elbow (the arm stretched or folded)",
  shoulder: "shoulder (the wrist where the first joint does not move it)",
};

export class SingularityView {
  readonly host: HTMLElement;
  #verdict = element("p", { role: "status" });
  #words = element("ul", { class: "words" });
  #nearest = element("p");
  #go: HTMLButtonElement;
  #there: number[] | null = null;

  /** @param go moves the chain to a configuration. */
  constructor(go: (configuration: number[]) => void) {
    this.#go = button("Go there", () => this.#there && go(this.#there), { class: "button small", hidden: true });
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
      ? `Singular: rank ${report.rank} of ${report.structural_rank}.`
      : weakens
        ? `Close to singular: the smallest σ is 1/${rounded(1 / part.isotropy!)} of the largest.`
        : report.structural_rank === 0
          ? "The tip never moves in this way."
          : "Regular: the tip moves in every direction that it has at all.";
    this.#words.replaceChildren(...[...lost(report), ...(weakens ? weak(part) : []), ...joints(report)].map(item));
  }

  /** The nearest singularity of the last answer that had one; null while it is being looked for. */
  nearest(report: SingularityReport | null, joints: readonly Joint[] = []): void {
    const found = report?.nearest ?? null;
    this.#there = found?.joint_positions ?? null;
    this.#go.hidden = found === null || found.distance === 0;
    this.host.dataset["distance"] = found ? String(found.distance) : "";
    if (report === null) this.#nearest.textContent = "Nearest singularity: …";
    else if (!found) this.#nearest.textContent = sentence(report.nearest_reason ?? "no singularity was found");
    else if (found.distance === 0) this.#nearest.textContent = "Nearest singularity: here.";
    else {
      const kinds = found.kinds.length ? ` (${found.kinds.join(", ")})` : "";
      this.#nearest.textContent =
        `Nearest singularity found${kinds}: ${rounded(found.distance)} ${unitOf(joints)} away, by ${found.joints.join(", ")}` +
        `${found.within_limits ? "" : "; beyond the joint limits"}.`;
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

function lost({ lost_directions, kinds }: SingularityReport): Words[] {
  const here = lost_directions.filter(({ lost_here }) => lost_here);
  return [
    ...kinds.map((kind): Words => [`Its name: ${KINDS[kind] ?? kind}.`]),
    ...here.map(({ twist }): Words => ["The tip cannot ", ...motion(twist), ": drawn in red."]),
    ...here.map(({ wrench }): Words => ["No joint feels ", ...load(wrench), " at the tip."]),
  ];
}

function weak(part: PartAnswer): Words[] {
  const { axes, semi_axes } = part.velocity_ellipsoid;
  const sigma = element("span", {}, `σ = ${rounded(semi_axes.at(-1)!)}`);
  return [["It is weakest along ", ...spans(directions(axes.at(-1)!)), " with ", sigma, ", drawn in red."]];
}

function joints({ dependent_joints, internal_motions, exit, singular }: SingularityReport): Words[] {
  const redundant = internal_motions.filter(({ only_here }) => !only_here).length;
  return [
    ...(dependent_joints.length ? [[`Joints that undo each other here: ${dependent_joints.join(", ")}.`]] : []),
    ...(redundant ? [[`${count(redundant)} the tip at rest in these directions.`]] : []),
    ...(exit ? [[`${singular ? "The way out" : "Away from singularities"}: above all ${exit.joint}.`]] : []),
  ];
}

function motion(twist: number[]): Words {
  const [v, w] = [twist.slice(0, 3), twist.slice(3)];
  if (size(w) < 1e-6) return ["move along ", ...spans(directions(v))];
  if (size(v) < 1e-6) return ["turn about ", ...spans(directions(w))];
  return ["move as ", ...spans(directions(twist))];
}

function load(wrench: number[]): Words {
  const [f, m] = [wrench.slice(0, 3), wrench.slice(3)];
  if (size(m) < 1e-6) return ["a force along ", ...spans(directions(f))];
  if (size(f) < 1e-6) return ["a moment about ", ...spans(directions(m))];
  return [
    "a force along ",
    ...spans(directions(f)),
    ` with a moment (${rounded(size(m) / size(f))} m) about `,
    ...spans(directions(m)),
  ];
}

function spans(made: HTMLElement[]): Words {
  return made.flatMap((span, i) => (i ? [" ", span] : [span]));
}

/** Of a distance between configurations. */
function unitOf(joints: readonly Joint[]): string {
  const slides = joints.filter(({ type }) => type === "prismatic").length;
  return slides === 0 ? "rad" : slides === joints.length ? "m" : "(rad and m)";
}

function size(numbers: number[]): number {
  return Math.hypot(...numbers);
}

function count(motions: number): string {
  return motions === 1 ? "One motion of the joints leaves" : `${motions} independent motions of the joints leave`;
}

function sentence(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1) + ".";
}
