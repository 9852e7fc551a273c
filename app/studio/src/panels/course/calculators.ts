/** The calculators, in the order of the lectures. */

import type { Calculator } from "./calculator.ts";
import { encoder } from "./encoder.ts";
import { flyOver } from "./flyOver.ts";
import { mobility } from "./mobility.ts";
import { motor } from "./motor.ts";
import { orientation } from "./orientation.ts";
import { spline } from "./spline.ts";
import { timeLaw } from "./timeLaw.ts";
import { triangle } from "./triangle.ts";

export const CALCULATORS: readonly Calculator[] = [
  mobility,
  motor,
  encoder,
  orientation,
  triangle,
  timeLaw,
  spline,
  flyOver,
];
