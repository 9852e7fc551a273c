/** What travels over the public API, as far as the studio uses it; the OpenAPI schema says it in full. */

export type PoseFormat =
  "quaternion_xyzw" | "quaternion_wxyz" | "rpy" | "zyz" | "rotation_vector" | "rotation" | "matrix";

export interface Pose {
  position?: number[];
  quaternion_xyzw?: number[];
  quaternion_wxyz?: number[];
  rpy?: number[];
  zyz?: number[];
  rotation_vector?: number[];
  rotation?: number[][];
  matrix?: number[][];
}

export interface ChainEnds {
  base_frame: string;
  tip_frame: string;
}

export interface RobotSummary {
  name: string;
  description: string;
  source: "catalogue" | "uploaded";
  format: "urdf" | "dh";
  default_chain: ChainEnds;
}

export interface JointInfo {
  name: string;
  type: "revolute" | "continuous" | "prismatic" | "fixed" | "floating" | "planar";
  parent: string;
  child: string;
  limits: { lower: number | null; upper: number | null; velocity: number | null; effort: number | null };
  mimic: { joint: string; multiplier: number; offset: number } | null;
}

/** To be drawn of a link that shows nothing itself. */
export interface LinkShape {
  link: string;
  shape: { type: "box"; size: [number, number, number] } | { type: "cylinder"; radius: number; length: number };
  pose: { position: [number, number, number]; quaternion_xyzw: [number, number, number, number] };
}

export interface RobotInfo extends RobotSummary {
  chains: Record<string, ChainEnds>;
  root: string;
  joints: JointInfo[];
  dh: DhTable | null;
  degrees_of_freedom: number;
  links: string[];
  leaf_tips: string[];
  meshes: { reference: string; path: string | null }[];
  skeleton: LinkShape[];
  licence: string | null;
  provenance: string | null;
  warnings: string[];
}

export type Convention = "standard" | "modified";

export interface DhRow {
  name?: string;
  type: "revolute" | "prismatic";
  a: number;
  alpha: number;
  d: number;
  theta: number;
  lower?: number;
  upper?: number;
  velocity?: number;
  effort?: number;
  mimic?: { joint: string; multiplier: number; offset: number };
}

export interface DhTable {
  convention: Convention;
  joints: DhRow[];
  base?: Pose | null;
  tool?: Pose | null;
}

export interface Certificate {
  samples: number;
  max_position_error: number;
  max_orientation_error: number;
}

export interface ForwardAnswer {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  poses: Pose[];
  certificate: Certificate;
}

export interface ToUrdfAnswer {
  urdf: string;
  joint_names: string[];
  certificate: Certificate;
  warnings: string[];
}

export interface TableAnswer {
  dh: DhTable;
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  certificate: Certificate;
  notes: string[];
  warnings: string[];
}

export const DIRECTIONS = ["x", "y", "z", "rx", "ry", "rz"] as const;
export type Direction = (typeof DIRECTIONS)[number];

export type InverseMethod =
  "auto" | "analytic" | "newton" | "gradient" | "gradient_then_newton" | "damped_least_squares";

/** Fields of a call of `ik`, beside the targets, the seeds and the chain. */
export interface InverseOptions {
  method?: InverseMethod;
  solutions?: "one" | "all";
  task?: Direction[];
  respect_limits?: boolean;
  position_tolerance?: number;
  orientation_tolerance?: number;
}

export interface Errors {
  position_error: number;
  orientation_error: number;
}

export interface InverseSolution extends Errors {
  joint_positions: number[];
  method: string;
  iterations: number;
  restarts: number;
  branch: Record<string, string | number> | null;
  free_joints?: string[] | null;
}

export interface SolutionFamily {
  free_joints: string[];
  relation: string | null;
  text: string;
  sweep: number[][];
}

export interface Iteration {
  error: number;
  min_singular_value: number;
  step_length: number | null;
  method: string | null;
  joint_positions: number[];
}

export interface InverseResult {
  status: "solved" | "unreachable" | "outside_limits" | "singular" | "not_converged";
  solutions: InverseSolution[];
  reason: string | null;
  nearest?: (Errors & { joint_positions: number[]; pose: Pose }) | null;
  complete?: boolean | null;
  families?: SolutionFamily[] | null;
  stop_reason?: string | null;
  trace?: Iteration[] | null;
}

