/** The path of a tool that may turn about one of its axes, in place of segments. */

import { t } from "../../texts/index.ts";
import { word } from "../../texts/words.ts";
import { button, element, toggle } from "../../ui/dom.ts";
import { column, type Units, unitOf } from "../../ui/quantity.ts";
import type { TrajectoryAnswer } from "../../types.ts";
import type { Draft } from "./draft.ts";
import { choice, optional } from "./fields.ts";
import { Folded } from "./folded.ts";
import { AXES, type FreeAxis, type Motion, type ToolPath } from "./motion.ts";
import { posesFrom } from "./poses.ts";

const FREE: readonly { value: FreeAxis | ""; text: string }[] = [
  ...AXES.map((value) => ({ value, text: t("About its {value} axis", { value: value.slice(1) }) })),
  { value: "", text: t("Not at all") },
];

export class Tool extends Folded {
  #shows: ((motion: Motion) => void)[] = [];
  #picker = element("input", {
    type: "file",
    accept: ".csv,.txt",
    class: "file",
    "aria-label": t("Poses of the tool, a table"),
    onchange: () => void this.#load(),
  });

  constructor(private readonly draft: Draft) {
    super(t("Tool path"), ["path"]);
    const set = element("div", { class: "part" }, element("div", { class: "settings" }, this.#free(), this.#steps()));
    set.append(element("div", { class: "bar" }, this.#approach(), this.#remove()));
    this.#shows.push(({ path }) => (set.hidden = !path));
    this.body.append(
      this.#picker,
      element(
        "p",
        { class: "muted small" },
        t(
          "A row for each pose of the tip in the base: x y z [m], then roll pitch yaw [rad] or qx qy qz qw. A first line may name the columns, and there may be others. For arms of six joints with a closed form.",
        ),
      ),
      set,
    );
  }

  update(): void {
    const { motion } = this.draft;
    for (const show of this.#shows) show(motion);
    const { path } = motion;
    this.summarise(path ? t("{length} poses in place of segments", { length: path.poses.length }) : t("none"));
  }

  async #load(): Promise<void> {
    const file = this.#picker.files?.[0];
    if (!file) return;
    try {
      const poses = posesFrom(await file.text());
      this.fail([]);
      this.#set({ poses });
    } catch (error) {
      this.fail([{ pointer: "#/path", detail: `${file.name}: ${(error as Error).message}` }]);
    }
  }

  #set(patch: Partial<ToolPath>): void {
    this.draft.set({ path: { ...(this.draft.motion.path ?? { poses: [], free: ["rz"] }), ...patch } });
  }

  #free(): HTMLElement {
    const field = choice(t("The tool may turn"), t("The tool may turn"), FREE, (axis) =>
      this.#set({ free: axis ? [axis] : [] }),
    );
    this.#shows.push(({ path }) => field.show(path?.free[0] ?? ""));
    return field.host;
  }

  #steps(): HTMLElement {
    const change = (steps: number | undefined) => {
      const { steps: _, ...rest } = this.draft.motion.path!;
      this.draft.set({ path: steps === undefined ? rest : { ...rest, steps } });
    };
    const field = optional(
      t("Turns tried at each pose"),
      t("Turns tried at each pose"),
      "",
      36,
      () => this.draft.units,
      change,
      "path/steps",
    );
    this.#shows.push(({ path }) => field.show(path?.steps));
    return field.host;
  }

  /** Where the motion begins: where the arm is now, or at the first pose. */
  #approach(): HTMLElement {
    const made = toggle(t("Begin where the arm is"), t("Else it begins at the first pose, as is best"), () =>
      this.draft.set(
        this.draft.motion.approach
          ? { approach: undefined }
          : { approach: true, start: this.draft.chain.configuration },
      ),
    );
    this.#shows.push(({ approach }) => made.setAttribute("aria-pressed", String(approach === true)));
    return made;
  }

  #remove(): HTMLElement {
    const back = () => {
      this.#picker.value = "";
      this.fail([]);
      this.draft.set({ path: undefined, approach: undefined });
    };
    return button(t("Back to segments"), back, { class: "button small" });
  }
}

/** How the tool is turned along its path, and on which branches the arm is; null for a motion of segments. */
export function choiceText({ path }: TrajectoryAnswer, units: Units): HTMLElement | null {
  if (!path?.turns.length) return null;
  const turn = (value: number) => column(value, "angle", units, 3);
  const branches = new Set(
    path.branches.map((branch) =>
      Object.entries(branch)
        .map((words) => words.map((part) => word(String(part))).join(" "))
        .join(", "),
    ),
  );
  const turns = t("Turned by {turns} to {turns2} {units}", {
    turns: turn(Math.min(...path.turns)),
    turns2: turn(Math.max(...path.turns)),
    units: unitOf("angle", units),
  });
  return element("p", { class: "small" }, `${turns}; ${[...branches].join("; ")}.`);
}
