/** What the service's audit found: every peak beside its limit, the worst one first to go to. */

import type { Joint } from "../../robot/model.ts";
import { button, element } from "../../ui/dom.ts";
import { fixed, scientific, unitOf } from "../../ui/quantity.ts";
import type { TrajectoryAnswer } from "../../types.ts";
import type { Audit, Failure, Peak } from "./answer.ts";
import { effortUnit, kindOf } from "./fields.ts";
import { type Law, LAWS, type Motion, USUAL_LAW } from "./motion.ts";

/** Laws that keep the limits of jerk; the others are only compared with them. */
const KEEP_JERK: ReadonlySet<Law> = new Set(["quintic", "septic", "jerk_limited"]);
const REASONS: Record<Failure["reason"], string> = {
  out_of_reach: "out of reach",
  joint_limit: "a joint limit",
  singularity: "a singularity",
  branch_change: "a change of branch",
  collision: "a contact",
};
/** Below it a jump is rounding. */
const NO_JUMP = 1e-9;

export interface Finding {
  name: string;
  /** The peak with its unit. */
  value: string;
  /** To its limit; null without one. */
  ratio: number | null;
  /** Whether the motion has to keep that limit. */
  counts: boolean;
  joint: string | null;
  time: number;
}

/** Everything that the audit tells of, in the order of the table. */
export function findings({ audit, segments }: TrajectoryAnswer, joints: readonly Joint[], degrees: boolean): Finding[] {
  const keepsJerk = segments.every(({ law }) => KEEP_JERK.has(law));
  const ofJoint = measured(joints, degrees);
  const turned = degrees ? 180 / Math.PI : 1;
  const angle = (per: string) => (value: number) => `${short(turned * value)} ${unitOf("angle", degrees)}${per}`;
  const metres = (per: string) => (value: number) => `${short(value)} m${per}`;
  const found: (Finding | null)[] = [
    ...(["velocity", "acceleration", "jerk"] as const).map((name, i) =>
      peak(capital(name), audit[name], ofJoint(["/s", "/s²", "/s³"][i]!), name !== "jerk" || keepsJerk),
    ),
    peak("Distance from the way", audit.path_deviation, metres("")),
    peak("Turned from it", audit.orientation_deviation, angle("")),
    peak("Tip velocity", audit.tip.speed, metres("/s")),
    peak("Tip acceleration", audit.tip.acceleration, metres("/s²")),
    peak("Tip turning", audit.tip.angular_speed, angle("/s")),
    peak("Tip turning, acceleration", audit.tip.angular_acceleration, angle("/s²")),
    peak("Torque", audit.joint_torque, efforts(joints)),
    ...rest(audit, ofJoint),
  ];
  return found.filter((entry) => entry !== null);
}

/** What is nearest to the limit that it must keep. */
export function worst(found: readonly Finding[]): Finding | null {
  const counted = found.filter(({ ratio, counts }) => counts && ratio !== null);
  return counted.reduce<Finding | null>((most, one) => (most && most.ratio! >= one.ratio! ? most : one), null);
}

/** The table, and above it the verdict; `go` is told of the time of what is pressed, [s]. */
export function auditTable(
  answer: TrajectoryAnswer,
  joints: readonly Joint[],
  degrees: boolean,
  go: (time: number) => void,
): HTMLElement {
  const found = findings(answer, joints, degrees);
  const { passed, reasons } = answer.audit;
  const most = worst(found);
  const heading = passed ? "The audit passes." : `The audit fails: ${reasons.map(({ detail }) => detail).join("; ")}.`;
  return element(
    "div",
    { class: "part audit" },
    element("p", { class: "audit-verdict", "data-tone": passed ? "good" : "bad" }, heading),
    most &&
      element(
        "p",
        { class: "small" },
        `Nearest to its limit: ${most.name.toLowerCase()}${most.joint ? ` of ${most.joint}` : ""}, ${percent(most.ratio!)} `,
        time(most, go, "worst"),
      ),
    element(
      "table",
      { class: "findings" },
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          ...["Peak", "", "Of its limit", "Joint", "At"].map((title) => element("th", { scope: "col" }, title)),
        ),
      ),
      element("tbody", {}, ...found.map((finding) => row(finding, go))),
    ),
  );
}

/** Which laws were taken in place of those that were asked for, each once with its segments. */
export function replacedLaws(motion: Motion, segments: TrajectoryAnswer["segments"]): string[] {
  const found = new Map<string, number[]>();
  const wanted = motion.path ? [] : motion.segments; // along a path they wait
  for (const { index, law } of segments) {
    const asked = wanted[index]?.law ?? motion.law ?? USUAL_LAW;
    if (law === asked) continue;
    const text = `${titleOf(law)} in place of ${titleOf(asked).toLowerCase()}`;
    found.set(text, [...(found.get(text) ?? []), index + 1]);
  }
  return [...found].map(
    ([text, numbers]) => `${numbers.length > 1 ? "Segments" : "Segment"} ${numbers.join(", ")}: ${text}`,
  );
}

function titleOf(law: Law): string {
  return LAWS.find(({ value }) => value === law)?.text ?? law;
}

