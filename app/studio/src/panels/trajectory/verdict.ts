/** What the service's audit found: every peak beside its limit, the worst one first to go to. */

import { type Joint, kindOf } from "../../robot/model.ts";
import { t, within } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import { button, element } from "../../ui/dom.ts";
import { column, fixed, inUnit, type Kind, scientific, type Units, withUnit } from "../../ui/quantity.ts";
import type { TrajectoryAnswer } from "../../types.ts";
import type { Audit, Peak } from "./answer.ts";
import { effortUnit } from "./fields.ts";
import { commonPrefix } from "./legend.ts";
import { type Law, LAWS, type Motion, USUAL_LAW } from "./motion.ts";

/** Laws that keep the limits of jerk; the others are only compared with them. */
const KEEP_JERK: ReadonlySet<Law> = new Set(["quintic", "septic", "jerk_limited"]);
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
export function findings({ audit, segments }: TrajectoryAnswer, joints: readonly Joint[], units: Units): Finding[] {
  const keepsJerk = segments.every(({ law }) => KEEP_JERK.has(law));
  const ofJoint = ofJoints(joints, units);
  const of = (kind: Kind) => (per: string) => (value: number) => written(value, kind, units, per);
  const [angle, length] = [of("angle"), of("length")];
  const found: (Finding | null)[] = [
    peak(t("Velocity"), audit.velocity, ofJoint("/s")),
    peak(t("Acceleration"), audit.acceleration, ofJoint("/s²")),
    peak(t("Jerk"), audit.jerk, ofJoint("/s³"), keepsJerk),
    peak(t("Distance from the way"), audit.path_deviation, length("")),
    peak(t("Turned from it"), audit.orientation_deviation, angle("")),
    peak(t("Tip velocity"), audit.tip.speed, length("/s")),
    peak(t("Tip acceleration"), audit.tip.acceleration, length("/s²")),
    peak(t("Tip turning"), audit.tip.angular_speed, angle("/s")),
    peak(t("Tip turning, acceleration"), audit.tip.angular_acceleration, angle("/s²")),
    peak(t("Torque"), audit.joint_torque, efforts(joints)),
    ...rest(audit, ofJoint, units),
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
  units: Units,
  go: (time: number) => void,
): HTMLElement {
  const found = findings(answer, joints, units);
  const { passed, reasons } = answer.audit;
  const most = worst(found);
  const prefix = commonPrefix(joints.map(({ name }) => name));
  const heading = passed
    ? t("The audit passes.")
    : t("The audit fails: {reasons}.", { reasons: reasons.map(({ detail }) => detail).join("; ") });
  return element(
    "div",
    { class: "part audit" },
    element("p", { class: "audit-verdict", "data-tone": passed ? "good" : "bad" }, heading),
    most &&
      element(
        "p",
        { class: "small" },
        most.joint
          ? t("Nearest to its limit: {name} of {joint}, {ratio} ", {
              name: within(most.name),
              joint: most.joint,
              ratio: percent(most.ratio!),
            })
          : t("Nearest to its limit: {name}, {ratio} ", { name: within(most.name), ratio: percent(most.ratio!) }),
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
          ...[t("Peak"), "", t("Of its limit"), t("Joint"), t("At")].map((title) =>
            element("th", { scope: "col" }, title),
          ),
        ),
      ),
      element("tbody", {}, ...found.map((finding) => row(finding, prefix, go))),
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
    const text = t("{law} in place of {asked}", { law: titleOf(law), asked: within(titleOf(asked)) });
    found.set(text, [...(found.get(text) ?? []), index + 1]);
  }
  return [...found].map(([text, numbers]) =>
    numbers.length > 1
      ? t("Segments {numbers}: {text}", { numbers: numbers.join(", "), text })
      : t("Segment {numbers}: {text}", { numbers: numbers[0], text }),
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
      element("td", {}, word(law)),
      element("td", { class: "value" }, `${fixed(uniform_duration, 3)} s`),
      element("td", { class: "value" }, `${fixed(time_optimal_duration, 3)} s`),
      element("td", { class: "value" }, percent(time_optimal_duration / uniform_duration)),
    ),
  );
  const titles = [t("Way of segment"), t("Law"), t("Takes"), t("Time-optimal"), t("Ratio")];
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
  units: Units,
  go: (time: number) => void,
  put: (configuration: readonly number[]) => void,
): HTMLElement | null {
  const { failure, completed_fraction, path } = answer;
  if (!failure) return null;
  const { reason, segment, time: at, position, detail } = failure;
  const where = position.map((value) => column(value, "length", units, 3)).join(", ");
  return element(
    "div",
    { class: "problem ended", role: "alert" },
    element(
      "strong",
      {},
      t("Done to {completed_fraction}, then {reason}", {
        completed_fraction: percent(completed_fraction),
        reason: word(reason),
      }),
    ),
    element(
      "p",
      {},
      path
        ? t("Way-point {length} stops the tip at {where}: {detail}.", {
            length: path.turns.length,
            where: withUnit(`(${where})`, "length", units),
            detail,
          })
        : t("Segment {segment} stops the tip at {where}: {detail}.", {
            segment: segment + 1,
            where: withUnit(`(${where})`, "length", units),
            detail,
          }),
    ),
    element(
      "div",
      { class: "bar" },
      button(t("Go to {at} s", { at: fixed(at, 3) }), () => go(at), { class: "button small" }),
      failure.first_contact &&
        button(t("Show the contact"), () => put(failure.first_contact!.joint_positions), { class: "button small" }),
    ),
  );
}