export interface InverseAnswer {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  task: Direction[];
  closed_form: string | null;
  results: InverseResult[];
}

export type Reference = "local_world_aligned" | "local" | "world";
export type Representation = "geometric" | "zyz" | "rpy";

export interface JacobianAnswer {
  joint_names: string[];
  /** 6 rows, n columns: [m or rad] per [rad or m]. */
  jacobians: number[][][];
  ranks: number[];
  singular_values: number[][];
  condition_numbers: (number | null)[];
  certificate: { max_error: number };
}

export interface Ellipsoid {
  /** Unit vectors; of the combined part six numbers each. */
  axes: number[][];
  /** Null where there is no end. */
  semi_axes: (number | null)[];
}

export interface PartAnswer {
  rank: number;
  singular: boolean;
  velocity_ellipsoid: Ellipsoid;
  force_ellipsoid: Ellipsoid;
  measure: number | null;
  condition_number: number | null;
  isotropy: number | null;
}

export type Part = "translation" | "rotation" | "combined";

export interface ManipulabilityAnswer {
  spaces: { part: Part; dimension: number; velocity_unit: string; force_unit: string; measure_unit: string }[];
  results: Record<Part, PartAnswer | null>[];
}

export interface SingularityReport {
  singular: boolean;
  rank: number;
  structural_rank: number;
  lost_directions: { twist: number[]; wrench: number[]; lost_here: boolean }[];
  internal_motions: { joint_velocities: number[]; only_here: boolean }[];
  dependent_joints: string[];
  kinds: string[];
  exit: { joint: string; direction: number[]; rate: number } | null;
  nearest?: NearestSingularity | null;
  nearest_reason?: string | null;
}

export interface NearestSingularity {
  distance: number;
  joint_positions: number[];
  joints: string[];
  within_limits: boolean;
  kinds: string[];
}

export interface SingularityAnswer {
  joint_names: string[];
  singularities: SingularityReport[];
}

/** A formula of a worked solution; null where it has too many terms to be written out. */
export interface MatrixFormula {
  name: string;
  latex: string | null;
}

export interface ColumnFormulas {
  joint: string;
  axis: MatrixFormula;
  /** Null for a prismatic joint. */
  arm: MatrixFormula | null;
  linear: MatrixFormula;
  angular: MatrixFormula;
}

/** The numbers of a worked solution at a configuration; transforms and the Jacobian row by row. */
export interface SolutionNumbers {
  A: number[][][];
  T_0: number[][][];
  T_base_tool: number[][];
  columns: { axis: number[]; arm: number[]; linear: number[]; angular: number[] }[];
  jacobian: number[][];
  /** Of the block that `determinant` of the answer names; null where none is square. */
  determinant: number | null;
}

export interface DeriveAnswer {
  convention: Convention;
  joint_names: string[];
  legend: { latex: string; plain: string; meaning_latex: string; meaning: string; value: number | null }[];
  A: MatrixFormula[];
  T_0: MatrixFormula[];
  T_base_tool: MatrixFormula | null;
  jacobian: { matrix: MatrixFormula; columns: ColumnFormulas[] } | null;
  determinant: { rows: string[]; frame: number; latex: string | null } | null;
  singularities: { condition: { latex: string }; example: number[] | null; example_singular_value: number | null }[];
  numeric: SolutionNumbers[];
  steps: { title: string; text: string; latex: string[] }[];
  notes: string[];
  certificate: { samples: number; max_error: number } | null;
  numeric_certificate: { max_position_error: number; max_jacobian_error: number } | null;
}

export interface JobInfo {
  id: string;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  /** From 0 to 1. */
  progress: number;
  error: { detail: string } | null;
}

export interface WorkspaceSummary {
  robot: string;
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  kind: "cloud" | "grid" | "dexterity";
  samples: number;
  samples_counted: number;
  bounding_box: { lower: number[]; upper: number[] } | null;
  reach: { min: number; max: number } | null;
  voxels: {
    size: number;
    dimensions: number;
    count: number;
    volume: number;
    inner_volume: number;
    late_share: number | null;
  };
  measure: {
    directions: number[][];
    min: number | null;
    mean: number | null;
    max: number | null;
    joint_positions: number[] | null;
  };
  dexterity: { orientations: number; mean_share: number | null; max_share: number | null; full_volume: number } | null;
  notes: string[];
  certificate: { max_position_error: number; max_measure_error: number };
}
