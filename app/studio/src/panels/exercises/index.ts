/** Exercises: draws, shows and grades the course's exercises. What does it is loaded when the panel is first opened. */

import "../../styles/exercises.css";

import { t } from "../../texts/index.ts";
import { later } from "../later.ts";
import type { Panel } from "../panel.ts";

export const exercisesPanel: Panel = {
  id: "exercises",
  title: t("Exercises"),
  open: later(() => import("./exercises.ts"), t("The exercises are not loaded")),
};
