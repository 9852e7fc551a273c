/** Course: the calculators of the course, each with its picture. What does it is loaded when the panel is first opened. */

import "../../styles/course.css";

import { t } from "../../texts/index.ts";
import { later } from "../later.ts";
import type { Panel } from "../panel.ts";

export const coursePanel: Panel = {
  id: "course",
  title: t("Course"),
  open: later(() => import("./course.ts"), t("The calculators are not loaded")),
};
