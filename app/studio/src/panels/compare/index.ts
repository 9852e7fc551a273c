/** Compare: a second robot or table beside the one on the screen. What does it is loaded when the panel is first opened. */

import "../../styles/compare.css";

import { t } from "../../texts/index.ts";
import { later } from "../later.ts";
import type { Panel } from "../panel.ts";

export const comparePanel: Panel = {
  id: "compare",
  title: t("Compare"),
  open: later(() => import("./compare.ts"), t("The comparison is not loaded")),
};