function row(finding: Finding, prefix: number, go: (time: number) => void): HTMLElement {
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
        title: isBeyond && !counts ? t("Compared only: this law does not keep limits of jerk") : null,
      },
      ratio === null ? "" : percent(ratio),
    ),
    element("td", { class: "of", title: joint }, joint?.slice(prefix) ?? ""),
    element("td", {}, time(finding, go)),
  );
}

function time({ name, time: at }: Finding, go: (time: number) => void, kind = ""): HTMLElement {
  const text = `${fixed(at, 3)} s`;
  return button(text, () => go(at), {
    class: `goto ${kind}`,
    "aria-label": t("{text}, go to: {name}", { text, name }),
  });
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
  units: Units,
): Finding[] {
  const bare = { ratio: null, counts: false };
  const found: Finding[] = [];
  if (limit_margin) {
    const { value, joint, bound, time } = limit_margin;
    found.push({
      ...bare,
      name: bound === "lower" ? t("To a joint's lower limit") : t("To a joint's upper limit"),
      value: ofJoint("")(value, joint),
      joint,
      time,
    });
  }
  if (clearance?.pair) {
    const { value, time, pair } = clearance;
    const named = { name: t("Clearance"), joint: t("{a} to {b}", { a: pair.a, b: pair.b }), time };
    found.push({ ...bare, ...named, value: withUnit(column(value!, "length", units, 4), "length", units) });
  }
  if (min_singular_value) {
    const { value, time } = min_singular_value;
    found.push({ ...bare, name: t("Smallest σ of J"), value: short(value), joint: null, time });
  }
  const jump = continuity.acceleration;
  if (jump && jump.value > NO_JUMP) {
    const { value, joint, time } = jump;
    found.push({ ...bare, name: t("Jump of acceleration"), value: ofJoint("/s²")(value, joint), joint, time });
  }
  return found;
}

/** Of values of joints, in their units per a power of the second. */
function ofJoints(joints: readonly Joint[], units: Units): (per: string) => Measure {
  return (per) => (value, name) => {
    const joint = joints.find((one) => one.name === name);
    return written(value, joint ? kindOf(joint) : "angle", units, per);
  };
}

function written(value: number, kind: Kind, units: Units, per: string): string {
  return withUnit(short(inUnit(value, kind, units)), kind, units, per);
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
