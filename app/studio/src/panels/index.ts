/** The panels, in the order of their tabs. */

import { cellPanel } from "./cell/index.ts";
import { comparePanel } from "./compare/index.ts";
import { coursePanel } from "./course/index.ts";
import { exercisesPanel } from "./exercises/index.ts";
import { inversePanel } from "./ik/index.ts";
import { jacobianPanel } from "./jacobian/index.ts";
import type { Panel } from "./panel.ts";
import { posePanel } from "./pose/index.ts";
import { robotPanel } from "./robot/index.ts";
import { trajectoryPanel } from "./trajectory/index.ts";
import { workedPanel } from "./worked/index.ts";
import { workspacePanel } from "./workspace/index.ts";

export const PANELS: readonly Panel[] = [
  robotPanel,
  posePanel,
  inversePanel,
  jacobianPanel,
  trajectoryPanel,
  workspacePanel,
  cellPanel,
  comparePanel,
  workedPanel,
  coursePanel,
  exercisesPanel,
];