/** What the time-optimal law would gain on each way, where that was asked for. */
export function timingTable({ timing }: TrajectoryAnswer): HTMLElement | null {
  if (!timing?.length) return null;
  const rows = timing.map(({ segments, law, uniform_duration, time_optimal_duration }) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, segments.map((index) => index + 1).join(", ")),
      element("td", {}, law.replace("_", "-")),
      element("td", { class: "value" }, `${fixed(uniform_duration, 3)} s`),
      element("td", { class: "value" }, `${fixed(time_optimal_duration, 3)} s`),
      element("td", { class: "value" }, percent(time_optimal_duration / uniform_duration)),
    ),
  );
  const titles = ["Way of segment", "Law", "Takes", "Time-optimal", "Ratio"];
  return element(
    "table",
    { class: "findings timing" },
    element("thead", {}, element("tr", {}, ...titles.map((title) => element("th", { scope: "col" }, title)))),
    element("tbody", {}, ...rows),
  );
}

/** Why the motion ends early, and where; `put` is told of the configuration of a contact that was asked for. */
export function failureBox(
  answer: TrajectoryAnswer,
  go: (time: number) => void,
  put: (configuration: readonly number[]) => void,
): HTMLElement | null {
  const { failure, completed_fraction, path } = answer;
  if (!failure) return null;
  const { reason, segment, time: at, position, detail } = failure;
  const where = position.map((value) => fixed(value, 3)).join(", ");
  return element(
    "div",
    { class: "problem ended", role: "alert" },
    element("strong", {}, `Done to ${percent(completed_fraction)}, then ${REASONS[reason]}`),
    element(
      "p",
      {},
      `${path ? `Way-point ${path.turns.length}` : `Segment ${segment + 1}`} stops the tip at (${where}) m: ${detail}.`,
    ),
    element(
      "div",
      { class: "bar" },
      button(`Go to ${fixed(at, 3)} s`, () => go(at), { class: "button small" }),
      failure.first_contact &&
        button("Show the contact", () => put(failure.first_contact!.joint_positions), { class: "button small" }),
    ),
  );
}

function row(finding: Finding, go: (time: number) => void): HTMLElement {
  const { name, value, ratio, counts, joint } = finding;
  const isBeyond = ratio !== null && ratio > 1 + 1e-6;
  const tone = !isBeyond ? "" : counts ? "bad" : "muted";
  return element(
    "tr",
    {},
    element("th", { scope: "row" }, name),
    element("td", { class: "value" }, value),
    element(
      "td",
      {
        class: `ratio ${tone}`,
        title: isBeyond && !counts ? "Compared only: this law does not keep limits of jerk" : null,
      },
      ratio === null ? "" : percent(ratio),
    ),
    element("td", { class: "of", title: joint }, joint ?? ""),
    element("td", {}, time(finding, go)),
  );
}

function time({ name, time: at }: Finding, go: (time: number) => void, kind = ""): HTMLElement {
  const text = `${fixed(at, 3)} s`;
  return button(text, () => go(at), { class: `goto ${kind}`, "aria-label": `${text}, go to: ${name}` });
}

/** Writes a value with its unit. */
type Measure = (value: number, joint: string | null) => string;

function peak(name: string, found: Peak | null, measure: Measure, counts = true): Finding | null {
  if (!found) return null;
  const { value, ratio, joint, time } = found;
  return { name, value: measure(Math.abs(value), joint), ratio, counts, joint, time };
}

function rest(
  { limit_margin, min_singular_value, continuity, clearance }: Audit,
  ofJoint: (per: string) => Measure,
): Finding[] {
  const bare = { ratio: null, counts: false };
  const found: Finding[] = [];
  if (limit_margin) {
    const { value, joint, bound, time } = limit_margin;
    found.push({ ...bare, name: `To a joint's ${bound} limit`, value: ofJoint("")(value, joint), joint, time });
  }
  if (clearance?.pair) {
    const { value, time, pair } = clearance;
    const named = { name: "Clearance", joint: `${pair.a} to ${pair.b}`, time };
    found.push({ ...bare, ...named, value: `${fixed(1000 * value!, 1)} mm` });
  }
  if (min_singular_value) {
    const { value, time } = min_singular_value;
    found.push({ ...bare, name: "Smallest σ of J", value: short(value), joint: null, time });
  }
  const jump = continuity.acceleration;
  if (jump && jump.value > NO_JUMP) {
    const { value, joint, time } = jump;
    found.push({ ...bare, name: "Jump of acceleration", value: ofJoint("/s²")(value, joint), joint, time });
  }
  return found;
}

/** Of values of joints, in their units per a power of the second. */
function measured(joints: readonly Joint[], degrees: boolean): (per: string) => Measure {
  return (per) => (value, name) => {
    const joint = joints.find((one) => one.name === name);
    const kind = joint ? kindOf(joint) : "angle";
    const factor = kind === "angle" && degrees ? 180 / Math.PI : 1;
    return `${short(factor * value)} ${unitOf(kind, degrees)}${per}`;
  };
}

function efforts(joints: readonly Joint[]): Measure {
  return (value, name) => `${short(value)} ${effortUnit(joints.find((joint) => joint.name === name)!)}`;
}

function short(value: number): string {
  const size = Math.abs(value);
  return size !== 0 && size < 1e-3 ? scientific(value) : fixed(value, size < 10 ? 3 : 2);
}

function percent(share: number): string {
  return `${fixed(100 * share, 1)} %`;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
