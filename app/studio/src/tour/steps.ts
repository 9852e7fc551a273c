/** The steps of the tour: what each shows, does and points at. */

import { showPart } from "../panels/robot/index.ts";
import { fresh, type Motion } from "../panels/trajectory/motion.ts";
import type { ShownChain } from "../robot/chain.ts";
import { asPose } from "../robot/pose.ts";
import type { State } from "../state.ts";
import type { Store } from "../store.ts";
import { t } from "../texts/index.ts";

export interface Step {
  title: string;
  text: string;
  /** What it points at, in the panel. */
  points: string;
  /** What it does, with the robot of the tour on the screen. */
  does(store: Store<State>, chain: ShownChain, signal: AbortSignal): void | Promise<void>;
}

/** An arm with a table, a closed form and several ways to one pose. */
export const ROBOT = "anthropomorphic_wrist";
const BENT = [0.4, 0.9, -1.2, 0.3, 0.7, 0.2];
const ASIDE = [-0.6, 1.2, -1.5, 0.3, 0.9, 0.2];
/** How long the arm takes from one to the other, [ms]. */
const MOVE = 1500;

export const STEPS: readonly Step[] = [
  {
    title: t("Choose a robot"),
    text: t(
      "The catalogue has robots by name, kind and maker; here is an arm with a spherical wrist. Your own file or table goes here too.",
    ),
    points: ".robots",
    does: (store) => {
      showPart("catalogue");
      open(store, "robot");
    },
  },
  {
    title: t("Move the joints"),
    text: t(
      "Each slider is a joint. The pose of the tip follows as matrix, angles and quaternion; links can be dragged in the picture.",
    ),
    points: ".joints",
    does: (store, chain, signal) => {
      open(store, "pose");
      return move(store, chain, BENT, signal);
    },
  },
  {
    title: t("Its DH table"),
    text: t(
      "Four numbers for each joint. Point at one, and the picture shows what it is: now the length of the upper arm.",
    ),
    points: "table.dh",
    does: (store) => {
      showPart("table");
      open(store, "robot");
      store.set({ dh: true, lit: { row: 1, part: "a" } });
    },
  },
  {
    title: t("Inverse kinematics"),
    text: t(
      "The tip is to stay where it is. Other configurations bring it there too: each is a branch, drawn as a ghost.",
    ),
    points: ".section:has(.solution)",
    does: (store, { model, base, tip }) => {
      store.set({ target: asPose(model.pose(base, tip), "rpy"), inverse: { solutions: "all" } });
      open(store, "ik");
    },
  },
  {
    title: t("Worked solution"),
    text: t(
      "The transforms, Jacobian and singularities of this arm, as one writes them in an exam, beside their values now.",
    ),
    points: ".sheet",
    does: (store) => open(store, "worked"),
  },
  {
    title: t("Plan a motion"),
    text: t(
      "From here to another configuration: the service has planned it within the limits of each joint. Play it, or add a line.",
    ),
    points: ".player",
    does: (store, chain) => {
      const motion: Motion = { ...fresh(chain), segments: [{ type: "joint", target: ASIDE }] };
      store.set({ motion, plan: null });
      open(store, "trajectory");
    },
  },
];

/** Open a panel, anew also where it is open already: it may show another part of itself. */
function open(store: Store<State>, panel: string): void {
  store.set({ panel: "" });
  store.set({ panel });
}

/** Bring the joints there, before one's eyes where these may see motion. */
function move(store: Store<State>, chain: ShownChain, to: readonly number[], signal: AbortSignal): Promise<void> {
  const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const from = chain.configuration;
  const begun = performance.now();
  return new Promise((done) => {
    const step = (now: number) => {
      if (signal.aborted || store.value.model !== chain.model) return done();
      const share = isCalm ? 1 : Math.min(1, Math.max(0, (now - begun) / MOVE));
      const smooth = share * share * (3 - 2 * share);
      const moved = chain.joints.map(({ name }, i) => [name, from[i]! + smooth * (to[i]! - from[i]!)]);
      store.set({ positions: { ...store.value.positions, ...Object.fromEntries(moved) } });
      if (share === 1) done();
      else requestAnimationFrame(step);
    };
    step(begun);
  });
}
