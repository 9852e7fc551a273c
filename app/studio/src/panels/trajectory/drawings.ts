/** Pictures of a plan that the service draws: its profiles, the ellipses along it, its corners. */

import type { Api } from "../../api.ts";
import type { ShownChain } from "../../robot/chain.ts";
import { asMatrix, isPose, position } from "../../robot/pose.ts";
import { t } from "../../texts/index.ts";
import { element } from "../../ui/dom.ts";
import { drawing, figureOf, svgOf } from "../../ui/drawing.ts";
import { ProblemView } from "../../ui/problem.ts";
import type { Plan } from "./answer.ts";
import { poseAt } from "./configurations.ts";
import type { Curve } from "./curve.ts";
import { request } from "./motion.ts";

/** Postures with an ellipse each: with more they cover each other. */
const POSTURES = 6;

interface Picture {
  name: string;
  button: string;
  title: string;
  call: { path: string; body: object };
}

/** Buttons for all pictures that there are of a plan, and the place of the one that was asked for last. */
export function drawings(api: Api, chain: ShownChain, plan: Plan, curve: Curve): HTMLElement {
  const problem = new ProblemView();
  const place = element("div");
  const buttons = [profiles(chain, plan), ellipses(chain, curve), ...corners(chain, plan, curve)].map((picture) => {
    const made = drawing(
      picture.button,
      picture.title,
      problem,
      async () => {
        const svg = await svgOf(api, { method: "POST", ...picture.call });
        return figureOf(svg, picture.title, picture.name, t("Save as SVG: {title}", { title: picture.title }));
      },
      place,
    );
    return made.ask;
  });
  return element("div", { class: "part" }, element("div", { class: "bar" }, ...buttons), problem.host, place);
}

function profiles({ path }: ShownChain, { motion, scene, others }: Plan): Picture {
  const call = { path: `${path}/trajectory`, body: request(motion, scene, others) };
  return { name: "profiles", button: t("Profiles drawn"), title: t("Profiles of the joints"), call };
}

/** The ellipses of translation, evenly spaced in time. */
function ellipses({ path, ends }: ShownChain, curve: Curve): Picture {
  const shares = Array.from({ length: POSTURES }, (_, i) => i / (POSTURES - 1));
  const body = { ...ends, joint_positions: shares.map((share) => curve.at(share * curve.duration)) };
  const call = { path: `${path}/manipulability`, body };
  return { name: "ellipses", button: t("Ellipses drawn"), title: t("Velocity ellipses along the motion"), call };
}

/** The course's fly-over of each blended corner: with the plan's radius, at the least speed that both lines allow. */
function corners(chain: ShownChain, { motion, answer }: Plan, curve: Curve): Picture[] {
  return answer.segments.flatMap(({ index, blend, start_time, limits }, i) => {
    const next = answer.segments[i + 1];
    const speeds = [limits.tip_velocity, next?.limits.tip_velocity].filter((speed) => speed != null);
    const { target } = motion.segments[index] ?? {};
    const isFlyOver = [index, index + 1].every((each) => motion.segments[each]?.type === "line");
    if (!blend || !next || !isFlyOver || speeds.length < 2 || !target || !isPose(target)) return [];
    const point = (time: number) => position(poseAt(chain, curve.at(time)));
    const corner = position(asMatrix(target));
    const speed = Math.min(...speeds);
    const body = {
      ...{ start: point(start_time), corner, end: point(next.end_time), radius: blend.radius },
      ...{ speed_before: speed, speed_after: speed },
    };
    const title = t("Fly-over from line {index} to line {index2}", { index: index + 1, index2: index + 2 });
    return [
      {
        name: "fly-over",
        button: t("Corner {index} drawn", { index: index + 1 }),
        title,
        call: { path: "v1/course/fly-over", body },
      },
    ];
  });
}
