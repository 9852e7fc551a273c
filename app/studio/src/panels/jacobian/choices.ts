/** What one chooses in the panel: in whose axes, in whose rates, and which of the tip's directions count. */

import { chosen, type State } from "../../state.ts";
import { t } from "../../texts/index.ts";
import type { Direction, Part, Reference, Representation } from "../../types.ts";

export interface Form {
  value: string;
  text: string;
  reference: Reference;
  representation: Representation;
  hint: string;
}

/** Reference and representation in one: the service has analytic Jacobians along the base's axes alone. */
export const FORMS: readonly Form[] = [
  {
    value: "base",
    text: t("Base axes"),
    reference: "local_world_aligned",
    representation: "geometric",
    hint: t("Geometric, of the tip, along the base's axes."),
  },
  {
    value: "tip",
    text: t("Tip axes"),
    reference: "local",
    representation: "geometric",
    hint: t("Geometric, of the tip, along the tip's own axes."),
  },
  {
    value: "spatial",
    text: t("Spatial"),
    reference: "world",
    representation: "geometric",
    hint: t("Geometric, along the base's axes, of the point of the tip's body that passes the base's origin."),
  },
  {
    value: "zyz",
    text: "ZYZ",
    reference: "local_world_aligned",
    representation: "zyz",
    hint: t("Analytic: the angular rows are the rates of the Euler angles ZYZ."),
  },
  {
    value: "rpy",
    text: "RPY",
    reference: "local_world_aligned",
    representation: "rpy",
    hint: t("Analytic: the angular rows are the rates of roll, pitch and yaw."),
  },
];

export interface PartChoice {
  value: Part;
  text: string;
  /** The directions that can be lost. */
  task: readonly Direction[];
}

export const PARTS: readonly PartChoice[] = [
  { value: "translation", text: t("Translation"), task: ["x", "y", "z"] },
  { value: "rotation", text: t("Rotation"), task: ["rx", "ry", "rz"] },
  { value: "combined", text: t("Both"), task: ["x", "y", "z", "rx", "ry", "rz"] },
];

export function formOf(state: Readonly<State>): Form {
  return among(state, "jacobian.form", FORMS);
}

export function partOf(state: Readonly<State>): PartChoice {
  return among(state, "jacobian.part", PARTS);
}

function among<T extends { value: string }>(state: Readonly<State>, option: string, all: readonly T[]): T {
  const values = all.map(({ value }) => value);
  return all[values.indexOf(chosen(state, option, values))]!;
}
