/** What came out: reach, volume, the best place, how far the numbers can be trusted; and all of it as files. */

import type { Api } from "../../api.ts";
import type { Joint } from "../../robot/model.ts";
import type { WorkspaceSummary } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import { save } from "../../ui/files.ts";
import { fixed, rounded } from "../../ui/quantity.ts";
import type { Range } from "./cloud.ts";
import { NPY, pathOf, type Result } from "./job.ts";

const SVG = "image/svg+xml";
const POWERS = ["", "m", "m²", "m³"];
/** Above this share of voxels that only the last samples found, more samples would find many more. */
const FEW = 0.01;

/** Between what the colours are spread, and what they tell. */
export function meaning({ summary, table }: Result): { title: string; range: Range } {
  if (summary.kind === "dexterity")
    return { title: "Share of the orientations reached", range: { lower: 0, upper: 1 } };
  const range = { lower: Infinity, upper: -Infinity };
  for (let k = table.columns - 1; k < table.values.length; k += table.columns) {
    range.lower = Math.min(range.lower, table.values[k]!);
    range.upper = Math.max(range.upper, table.values[k]!);
  }
  const best = summary.kind === "grid" ? "Best manipulability" : "Manipulability";
  return { title: `${best} w = √det(JJᵀ)`, range: table.rows ? range : { lower: 0, upper: 0 } };
}

type Fact = [title: string, value: string, hint?: string];

/** The numbers of a summary, to be read. */
export function facts(summary: WorkspaceSummary, joints: readonly Joint[]): Fact[] {
  const { voxels, reach, bounding_box: box, measure, dexterity } = summary;
  const unit = POWERS[voxels.dimensions] ?? "";
  const turns = joints.length > 0 && joints.every(({ type }) => type !== "prismatic");
  const measureUnit = turns ? ` ${POWERS[measure.directions.length] ?? ""}` : "";
  const size = ["", "Length", "Area", "Volume"][voxels.dimensions] ?? "";
  const found: (Fact | null)[] = [
    reach && ["Reach", `${fixed(reach.min, 3)} to ${fixed(reach.max, 3)} m`, "Distances from the base frame's origin"],
    ...(box
      ? [..."xyz"].map((axis, i): Fact => [axis, `${fixed(box.lower[i]!, 3)} to ${fixed(box.upper[i]!, 3)} m`])
      : []),
    size !== "" && voxels.count
      ? [size, `${rounded(voxels.inner_volume)} to ${rounded(voxels.volume)} ${unit}`, "Inner voxels, and all of them"]
      : null,
    ["Voxels", `${voxels.count.toLocaleString("en")} of edge ${rounded(voxels.size)} m`],
    voxels.late_share === null ? null : ["Found late", late(voxels.late_share), LATE],
    measure.max === null || measure.mean === null
      ? null
      : ["Manipulability", `${rounded(measure.mean)} on average, ${rounded(measure.max)}${measureUnit} at best`],
    dexterity && dexterity.mean_share !== null
      ? [
          "Dexterity",
          `${percent(dexterity.mean_share)} on average, ${percent(dexterity.max_share ?? 0)} at best; ` +
            `all of ${dexterity.orientations} in ${rounded(dexterity.full_volume)} ${unit}`,
        ]
      : null,
    ["Pinocchio", `differs by ${rounded(summary.certificate.max_position_error)} m at most`],
  ];
  return found.filter((fact): fact is Fact => fact !== null);
}

const LATE = "Voxels that only the last tenth of the samples found";

function late(share: number): string {
  return `${percent(share)} of the voxels${share > FEW ? ": more samples would find more" : ""}`;
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

  show({ id, summary, table, npy }: Result, joints: readonly Joint[]): void {
    const name = `${summary.robot}-workspace`;
    const picture = button("SVG", () => void this.#savePicture(picture, id, name), {
      title: "A picture of three projections",
    });
    this.host.replaceChildren(
      element(
        "p",
        { class: "muted small" },
        `${summary.tip_frame} in ${summary.base_frame} of ${summary.robot}, from ${summary.samples.toLocaleString("en")} samples${freeOf(summary)}.`,
      ),
      element(
        "dl",
        { class: "facts workspace-facts" },
        ...facts(summary, joints).flatMap(([title, value, hint]) => [
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
        button("npy", () => save(`${name}.npy`, NPY, npy), { title: "All points, for numpy.load" }),
        button("JSON", () => save(`${name}.json`, "application/json", JSON.stringify(summary, null, 2)), {
          title: "The summary",
        }),
        picture,
        element("span", { class: "spring" }),
        summary.measure.joint_positions &&
          button("Best configuration", () => this.actions.goToBest(summary), {
            title: "Where the manipulability is largest",
          }),
        button("Remove", () => this.actions.remove(), { class: "button danger", title: "Also from the service" }),
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
  return free == null ? "" : `, of which ${free.toLocaleString("en")} touch nothing`;
}
