/** What came out: reach, volume, the best place, how far the numbers can be trusted; and all of it as files. */

import type { Api } from "../../api.ts";
import type { Joint } from "../../robot/model.ts";
import { language, t } from "../../texts/index.ts";
import type { WorkspaceSummary } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { save } from "../../ui/files.ts";
import { column, lengthText, rounded, type Units, withUnit } from "../../ui/quantity.ts";
import type { Range } from "./cloud.ts";
import { NPY, pathOf, type Result } from "./job.ts";

const SVG = "image/svg+xml";
const POWERS = ["", "m", "m²", "m³"];
/** Above this share of voxels that only the last samples found, more samples would find many more. */
const FEW = 0.01;

/** Between what the colours are spread, and what they tell. */
export function meaning({ summary, table }: Result): { title: string; range: Range } {
  if (summary.kind === "dexterity")
    return { title: t("Share of the orientations reached"), range: { lower: 0, upper: 1 } };
  const range = { lower: Infinity, upper: -Infinity };
  for (let k = table.columns - 1; k < table.values.length; k += table.columns) {
    range.lower = Math.min(range.lower, table.values[k]!);
    range.upper = Math.max(range.upper, table.values[k]!);
  }
  const best = summary.kind === "grid" ? t("Best manipulability") : t("Manipulability");
  return { title: t("{best} w = √det(JJᵀ)", { best }), range: table.rows ? range : { lower: 0, upper: 0 } };
}

type Fact = [title: string, value: string, hint?: string];

/** The numbers of a summary, to be read. */
export function facts(summary: WorkspaceSummary, joints: readonly Joint[], units: Units): Fact[] {
  const { voxels, reach, bounding_box: box, measure, dexterity } = summary;
  const unit = POWERS[voxels.dimensions] ?? "";
  const turns = joints.length > 0 && joints.every(({ type }) => type !== "prismatic");
  const measureUnit = turns ? ` ${POWERS[measure.directions.length] ?? ""}` : "";
  const size = ["", t("Length"), t("Area"), t("Volume")][voxels.dimensions] ?? "";
  const shown = (value: number) => column(value, "length", units, 3);
  const length = (value: number) => lengthText(value, units);
  const span = (from: number, to: number) =>
    withUnit(t("{from} to {to}", { from: shown(from), to: shown(to) }), "length", units);
  const found: (Fact | null)[] = [
    reach && [t("Reach"), span(reach.min, reach.max), t("Distances from the base frame's origin")],
    ...(box ? [..."xyz"].map((axis, i): Fact => [axis, span(box.lower[i]!, box.upper[i]!)]) : []),
    size !== "" && voxels.count
      ? [
          size,
          t("{inner_volume} to {volume} {unit}", {
            inner_volume: rounded(voxels.inner_volume),
            volume: rounded(voxels.volume),
            unit,
          }),
          t("Inner voxels, and all of them"),
        ]
      : null,
    [
      t("Voxels"),
      t("{count} of edge {size}", { count: voxels.count.toLocaleString(language), size: length(voxels.size) }),
    ],
    voxels.late_share === null ? null : [t("Found late"), late(voxels.late_share), LATE],
    measure.max === null || measure.mean === null
      ? null
      : [
          t("Manipulability"),
          t("{mean} on average, {max}{measureUnit} at best", {
            mean: rounded(measure.mean),
            max: rounded(measure.max),
            measureUnit,
          }),
        ],
    dexterity && dexterity.mean_share !== null
      ? [
          t("Dexterity"),
          t("{mean_share} on average, {max_share} at best; all of {orientations} in {full_volume} {unit}", {
            mean_share: percent(dexterity.mean_share),
            max_share: percent(dexterity.max_share ?? 0),
            orientations: dexterity.orientations,
            full_volume: rounded(dexterity.full_volume),
            unit,
          }),
        ]
      : null,
    [
      t("Pinocchio"),
      t("differs by {max_position_error} at most", {
        max_position_error: length(summary.certificate.max_position_error),
      }),
    ],
  ];
  return found.filter((fact): fact is Fact => fact !== null);
}

const LATE = t("Voxels that only the last tenth of the samples found");

function late(share: number): string {
  return t("{share} of the voxels{share2}", {
    share: percent(share),
    share2: share > FEW ? t(": more samples would find more") : "",
  });
}

function percent(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}

/** What the buttons below the numbers lead to. */
export interface Actions {
  /** Move the chain to where its manipulability was largest. */
  goToBest(summary: WorkspaceSummary): void;
  /** Forget the job, also at the service. */
  remove(): void;
  failed(error: unknown): void;
}

export class Results {
  readonly host = element("div", { class: "part" });

  constructor(
    private readonly api: Api,
    private readonly actions: Actions,
  ) {}

  show({ id, summary, table, npy }: Result, joints: readonly Joint[], units: Units): void {
    const name = `${summary.robot}-workspace`;
    const picture = button("SVG", () => void this.#savePicture(picture, id, name), {
      title: t("A picture of three projections"),
    });
    this.host.replaceChildren(
      element(
        "p",
        { class: "muted small" },
        t("{tip_frame} in {base_frame} of {robot}, from {samples} samples{summary}.", {
          tip_frame: summary.tip_frame,
          base_frame: summary.base_frame,
          robot: summary.robot,
          samples: summary.samples.toLocaleString(language),
          summary: freeOf(summary),
        }),
      ),
      element(
        "dl",
        { class: "facts workspace-facts" },
        ...facts(summary, joints, units).flatMap(([title, value, hint]) => [
          element("dt", { title: hint ?? "" }, title),
          element("dd", {}, value),
        ]),
      ),
      ...(summary.notes.length
        ? [element("ul", { class: "remarks" }, ...summary.notes.map((note) => element("li", {}, note)))]
        : []),
      element(
        "div",
        { class: "bar" },
        button(t("npy"), () => save(`${name}.npy`, NPY, npy), { title: t("All points, for numpy.load") }),
        button("JSON", () => save(`${name}.json`, "application/json", JSON.stringify(summary, null, 2)), {
          title: t("The summary"),
        }),
        picture,
        element("span", { class: "spring" }),
        summary.measure.joint_positions &&
          button(t("Best configuration"), () => this.actions.goToBest(summary), {
            title: t("Where the manipulability is largest"),
          }),
        button(t("Remove"), () => this.actions.remove(), { class: "button danger", title: t("Also from the service") }),
      ),
    );
    this.host.dataset["points"] = String(table.rows);
  }

  /** The service draws it, which takes a moment. */
  async #savePicture(pressed: HTMLButtonElement, id: string, name: string): Promise<void> {
    pressed.disabled = true;
    try {
      save(`${name}.svg`, SVG, await this.api.bytes(`${pathOf(id)}/result`, SVG));
    } catch (error) {
      this.actions.failed(error);
    }
    pressed.disabled = false;
  }

  clear(): void {
    this.host.replaceChildren();
    delete this.host.dataset["points"];
  }
}

/** In a scene: how many of them touch nothing, which alone count. */
function freeOf({ samples_free: free }: WorkspaceSummary): string {
  return free == null ? "" : t(", of which {free} touch nothing", { free: free.toLocaleString(language) });
}
