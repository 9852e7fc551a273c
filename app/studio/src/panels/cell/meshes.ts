/** Mesh files, dropped on the page or chosen here: each becomes an object of the scene. */

import { asProblem, Problem } from "../../api.ts";
import { shownChain } from "../../robot/chain.ts";
import { freeName, type Shape } from "../../scene/objects.ts";
import { withMesh } from "../../scene/stored.ts";
import type { State } from "../../state.ts";
import { t } from "../../texts/index.ts";
import type { SceneObject } from "../../types.ts";
import { button, element } from "../../ui/dom.ts";
import type { ProblemView } from "../../ui/problem.ts";
import type { Studio } from "../panel.ts";

/** The file that was dropped last, until the panel takes it. */
let waiting: File | null = null;

/** A mesh has been dropped on the page: it is added when the panel is opened next. */
export function dropMesh(file: File): void {
  waiting = file;
}

/** A new object in front of the robot. */
export function inFront({ scene, unit, model }: Readonly<State>, base: string, shape: Shape): SceneObject {
  const taken = new Set([...scene.objects.map(({ name }) => name), ...(model?.links ?? [])]);
  const position = [5, 0, 1].map((steps) => Number((steps * unit).toFixed(2)));
  return { name: freeName(base, taken), shape, pose: { position, rpy: [0, 0, 0] } };
}

/** The button that adds a mesh; a file that was dropped is added at once. */
export function meshAdder({ store, api }: Studio, problem: ProblemView): HTMLButtonElement {
  const add = async (file: File) => {
    const chain = shownChain(store.value);
    if (!chain) return;
    made.disabled = true;
    try {
      const base = file.name.replace(/\.\w+$/, "").slice(0, 100) || "mesh";
      const object = (name: string) => inFront(store.value, base, { type: "mesh", file: name });
      const scene = await withMesh(api, chain, store.value.scene, file, object);
      problem.show(null);
      store.set({ scene, chosen: scene.objects.at(-1)!.name });
    } catch (error) {
      const { status, detail, facts } = asProblem(error);
      problem.show(new Problem(status, t("{name} cannot be added", { name: file.name }), detail, facts));
    } finally {
      made.disabled = false;
    }
  };
  const picker = element("input", {
    type: "file",
    accept: ".stl,.obj,.dae",
    hidden: true,
    onchange: () => {
      const [file] = picker.files ?? [];
      picker.value = "";
      if (file) void add(file);
    },
  });
  const made = button(t("Mesh …"), () => picker.click(), {
    title: t("An STL, OBJ or DAE file in metres, chosen here or dropped anywhere on the page"),
  });
  if (waiting) void add(waiting);
  waiting = null;
  return made;
}
