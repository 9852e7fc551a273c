/** The pose that the tip is to reach, as fields in the notation of the API that one likes best. */

import { asMatrix, asPose, FORMATS, formatOf, IN_RADIANS } from "../../robot/pose.ts";
import { t } from "../../texts/index.ts";
import type { Pose, PoseFormat } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import { NumberField } from "../../ui/number.ts";
import { chosenOf, isSame, type Kind, SI, type Units, unitOf } from "../../ui/quantity.ts";

const NAMES: Record<PoseFormat | "position", readonly string[]> = {
  position: ["x", "y", "z"],
  quaternion_xyzw: ["qx", "qy", "qz", "qw"],
  quaternion_wxyz: ["qw", "qx", "qy", "qz"],
  rpy: ["roll", "pitch", "yaw"],
  zyz: ["φ", "θ", "ψ"],
  rotation_vector: ["rx", "ry", "rz"],
  rotation: [],
  matrix: [],
};
const STEPS: Record<Kind, number> = { length: 0.01, angle: Math.PI / 180, number: 0.01 };

export interface TargetEvents {
  /** A pose has been typed. */
  typed: (pose: Pose) => void;
  /** The arrow keys have moved it a little. */
  nudged: (pose: Pose) => void;
  units: () => Units;
}

export class TargetFields {
  readonly host = element("div", { class: "target" });
  #pose: Pose | null = null;
  #format: PoseFormat | null = null;
  #fields: { field: NumberField; read: (pose: Pose) => number }[] = [];
  #select: HTMLSelectElement;
  #body = element("div", { class: "target-rows" });
  #units = SI;

  constructor(private readonly events: TargetEvents) {
    this.#select = element(
      "select",
      {
        class: "select",
        "aria-label": t("Notation of the orientation"),
        onchange: () => this.#pose && events.typed(asPose(asMatrix(this.#pose), this.#select.value as PoseFormat)),
      },
      ...FORMATS.map(({ format, title }) => element("option", { value: format }, title)),
    );
    this.host.append(this.#body);
  }

  show(pose: Pose): void {
    this.#pose = pose;
    const format = formatOf(pose) ?? "rpy";
    const hasOthers = !isSame(this.events.units(), this.#units);
    this.#units = chosenOf(this.events.units());
    if (format !== this.#format || hasOthers) this.#build(format);
    for (const { field, read } of this.#fields) field.set(read(pose));
  }

  #build(format: PoseFormat): void {
    const hadFocus = document.activeElement === this.#select;
    this.#format = format;
    this.#select.value = format;
    this.#fields = [];
    const rows: HTMLElement[] = [];
    if (format !== "matrix") rows.push(this.#row(element("span", {}, t("Position")), "position", "length"));
    if (format === "rotation" || format === "matrix") {
      const columns = format === "matrix" ? 4 : 3;
      for (const i of [0, 1, 2]) {
        const fields = Array.from({ length: columns }, (_, j) => this.#entry(format, i, j));
        rows.push(
          line(i === 0 ? this.#select : null, fields, format === "matrix" ? unitOf("length", this.#units) : ""),
        );
      }
    } else {
      const isAngle = IN_RADIANS.has(format);
      const kind: Kind = isAngle ? "angle" : "number";
      rows.push(this.#row(this.#select, format, kind));
    }
    this.#body.replaceChildren(...rows);
    if (hadFocus) this.#select.focus();
  }

  #row(title: HTMLElement, key: Exclude<PoseFormat, "rotation" | "matrix"> | "position", kind: Kind) {
    const fields = NAMES[key].map((name, i) =>
      this.#field(t("Target {name}", { name }), kind, STEPS[kind], {
        read: (pose) => pose[key]![i]!,
        write: (pose, value) => ({ ...pose, [key]: pose[key]!.with(i, value) }),
      }),
    );
    return line(title, fields, unitOf(kind, this.#units));
  }

  #entry(format: "rotation" | "matrix", i: number, j: number): NumberField {
    const kind = j === 3 ? "length" : "number"; // a column of three numbers beside a rotation
    return this.#field(t("Target row {i}, column {j}", { i: i + 1, j: j + 1 }), kind, STEPS.number, {
      read: (pose) => pose[format]![i]![j]!,
      write: (pose, value) => ({ ...pose, [format]: pose[format]!.with(i, pose[format]![i]!.with(j, value)) }),
    });
  }

  #field(
    label: string,
    kind: Kind,
    by: number,
    { read, write }: { read: (pose: Pose) => number; write: (pose: Pose, value: number) => Pose },
  ): NumberField {
    const changed = (tell: (pose: Pose) => void) => (value: number | null) => {
      if (value !== null && this.#pose && read(this.#pose) !== value) tell(write(this.#pose, value));
    };
    const field = new NumberField({
      label,
      kind,
      units: this.events.units,
      decimals: 4,
      change: changed(this.events.typed),
      step: { by, take: changed(this.events.nudged) },
    });
    this.#fields.push({ field, read });
    return field;
  }
}

function line(title: HTMLElement | null, fields: readonly NumberField[], unit: string): HTMLElement {
  return element(
    "div",
    { class: "target-row" },
    element("span", { class: "target-title" }, title),
    element("span", { class: "target-fields" }, ...fields.map((field) => field.input)),
    element("span", { class: "unit" }, unit),
  );
}
