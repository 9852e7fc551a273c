/** The words of the field that titles and labels use: one sentence for each, and where the handbook says more. */

import { t } from "../texts/index.ts";

export interface Term {
  text: string;
  /** Page of the handbook, from its root on. */
  page: string;
}

/** By the title or label in English. */
export const TERMS: Readonly<Record<string, Term>> = {
  "DH table": {
    text: t(
      "Four numbers for each joint say where the next frame stands: two lengths, a and d, and two angles, α and θ.",
    ),
    page: "explanation/dh-tables.html",
  },
  "Length a": {
    text: t("The distance of two neighbouring joint axes, along their common normal, which is an x axis."),
    page: "explanation/dh-tables.html",
  },
  "Twist α": {
    text: t("The angle from one joint axis to the next, about their common normal."),
    page: "explanation/dh-tables.html",
  },
  "Offset d": {
    text: t(
      "How far it is along a joint axis from one common normal to the next; of a prismatic joint it is the variable.",
    ),
    page: "course/denavit-hartenberg.html",
  },
  "Angle θ": {
    text: t("The angle about a joint axis from one common normal to the next; of a revolute joint it is the variable."),
    page: "course/denavit-hartenberg.html",
  },
  "Lower limit": {
    text: t("The smallest position that the joint can have, an angle or a length; an empty cell is no limit."),
    page: "explanation/dh-tables.html",
  },
  "Upper limit": {
    text: t("The largest position that the joint can have, an angle or a length; an empty cell is no limit."),
    page: "explanation/dh-tables.html",
  },
  Joints: {
    text: t("Each joint has one number, an angle or a length; all of them together are the configuration q."),
    page: "course/contents.html",
  },
  Tip: {
    text: t(
      "The pose of the chain's last frame in its first one: a position, and an orientation in several notations.",
    ),
    page: "course/poses.html",
  },
  Target: {
    text: t("The pose that the tip is to have; inverse kinematics looks for configurations that bring it there."),
    page: "course/inverse-kinematics.html",
  },
  Solutions: {
    text: t("One pose can be reached in several ways, such as elbow up and elbow down; each way is a branch."),
    page: "explanation/inverse-kinematics.html",
  },
  "Newton against gradient": {
    text: t("Two iterations to the same pose: Newton's inverts the Jacobian, the gradient method transposes it."),
    page: "course/inverse-kinematics.html",
  },
  Jacobian: {
    text: t("The matrix J(q) that turns joint speeds into the velocity of the tip: one column for each joint."),
    page: "course/velocities.html",
  },
  "Ellipsoids at the tip": {
    text: t("How fast, or with how much force, the tip can move in each direction when the joints do equally much."),
    page: "course/manipulability.html",
  },
  Singularity: {
    text: t("A configuration where the tip cannot move in some direction, however the joints turn: J loses rank."),
    page: "course/inverse-velocities.html",
  },
  Motion: {
    text: t("A path, and on it a law of time: where the arm is at each moment, with its velocity and acceleration."),
    page: "course/trajectories.html",
  },
  Workspace: {
    text: t("All points that the tip can reach within the limits of the joints."),
    page: "reference/kinematics.html",
  },
  Contact: {
    text: t("Which bodies of the robot and the scene touch each other, or how far the nearest two are apart."),
    page: "how-to/will-it-hit-the-table.html",
  },
  "Write down": {
    text: t(
      "The solution as one writes it in an exam: transforms, pose, Jacobian and their values, derived symbolically.",
    ),
    page: "course/denavit-hartenberg.html",
  },
  Counts: {
    text: t("Which directions of the target the tip must meet; leave one out, and the arm is free in it."),
    page: "how-to/choose-an-ik-method.html",
  },
  Tolerances: {
    text: t("How far from the target the tip may stay for a configuration to be a solution."),
    page: "how-to/read-an-ik-verdict.html",
  },
  "Law of time": {
    text: t("How the speed grows and falls along the path: a trapezoid, a polynomial, or as fast as the limits allow."),
    page: "course/trajectories.html",
  },
  "Near a singularity": {
    text: t(
      "A straight way through a singularity asks for infinite joint speeds: stop, leave the line a little, or slow down.",
    ),
    page: "course/inverse-velocities.html",
  },
  "Blend into the next": {
    text: t("Leave the corner out: before one segment ends the next begins, and the arm need not stop between them."),
    page: "course/trajectories.html",
  },
  "Path tolerance": {
    text: t("How far the tip may be from its straight or round way, between the configurations that are computed."),
    page: "explanation/trajectories.html",
  },
  "The way counts in": {
    text: t("Which directions of the tip must follow the way; leave one out, and the arm is free in it."),
    page: "how-to/cartesian-move.html",
  },
  Payload: {
    text: t("What the tip carries: its mass, and where its centre of mass is; torques count it in."),
    page: "how-to/torques-and-payload.html",
  },
};
