/** What the page shows at this moment. The first part stands in the address bar, so that a link reopens exactly it. */

import type { Problem } from "./api.ts";
import type { Plan } from "./panels/trajectory/answer.ts";
import { type Theme, USUAL } from "./prefs.ts";
import type { Motion } from "./panels/trajectory/motion.ts";
import type { Parameter } from "./robot/dh.ts";
import type { RobotModel } from "./robot/model.ts";
import type { ChainTable } from "./robot/table.ts";
import type { Contacts } from "./scene/contacts.ts";
import { EMPTY, type Scene } from "./scene/objects.ts";
import type { DhTable, InverseOptions, Pose } from "./types.ts";
import { SI, type Units } from "./ui/quantity.ts";
import type { Look } from "./view/looking.ts";

export type Positions = Readonly<Record<string, number>>;

/** How the worked solution is written, and which part of it is open. */
export interface Writing {
  part: "transforms" | "pose" | "jacobian" | "singular" | "motion";
  /** `c_{12}`, or `cos(q_1 + q_2)`. */
  notation: "short" | "full";
  /** Whether lengths stay symbols; else their values stand in the formulas. */
  symbolic: boolean;
}

/** A row of a DH table, and one of its parameters or all of them. */
export interface Lit {
  row: number;
  part: Parameter | null;
}

export interface Linked extends Units {
  panel: string;
  /** Name of a robot that the service keeps; empty where a draft is shown. */
  robot: string;
  /** A table that is being typed and that the service does not keep yet. */
  draft: DhTable | null;
  /** Ends of the chain; null for the robot's default chain. */
  base: string | null;
  tip: string | null;
  /** Where the inverse is to bring the tip. */
  target: Pose | null;
  /** How the inverse is asked for, where it is not as usual. */
  inverse: InverseOptions | null;
  writing: Writing;
  /** The motion that is being built. */
  motion: Motion | null;
  /** What stands around the robot. */
  scene: Scene;
  theme: Theme;
  /** Where the picture is looked at from; null where the whole robot is fitted into it. */
  camera: Look | null;
  /** Whether the picture is a parallel projection. */
  parallel: boolean;
  frames: boolean;
  axes: boolean;
  names: boolean;
  dh: boolean;
  /** Whether the table's frames have all their dimensions and angles; else those of the row that is pointed at. */
  dimensions: boolean;
  /** Whether what contacts are computed of is in the picture. */
  bodies: boolean;
  /** What is chosen in panels, by `panel.option`; see `chosen`. */
  options: Readonly<Record<string, string>>;
}

export interface State extends Linked {
  /** Whether the choice of a robot is in the place of picture and panel. */
  starting: boolean;
  /** Position of every joint of the model that has one of its own, [rad or m]. */
  positions: Positions;
  /** The robot on the screen; the one before while another is on its way. */
  model: RobotModel | null;
  /** Grows with each mesh file that arrives: what is drawn of the model has changed. */
  meshes: number;
  /** Of the model's mesh files, as far as they have arrived, [bytes]. */
  received: number;
  loading: boolean;
  /** Why the robot or draft asked for is not on the screen. */
  failure: Problem | null;
  /** The table of the chain, where it has been asked for. */
  table: ChainTable | null;
  /** What the service made of a motion. */
  plan: Plan | null;
  /** What the robot touches, or comes nearest to; null where nobody asks. */
  contacts: Contacts | null;
  /** Why that is not known. */
  refusal: Problem | null;
  /** Name of the object of the scene that is being edited. */
  chosen: string | null;
  /** The joint that the pointer or the focus is on, in whatever list of joints. */
  joint: string | null;
  /** The row of the table that is pointed at, and the parameter, in the table or the picture. */
  lit: Lit | null;
  /** Length that suits marks on the robot on the screen, [m]. */
  unit: number;
  /** Width of the panel beside the picture, [px]; null for the usual one. */
  width: number | null;
  /** What the theme comes to on this system. */
  dark: boolean;
}

export const FIRST: Linked = {
  panel: "pose",
  robot: "panda",
  draft: null,
  base: null,
  tip: null,
  target: null,
  inverse: null,
  writing: { part: "transforms", notation: "short", symbolic: true },
  motion: null,
  scene: EMPTY,
  theme: USUAL.theme,
  camera: null,
  parallel: false,
  ...SI,
  frames: false,
  axes: false,
  names: false,
  dh: false,
  dimensions: false,
  bodies: false,
  options: {},
};

export function initial(linked: Linked, width: number | null): State {
  return {
    ...linked,
    starting: isNone(linked),
    positions: {},
    model: null,
    meshes: 0,
    received: 0,
    loading: false,
    failure: null,
    table: null,
    plan: null,
    contacts: null,
    refusal: null,
    chosen: null,
    joint: null,
    lit: null,
    unit: 0.1,
    width,
    dark: false,
  };
}

/** Whether a link names nothing to show. */
export function isNone({ robot, draft }: Pick<Linked, "robot" | "draft">): boolean {
  return robot === "" && draft === null;
}

/** What is chosen of an option's values: the first of them where a link names none. */
export function chosen<T extends string>(state: Readonly<State>, option: string, values: readonly T[]): T {
  return values.find((value) => value === state.options[option]) ?? values[0]!;
}

/** The options with another value for one of them; null for the one that it has by itself. */
export function choosing(state: Readonly<State>, option: string, value: string | null): Pick<State, "options"> {
  const { [option]: _, ...others } = state.options;
  return { options: value === null ? others : { ...others, [option]: value } };
}
