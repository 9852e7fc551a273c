/** Words of the service that stand in answers and are shown: each in the language of the page. */

import { t } from "./index.ts";

const WORDS: Readonly<Record<string, string>> = {
  // methods of inverse kinematics
  analytic: t("closed form"),
  newton: t("Newton"),
  gradient: t("gradient"),
  gradient_then_newton: t("gradient, then Newton"),
  damped_least_squares: t("damped least squares"),
  // branches
  shoulder: t("shoulder"),
  elbow: t("elbow"),
  wrist: t("wrist"),
  front: t("front"),
  back: t("back"),
  up: t("up"),
  down: t("down"),
  flip: t("flipped"),
  no_flip: t("not flipped"),
  // shapes
  box: t("box"),
  sphere: t("sphere"),
  cylinder: t("cylinder"),
  half_space: t("half space"),
  mesh: t("mesh"),
  // joints
  revolute: t("revolute"),
  continuous: t("continuous"),
  prismatic: t("prismatic"),
  fixed: t("fixed"),
  // kinds of robots
  uploaded: t("uploaded"),
  "textbook arm": t("textbook arm"),
  SCARA: "SCARA",
  "industrial arm": t("industrial arm"),
  "collaborative arm": t("collaborative arm"),
  "hobby arm": t("hobby arm"),
  "two-armed robot": t("two-armed robot"),
  "mobile manipulator": t("mobile manipulator"),
  "flying robot": t("flying robot"),
  biped: t("biped"),
  finger: t("finger"),
  hand: t("hand"),
  humanoid: t("humanoid"),
  quadruped: t("quadruped"),
  other: t("other"),
  // what a motion does where a singularity is near
  stop: t("stop"),
  damp: t("damp"),
  slow_down: t("slow down"),
  // laws of time
  trapezoidal: t("trapezoidal"),
  cubic: t("cubic"),
  quintic: t("quintic"),
  septic: t("septic"),
  jerk_limited: t("jerk-limited"),
  time_optimal: t("time-optimal"),
  // why a motion ends
  out_of_reach: t("out of reach"),
  joint_limit: t("a joint limit"),
  singularity: t("a singularity"),
  branch_change: t("a change of branch"),
  collision: t("a contact"),
};

/** A word as people read it; one that is not known as it is. */
export function word(wire: string): string {
  return Object.hasOwn(WORDS, wire) ? WORDS[wire]! : wire.replaceAll("_", " ");
}
