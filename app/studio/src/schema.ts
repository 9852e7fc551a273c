/** Made by `./dev studio` from the OpenAPI document, which describes each field; not to be edited. */

export type AbsoluteInfo = {
  readings: DiscPosition[];
  unwrapped: number[];
  motor_travel: number | null;
  load_travel: number | null;
  values: DiscPosition[];
  table: DiscPosition[] | null;
};

export type ArrayInfo = { shape: number[]; columns: string[] };

export type Audit = {
  passed: boolean;
  velocity: Peak | null;
  acceleration: Peak | null;
  jerk: Peak | null;
  path_deviation: Peak | null;
  orientation_deviation: Peak | null;
  continuity: Continuity;
  min_singular_value: SmallestSingularValue | null;
  limit_margin: LimitMargin | null;
  ends: Record<string, number>;
  tip: TipPeaks;
  joint_torque: Peak | null;
  certificate: PoseCertificate;
  way_error: PathError | null;
  reasons: Reason[];
  clearance?: MotionClearance | null;
};

export type AxisAngleInfo = { axis: number[] | null; other_axis: number[] | null; angle: number };

export type AxisAnglePayload = { axis: number[]; angle: number };

export type BlendCheck = {
  steps: number;
  max_position_error: number;
  max_velocity_error: number;
  closest_distance_error: number;
};

export type BlendsInfo = {
  velocities: number[][];
  accelerations: number[][];
  blend_times: number[][];
  deviations: number[][];
};

export type BlockingJoint = { name: string; position: number; lower: number; upper: number; excess: number };

export type BoxInfo = { lower: number[]; upper: number[] };

export type BoxShape = { type: "box"; size: number[] };

export type CarriedLoad = { mass: number; inertia?: number[] | null; center?: number[] };

export type ChainEnds = { base_frame: string; tip_frame: string };

export type ChristoffelSymbol = { i: number; j: number; k: number; latex: string; plain: string };

export type CircleSegment = {
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
  law?: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal" | null;
  duration?: number | null;
  type: "circle";
  via: Pose;
  target: Pose;
  blend_radius?: number | null;
  orientation?: "axis_angle" | "zyz" | "zyz_other";
};

export type ClosestPair = { a: string; b: string; distance: number; point_a: number[]; point_b: number[] };

export type CollisionAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  root_frame: string;
  results: CollisionResult[];
  warnings: string[];
  certificate: ContactCertificate;
};

export type CollisionBodies = { bodies: CollisionBody[]; warnings: string[] };

export type CollisionBody = {
  name: string;
  link: string;
  kind: "sphere" | "capsule" | "cylinder" | "box" | "convex";
  size: number[];
  points: number[][];
  T_link_body: number[][];
  excess: number | null;
  cover: SphereCover;
};

export type CollisionResult = { in_collision: boolean; clearance?: number | null; pairs?: ContactPair[] | null };

export type ColumnFormulas = {
  joint: string;
  axis: MatrixFormula;
  arm: MatrixFormula | null;
  linear: MatrixFormula;
  angular: MatrixFormula;
};

export type CompareAnswer = {
  equivalent: boolean;
  base: Pose | null;
  tool: Pose | null;
  offsets: number[] | null;
  signs: number[] | null;
  max_position_error: number | null;
  max_orientation_error: number | null;
  first_difference: DifferenceEntry | null;
  found: ("base" | "tool" | "offsets" | "signs")[];
  held: ("base" | "tool" | "offsets" | "signs")[];
  diagnoses: DiagnosisEntry[];
  unverified: Unverified[];
  notes: string[];
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  samples: number;
  random_seed: number;
};

export type Configuration = number[] | JointValues;

export type ContactCertificate = {
  samples: number;
  pairs: number;
  max_distance_error: number;
  touching: number;
  tolerance: number;
  seed: number;
};

export type ContactPair = { a: string; b: string; distance: number; point_a: number[]; point_b: number[] };

export type Continuity = { position: Jump | null; velocity: Jump | null; acceleration: Jump | null; jerk: Jump | null };

export type Controller = {
  pose_format: "ur" | "kuka_abc" | "abb" | "fanuc_wpr";
  base_frame: string;
  tip_frame: string;
  joint_signs: (-1 | 1)[];
  joint_zeros: number[];
  added?: Record<string, string>;
  subtracted?: Record<string, string>;
};

export type CoursePicture = { name: string; title: string };

export type CoursePictures = { pictures: CoursePicture[] };

export type CylinderShape = { type: "cylinder"; radius: number; length: number };

export type Damping = { distance: number; angle: number };

export type DcMotorAnswer = {
  steady_state: OperatingPoint;
  torque_speed_line: TorqueSpeedLine;
  dynamics: MotorDynamicsInfo;
  response: StepResponseInfo | null;
  steps: Step[];
  warnings: string[];
  certificate: MotorCertificate;
};

export type DcMotorRequest = {
  language?: "en" | "de";
  resistance: number;
  inductance: number;
  torque_constant: number;
  back_emf_constant?: number | null;
  viscous_friction?: number;
  inertia: number;
  voltage: number;
  load_torque?: number;
  times?: number[] | null;
  duration?: number | null;
  samples?: number | null;
  initial_current?: number;
  initial_angular_velocity?: number;
};

export type Degeneracy = {
  notation: "zyz" | "rpy" | "axis_angle";
  case: string;
  determined: string | null;
  value: number | null;
  chosen: string;
};

export type DeriveAnswer = {
  convention: "standard" | "modified";
  joint_names: string[];
  notation: "short" | "full";
  symbolic: boolean;
  legend: SymbolEntry[];
  A: MatrixFormula[];
  T_0: MatrixFormula[];
  T_base_tool: MatrixFormula | null;
  position: MatrixFormula | null;
  rotation: MatrixFormula | null;
  jacobian: JacobianInfo | null;
  determinant: DeterminantInfo | null;
  singularities: SingularCondition[];
  dynamics: DynamicsInfo | null;
  numeric: NumericInfo[];
  steps: Step[];
  notes: string[];
  certificate: FormulaCertificate | null;
  numeric_certificate: NumericCertificate | null;
};

export type DeterminantInfo = {
  block: "full" | "moving" | "linear" | "angular";
  rows: ("v_x" | "v_y" | "v_z" | "omega_x" | "omega_y" | "omega_z")[];
  frame: number;
  why: string;
  latex: string | null;
  plain: string | null;
  factors: Formula[];
};

export type DexterityInfo = {
  method: "inverse_kinematics";
  spread: "rotations" | "approach_directions" | "turns" | "fixed";
  orientations: number;
  mean_share: number | null;
  max_share: number | null;
  reached_count: number;
  full_count: number;
  full_volume: number;
  full_volume_bounds: number[];
  excluded: string | null;
};

export type DhJointRow = {
  name?: string | null;
  type: "revolute" | "prismatic";
  a: number;
  alpha: number;
  d: number;
  theta: number;
  lower?: number | null;
  upper?: number | null;
  velocity?: number | null;
  effort?: number | null;
  mimic?: MimicPayload | null;
};

export type DhTablePayload = {
  convention: "standard" | "modified";
  joints: DhJointRow[];
  base?: Pose | null;
  tool?: Pose | null;
};

export type DiagnosisEntry = {
  mistake:
    | "sign"
    | "degrees"
    | "millimetres"
    | "centimetres"
    | "power_of_ten"
    | "convention"
    | "columns"
    | "rows"
    | "row_missing"
    | "row_doubled"
    | "row_extra"
    | "joint_sense"
    | "number"
    | "joint_zero"
    | "base"
    | "tool";
  mistakes: (
    | "sign"
    | "degrees"
    | "millimetres"
    | "centimetres"
    | "power_of_ten"
    | "convention"
    | "columns"
    | "rows"
    | "row_missing"
    | "row_doubled"
    | "row_extra"
    | "joint_sense"
    | "number"
    | "joint_zero"
    | "base"
    | "tool"
  )[];
  detail: string;
  differences: DifferenceEntry[];
};

export type DifferenceEntry = {
  row: number | null;
  joint: string | null;
  parameter: "a" | "alpha" | "d" | "theta" | "sign" | "type" | "mimic" | "joints" | "base" | "tool";
  value: number | string | null;
  expected: number | string | null;
  difference: number | null;
  pointer: string | null;
};

export type DiscPosition = { value: number; binary: string; gray: string; angle: number };

export type DynamicsInfo = {
  gravity: MatrixFormula;
  links: LinkFormulas[];
  mass_matrix: MatrixFormula;
  christoffel: ChristoffelSymbol[];
  coriolis: MatrixFormula;
  coriolis_vector: MatrixFormula;
  gravity_vector: MatrixFormula;
  skew: MatrixFormula;
  equations_of_motion: Formula[];
  numeric: MotionNumbers[];
  certificate: EquationsCertificate;
  numeric_certificate: EquationsCertificate | null;
};

export type ElementaryPayload = { axis: "x" | "y" | "z"; angle: number };

export type EllipsoidCertificate = {
  samples: number;
  max_error: number;
  max_time_variation_error: number | null;
  seed: number;
  max_ellipsoid_error: number;
};

export type EllipsoidInfo = { axes: number[][]; semi_axes: (number | null)[]; unbounded: boolean[] };

export type EncoderAnswer = {
  resolution: EncoderResolution | null;
  required: RequiredEncoder | null;
  quadrature: Quadrature | null;
  absolute: AbsoluteInfo | null;
  steps: Step[];
};

export type EncoderRequest = {
  language?: "en" | "de";
  type: "incremental" | "absolute";
  gear_ratio?: number;
  sample_period?: number | null;
  motor_angular_velocity?: number | null;
  wanted_resolution?: number | null;
  decoding?: "x1" | "x2" | "x4";
  pulses_per_revolution?: number | null;
  samples?: string | null;
  counter_bits?: number | null;
  bits?: number | null;
  code?: "gray" | "binary";
  readings?: string[] | null;
  values?: number[] | null;
  table?: boolean;
};

export type EncoderResolution = {
  counts_per_revolution: number;
  motor: number;
  load: number;
  motor_velocity_quantum: number | null;
  load_velocity_quantum: number | null;
  count_rate: number | null;
};

export type EquationsCertificate = {
  samples: number;
  max_mass_matrix_error: number;
  max_coriolis_error: number;
  max_gravity_error: number;
  seed: number | null;
};

export type ExerciseChoice = { value: string; text: string };

export type ExerciseField = {
  name: string;
  kind: string;
  label: string;
  unit: string | null;
  tolerance: number;
  is_relative: boolean;
  points: number;
  shape: number[];
  choices: ExerciseChoice[];
};

export type ExerciseFieldGrade = { name: string; correct: boolean; points: number; mistake: MistakeInfo | null };

export type ExerciseGrade = {
  id: string;
  version: number;
  points: number;
  max_points: number;
  fields: ExerciseFieldGrade[];
};

export type ExerciseInfo = { id: string; lecture: string; title: string; difficulty: number; version: number };

export type ExerciseList = { exercises: ExerciseInfo[] };

export type ExerciseRequest = { language?: "en" | "de"; seed: number };

export type ExerciseSolution = { id: string; version: number; answers: Record<string, unknown>; steps: Step[] };

export type ExerciseVariant = {
  id: string;
  version: number;
  text: string;
  picture: string | null;
  fields: ExerciseField[];
  hints: string[];
};

export type ExitInfo = { joint: string; direction: number[]; rate: number };

export type Family = { free_joints: string[]; relation: string | null; text: string; sweep: number[][] };

export type FlyOverAnswer = {
  given: "blend_time" | "distance_before" | "distance_after" | "radius" | "max_acceleration";
  blend: FlyOverBlend;
  rest_to_rest: RestToRestInfo | null;
  motion: MotionInfo | null;
  samples: FlyOverSamples | null;
  steps: Step[];
  warnings: string[];
  certificate: BlendCheck;
};

export type FlyOverBlend = {
  blend_time: number;
  distance_before: number;
  distance_after: number;
  entry: number[];
  exit: number[];
  direction_before: number[];
  direction_after: number[];
  turn: "corner" | "straight" | "reversal";
  angle: number;
  acceleration: number[];
  acceleration_norm: number;
  closest_distance: number;
  closest_time: number;
  longest_blend_time: number;
};

export type FlyOverRequest = {
  language?: "en" | "de";
  start: number[];
  corner: number[];
  end: number[];
  speed_before: number;
  speed_after: number;
  blend_time?: number | null;
  distance_before?: number | null;
  distance_after?: number | null;
  radius?: number | null;
  max_acceleration?: number | null;
  rest_acceleration?: number | null;
  samples?: number | null;
};

export type FlyOverSamples = {
  times: number[];
  positions: number[][];
  velocities: number[][];
  accelerations: number[][];
};

export type ForceLimit = { direction: number[]; alone: number | null; component: number | null };

export type ForcePolytope = { along: ForceLimit[]; vertices: number[][] | null };

export type Formula = { latex: string; plain: string };

export type FormulaCertificate = { samples: number; max_error: number; seed: number };

export type ForwardAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  poses: Pose[];
  frames?: Record<string, Pose>[] | null;
  steps?: Step[][] | null;
  certificate: PoseCertificate;
};

export type ForwardRequest = {
  language?: "en" | "de";
  steps?: boolean;
  base_frame?: string | null;
  tip_frame?: string | null;
  pose_format?:
    | "quaternion_xyzw"
    | "quaternion_wxyz"
    | "rpy"
    | "zyz"
    | "rotation_vector"
    | "rotation"
    | "matrix"
    | "ur"
    | "kuka_abc"
    | "abb"
    | "fanuc_wpr";
  frames?: string[] | "all" | null;
  respect_limits?: boolean;
  joint_positions: Configuration[];
};

export type FrameInfo = { rotation: number[][]; position: number[] };

export type FromUrdfAnswer = {
  dh: DhTablePayload;
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  certificate: TableCertificate;
  notes: string[];
  warnings: string[];
  steps: Step[] | null;
};

export type FurtherPayload = {
  quaternion_xyzw?: number[] | null;
  quaternion_wxyz?: number[] | null;
  rpy?: number[] | null;
  zyz?: number[] | null;
  rotation_vector?: number[] | null;
  rotation?: number[][] | null;
  axis_angle?: AxisAnglePayload | null;
  elementary?: ElementaryPayload | null;
  project?: boolean;
  position?: number[] | null;
  about?: "moving" | "fixed";
};

export type IdleSpin = { links: string[]; joints: string[] };

export type IndexPulse = { sample: number; count: number; count_error: number | null };

export type InternalMotionInfo = { joint_velocities: number[]; only_here: boolean };

export type InverseAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  task: ("x" | "y" | "z" | "rx" | "ry" | "rz")[];
  closed_form: string | null;
  warnings?: string[] | null;
  certificate?: ContactCertificate | null;
  results: InverseResult[];
};

export type InverseRequest = {
  language?: "en" | "de";
  steps?: boolean;
  scene?: string | Scene | null;
  min_clearance?: number | null;
  other_joints?: JointValues | null;
  base_frame?: string | null;
  tip_frame?: string | null;
  method?: "auto" | "analytic" | "newton" | "gradient" | "gradient_then_newton" | "damped_least_squares";
  solutions?: "one" | "all";
  position_tolerance?: number;
  orientation_tolerance?: number;
  task?: ("x" | "y" | "z" | "rx" | "ry" | "rz")[] | null;
  respect_limits?: boolean;
  max_iterations?: number | null;
  time_limit?: number | null;
  random_seed?: number;
  max_solutions?: number;
  windings?: boolean;
  objective?: "posture" | "mid_range" | "limits" | "manipulability" | "clearance" | null;
  step_size?: number | null;
  damping?: number | null;
  switch_error?: number;
  elbow_angle?: number | null;
  fixed_joints?: Record<string, number> | null;
  trace?: boolean;
  pose_format?:
    | "quaternion_xyzw"
    | "quaternion_wxyz"
    | "rpy"
    | "zyz"
    | "rotation_vector"
    | "rotation"
    | "matrix"
    | "ur"
    | "kuka_abc"
    | "abb"
    | "fanuc_wpr";
  targets: Pose[];
  seeds?: Configuration[] | null;
  posture?: Configuration | null;
};

export type InverseResult = {
  status: "solved" | "unreachable" | "outside_limits" | "singular" | "not_converged" | "in_collision";
  solutions: SolutionInfo[];
  reason: string | null;
  nearest?: NearestInfo | null;
  blocking_joints?: BlockingJoint[] | null;
  unserved_directions?: number[][] | null;
  complete?: boolean | null;
  families?: Family[] | null;
  stop_reason?:
    "converged" | "stagnated" | "near_singular" | "at_limits" | "diverged" | "time_limit" | "iterations" | null;
  trace?: Iterate[] | null;
  note?: string | null;
  steps?: Step[] | null;
};

export type Iterate = {
  error: number;
  min_singular_value: number;
  step_length: number | null;
  method: string | null;
  joint_positions: number[];
};

export type JacobianAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  reference: "local_world_aligned" | "local" | "world" | "space_screws" | "body_screws";
  representation: "geometric" | "zyz" | "rpy";
  jacobians: number[][][];
  ranks: number[];
  singular_values: number[][];
  condition_numbers: (number | null)[];
  rank_tolerance: number;
  time_variations?: number[][][] | null;
  hessians?: number[][][][] | null;
  steps?: Step[][] | null;
  certificate: JacobianCertificate;
};

export type JacobianCertificate = {
  samples: number;
  max_error: number;
  max_time_variation_error: number | null;
  seed: number;
};

export type JacobianInfo = { matrix: MatrixFormula; columns: ColumnFormulas[] };

export type JobError = { type: string; detail: string; facts: Record<string, unknown> };

export type JobInfo = {
  id: string;
  kind: "workspace" | "ik" | "trajectory" | "trajectories";
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  progress: number;
  created: string;
  started: string | null;
  finished: string | null;
  attempts: number;
  robot_digest?: string | null;
  error?: JobError | null;
};

export type JointInfo = {
  name: string;
  type: "revolute" | "continuous" | "prismatic" | "fixed" | "floating" | "planar";
  parent: string;
  child: string;
  origin: Pose;
  axis: number[] | null;
  limits: LimitsInfo;
  mimic: MimicInfo | null;
};

export type JointSegment = {
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
  law?: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal" | null;
  duration?: number | null;
  type: "joint";
  target: number[] | JointValues | Pose;
};

export type JointSplit = { joint: string; links: number; pairs: number; added: number; constraints: number };

export type JointValues = Record<string, number>;

export type Jump = { value: number; joint: string | null; time: number };

export type KnotInfo = {
  time: number;
  positions: number[];
  velocities: number[];
  accelerations: number[];
  fictitious: boolean;
};

export type LimitMargin = { value: number; joint: string; bound: "lower" | "upper"; time: number };

export type LimitSourcesInfo = {
  joint_velocity: ("request" | "robot" | "assumed")[];
  joint_acceleration: ("request" | "robot" | "assumed")[];
  joint_jerk: ("request" | "robot" | "assumed")[];
};

export type LimitsInfo = { lower: number | null; upper: number | null; velocity: number | null; effort: number | null };

export type LineSegment = {
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
  law?: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal" | null;
  duration?: number | null;
  type: "line";
  target: Pose;
  blend_radius?: number | null;
  blend_acceleration?: number | null;
  blend_time?: number | null;
  orientation?: "axis_angle" | "zyz" | "zyz_other";
};

export type LinkFormulas = {
  joint: string;
  center_of_mass: MatrixFormula;
  velocity: MatrixFormula;
  angular_velocity: Formula;
  kinetic_energy: Formula;
  potential_energy: Formula;
};

export type LinkShape = { link: string; shape: BoxShape | CylinderShape; pose: Pose };

export type LostDirectionInfo = { twist: number[]; wrench: number[]; lost_here: boolean };

export type ManipulabilityAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  reference: "local_world_aligned" | "local";
  task: ("x" | "y" | "z" | "rx" | "ry" | "rz")[];
  rank_tolerance: number;
  characteristic_length: number | null;
  spaces: SpaceInfo[];
  joints_without_velocity_limit?: string[] | null;
  joints_without_effort_limit?: string[] | null;
  results: ManipulabilityInfo[];
  steps?: Step[][] | null;
  certificate: EllipsoidCertificate;
};

export type ManipulabilityInfo = { translation: PartInfo | null; rotation: PartInfo | null; combined: PartInfo | null };

export type MatrixFormula = { name: string; latex: string | null; plain: string[][] | null };

export type MeasureInfo = {
  directions: number[][];
  min: number | null;
  mean: number | null;
  max: number | null;
  position: number[] | null;
  joint_positions: number[] | null;
};

export type MechanismLinkPayload = { name: string; ground?: boolean };

export type MeshInfo = { reference: string; path: string | null };

export type MimicInfo = { joint: string; multiplier: number; offset: number };

export type MimicPayload = { joint: string; multiplier?: number; offset?: number };

export type MistakeInfo = { code: string; text: string };

export type MobilityAnswer = {
  mobility: number;
  verdict: "mechanism" | "structure" | "overconstrained";
  space: "planar" | "spatial";
  space_freedoms: number;
  link_count: number;
  pair_count: number;
  constraint_count: number;
  coupling_count: number;
  kinds: PairCount[];
  splits: JointSplit[];
  mobility_without_split: number | null;
  idle: IdleSpin[] | null;
  mobility_without_idle: number | null;
  ground: string | null;
  chain: "open" | "closed" | "mixed" | null;
  loop_count: number | null;
  components: string[][] | null;
  bridges: string[] | null;
  pairs: Pair[] | null;
  mobility_by_loops: number | null;
  posture: PostureMobility | null;
  rank_tolerance: number | null;
  spaces: SpacesInfo | null;
  warnings: string[];
  steps: Step[];
};

export type MobilityRequest = {
  language?: "en" | "de";
  space?: "planar" | "spatial" | null;
  links?: number | (string | MechanismLinkPayload)[] | null;
  pairs?: PairPayload[] | Record<string, number> | null;
  coincident?: NodePayload[] | null;
  output?: string | null;
  rank_tolerance?: number;
  robot?: string | null;
};

export type Moment = { value: number | null; time: number; joint_positions: number[]; pair: ClosestPair | null };

export type Motion = {
  language?: "en" | "de";
  steps?: boolean;
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
  base_frame?: string | null;
  tip_frame?: string | null;
  start?: Configuration | null;
  start_velocities?: Configuration | null;
  start_accelerations?: Configuration | null;
  end_velocities?: Configuration | null;
  end_accelerations?: Configuration | null;
  segments?: (JointSegment | LineSegment | CircleSegment | SplineSegment)[] | null;
  path?: ToolPath | null;
  payload?: CarriedLoad | null;
  gravity?: boolean | number[];
  law?: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal";
  law_fallback?: boolean;
  duration?: number | null;
  sample_period?: number;
  path_tolerance?: number;
  orientation_tolerance?: number;
  task?: ("x" | "y" | "z" | "rx" | "ry" | "rz")[] | null;
  near_singularity?: "stop" | "damp" | "slow_down";
  min_singular_value?: number;
  compare_timing?: boolean;
  coefficients?: boolean;
  tip_poses?: boolean;
  torques?: boolean;
  pose_format?:
    | "quaternion_xyzw"
    | "quaternion_wxyz"
    | "rpy"
    | "zyz"
    | "rotation_vector"
    | "rotation"
    | "matrix"
    | "ur"
    | "kuka_abc"
    | "abb"
    | "fanuc_wpr";
};

export type MotionCertificate = {
  boundary_error: number;
  knot_error: number;
  continuity: number;
  continuity_error: number;
  peak_error: number;
  samples: number;
};

export type MotionClearance = {
  value: number | null;
  time: number;
  joint_positions: number[];
  pair: ClosestPair | null;
  lower_bound: number | null;
  resolution: number;
  certificate: ContactCertificate;
  continuous: true;
};

export type MotionInfo = { breaks: number[]; coefficients: number[][][] };

export type MotionLimits = {
  joint_velocity?: number | number[] | null;
  joint_acceleration?: number | number[] | null;
  joint_jerk?: number | number[] | null;
};

export type MotionLimitsInfo = {
  joint_velocity: number[];
  joint_acceleration: number[];
  joint_jerk: number[];
  joint_torque?: (number | null)[] | null;
  tip_velocity: number | null;
  tip_acceleration: number | null;
  tip_angular_velocity: number | null;
  tip_angular_acceleration: number | null;
};

export type MotionNumbers = {
  joint_positions: number[];
  joint_velocities: number[] | null;
  mass_matrix: number[][];
  coriolis: number[][] | null;
  coriolis_vector: number[] | null;
  gravity_vector: number[];
};

export type MotionOptions = {
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
};

export type MotorCertificate = {
  voltage_residual: number;
  torque_residual: number;
  samples: number;
  max_current_difference: number | null;
  max_angular_velocity_difference: number | null;
};

export type MotorDynamicsInfo = {
  poles: PoleInfo[];
  damping: "first_order" | "overdamped" | "critically_damped" | "underdamped";
  time_constants: number[];
  mechanical_time_constant: number;
  electrical_time_constant: number;
};

export type NearestInfo = {
  joint_positions: number[];
  pose: Pose;
  position_error: number;
  orientation_error: number;
  clearance?: number | null;
  pair?: ContactPair | null;
};

export type NearestSingularityInfo = {
  distance: number;
  joint_positions: number[];
  displacement: number[];
  joints: string[];
  within_limits: boolean;
  smallest_singular_value: number;
  kinds: ("wrist" | "elbow" | "shoulder")[];
  dependent_joints: string[];
};

export type NodePayload = {
  joint?: string | null;
  links: number | string[];
  type?:
    | "revolute"
    | "prismatic"
    | "rolling"
    | "pin_in_slot"
    | "cam"
    | "gear"
    | "screw"
    | "universal"
    | "cylindrical"
    | "spherical"
    | "planar"
    | "sphere_in_groove"
    | "point_contact"
    | "fixed"
    | "R"
    | "P"
    | "H"
    | "U"
    | "C"
    | "S"
    | "E"
    | null;
};

export type NumericCertificate = {
  samples: number;
  max_position_error: number;
  max_orientation_error: number;
  max_jacobian_error: number;
};

export type NumericColumn = { axis: number[]; arm: number[]; linear: number[]; angular: number[] };

export type NumericInfo = {
  joint_positions: number[];
  A: number[][][];
  T_0: number[][][];
  T_base_tool: number[][];
  position: number[];
  rotation: number[][];
  columns: NumericColumn[];
  jacobian: number[][];
  singular_values: number[];
  rank: number;
  determinant: number | null;
};

export type OperatingPoint = {
  angular_velocity: number;
  current: number;
  torque: number;
  electrical_power: number;
  shaft_power: number;
  copper_loss: number;
  friction_loss: number;
  efficiency: number | null;
  regime: "motoring" | "standstill" | "assisted" | "generating" | "driven_backwards" | "braking";
};

export type OrientationAnswer = {
  rotation: number[][];
  quaternion_xyzw: number[];
  quaternion_wxyz: number[];
  rotation_vector: number[];
  axis_angle: AxisAngleInfo;
  zyz: number[];
  zyz_solutions: number[][];
  rpy: number[];
  rpy_solutions: number[][];
  degenerate: Degeneracy[];
  degenerate_threshold: number;
  position: number[];
  inverse: FrameInfo;
  points: number[][];
  frames: FrameInfo[];
  validations: (Validation | null)[];
  steps: Step[];
  warnings: string[];
  certificate: OrientationCertificate;
};

export type OrientationCertificate = { max_rotation_error: number; max_inverse_error: number; max_point_error: number };

export type OrientationRequest = {
  language?: "en" | "de";
  quaternion_xyzw?: number[] | null;
  quaternion_wxyz?: number[] | null;
  rpy?: number[] | null;
  zyz?: number[] | null;
  rotation_vector?: number[] | null;
  rotation?: number[][] | null;
  axis_angle?: AxisAnglePayload | null;
  elementary?: ElementaryPayload | null;
  project?: boolean;
  position?: number[] | null;
  then?: FurtherPayload[];
  points?: number[][];
};

export type Pair = {
  name: string;
  link_a: string;
  link_b: string;
  type: string;
  order: "low" | "high" | null;
  constraints: number;
  freedoms: number;
  joint: string | null;
  added: boolean;
};

export type PairCount = { type: string; order: "low" | "high" | null; count: number; constraints: number };

export type PairPayload = {
  name?: string | null;
  link_a: string;
  link_b: string;
  type:
    | "revolute"
    | "prismatic"
    | "rolling"
    | "pin_in_slot"
    | "cam"
    | "gear"
    | "screw"
    | "universal"
    | "cylindrical"
    | "spherical"
    | "planar"
    | "sphere_in_groove"
    | "point_contact"
    | "fixed"
    | "R"
    | "P"
    | "H"
    | "U"
    | "C"
    | "S"
    | "E";
  joint?: string | null;
  point?: number[] | null;
  axis?: number[] | null;
  second_axis?: number[] | null;
  pitch?: number | null;
};

export type PartInfo = {
  rank: number;
  singular: boolean;
  velocity_ellipsoid: EllipsoidInfo;
  force_ellipsoid: EllipsoidInfo;
  measure: number | null;
  volume: number | null;
  condition_number: number | null;
  isotropy: number | null;
  gradient?: number[] | null;
  transmission?: Transmission[] | null;
  velocity_polytope?: VelocityPolytope | null;
  force_polytope?: ForcePolytope | null;
};

export type PathError = { velocity: number | null; acceleration: number | null; jerk: number | null };

export type Peak = { ratio: number | null; value: number; joint: string | null; time: number };

export type PeakInfo = { value: number; time: number; limit: number | null; ratio: number | null };

export type PeaksInfo = { velocity: PeakInfo[]; acceleration: PeakInfo[]; jerk: PeakInfo[] };

export type Phase = { name: "accelerate" | "coast_before" | "blend" | "coast_after" | "decelerate"; duration: number };

export type PlaneInfo = { origin: number[]; normal: number[]; thickness: number };

export type PlanningFailure = {
  reason: "out_of_reach" | "joint_limit" | "singularity" | "branch_change" | "collision";
  segment: number;
  time: number;
  position: number[];
  joint: string | null;
  detail: string;
  first_contact?: Moment | null;
  nearest?: Moment | null;
};

export type PoleInfo = { real: number; imaginary: number };

export type PolynomialsInfo = { breaks: number[]; coefficients: number[][][] };

export type Pose = {
  position?: number[] | null;
  quaternion_xyzw?: number[] | null;
  quaternion_wxyz?: number[] | null;
  rpy?: number[] | null;
  zyz?: number[] | null;
  rotation_vector?: number[] | null;
  rotation?: number[][] | null;
  matrix?: number[][] | null;
  ur?: number[] | null;
  kuka_abc?: number[] | null;
  abb?: number[] | null;
  fanuc_wpr?: number[] | null;
};

export type PoseCertificate = {
  samples: number;
  max_position_error: number;
  max_orientation_error: number;
  seed: number;
};

export type PostureMobility = {
  mobility: number;
  redundant: number;
  output: number | null;
  smallest_counted: number | null;
  largest_neglected: number | null;
  residual: number;
};

export type ProfileInfo = {
  peak_velocity: number;
  acceleration: number;
  acceleration_time: number;
  coast_time: number;
  deceleration_time: number;
  own_duration: number;
  factor: number | null;
  reverses: boolean;
};

export type Quadrature = {
  count: number;
  counts: number[];
  direction: "forward" | "backward" | "none";
  reversals: number;
  illegal_transitions: number[];
  motor_angle: number | null;
  load_angle: number | null;
  motor_angle_in_turn: number | null;
  register_value: number | null;
  index_pulses: IndexPulse[];
  count_from_index: number | null;
};

export type ReachInfo = { min: number; max: number };

export type Reason = {
  check:
    | "velocity"
    | "acceleration"
    | "jerk"
    | "joint_limit"
    | "continuity"
    | "path"
    | "tip"
    | "boundary"
    | "torque"
    | "clearance";
  detail: string;
  joint: string | null;
  time: number;
};

export type RequiredEncoder = {
  motor_resolution: number;
  counts_per_revolution: number;
  bits: number;
  pulses_per_revolution: number;
  count_rate: number | null;
};

export type RestToRestInfo = { phases: Phase[]; duration: number; stopping_duration: number; time_saved: number };

export type RobotInfo = {
  name: string;
  description: string;
  maker: string | null;
  kind: string | null;
  closed_form: string | null;
  source: "catalogue" | "uploaded";
  format: "urdf" | "dh";
  default_chain: ChainEnds;
  payload: number | null;
  reach: number | null;
  controller: Controller | null;
  chains: Record<string, ChainEnds>;
  root: string;
  joints: JointInfo[];
  joint_names: string[];
  dh?: DhTablePayload | null;
  degrees_of_freedom: number;
  links: string[];
  frames: string[];
  leaf_tips: string[];
  meshes: MeshInfo[];
  skeleton: LinkShape[];
  licence: string | null;
  provenance: string | null;
  warnings: string[];
};

export type RobotSummary = {
  name: string;
  description: string;
  maker: string | null;
  kind: string | null;
  closed_form: string | null;
  source: "catalogue" | "uploaded";
  format: "urdf" | "dh";
  default_chain: ChainEnds;
};

export type RunningMotion = { trajectory: Motion; time: number };

export type Scene = { objects: SceneObject[] };

export type SceneBox = { type: "box"; size: number[] };

export type SceneCylinder = { type: "cylinder" | "capsule"; radius: number; length: number };

export type SceneFile = { name: string; size: number };

export type SceneHalfSpace = { type: "half_space"; normal: number[]; offset?: number };

export type SceneHeightMap = { type: "height_map"; heights: number[][]; size: number[]; base?: number | null };

export type SceneInfo = { name: string; objects: SceneObject[]; files: SceneFile[] };

export type SceneList = { scenes: SceneSummary[] };

export type SceneMesh = { type: "mesh"; file: string };

export type SceneObject = {
  name: string;
  shape: SceneBox | SceneSphere | SceneCylinder | SceneHalfSpace | SceneMesh | ScenePoints | SceneHeightMap;
  pose?: Pose | null;
  attached_to?: string | null;
  touch_links?: string[];
  clearance?: number;
};

export type ScenePoints = { type: "points"; points?: number[][] | null; file?: string | null; radius: number };

export type SceneSphere = { type: "sphere"; radius: number };

export type SceneSummary = { name: string; objects: number; size: number };

export type SegmentBlend = { radius: number; start_time: number; end_time: number; acceleration: number | null };

export type SegmentInfo = { start_time: number; end_time: number; coefficients: number[][] };

export type SingularCondition = {
  kind: "solved" | "equation" | "never";
  condition: Formula;
  solutions: SingularValue[];
  example: number[] | null;
  example_singular_value: number | null;
};

export type SingularPathInfo = { places: SingularPlaceInfo[]; omitted: number };

export type SingularPlaceInfo = {
  segment: number;
  fraction: number;
  end: number;
  joint_positions: number[];
  report: SingularityInfo;
};

export type SingularValue = { joints: string[]; signs: number[]; variable: Formula; formula: Formula; value: number };

export type SingularityAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  reference: "local_world_aligned" | "local" | "world";
  task: ("x" | "y" | "z" | "rx" | "ry" | "rz")[];
  rank_tolerance: number;
  characteristic_length: number | null;
  units_mixed: boolean;
  singularities: SingularityEntry[];
  path?: SingularPathInfo | null;
  steps?: Step[][] | null;
  certificate: SingularityCertificate;
};

export type SingularityCertificate = {
  samples: number;
  max_error: number;
  max_time_variation_error: number | null;
  seed: number;
  max_internal_motion: number;
  max_lost_direction: number;
};

export type SingularityEntry = {
  singular: boolean;
  rank: number;
  structural_rank: number;
  rank_tolerance: number;
  singular_values: number[];
  smallest_singular_value: number | null;
  lost_directions: LostDirectionInfo[];
  internal_motions: InternalMotionInfo[];
  dependent_joints: string[];
  kinds: ("wrist" | "elbow" | "shoulder")[];
  exit: ExitInfo | null;
  nearest?: NearestSingularityInfo | null;
  nearest_reason?: string | null;
};

export type SingularityInfo = {
  singular: boolean;
  rank: number;
  structural_rank: number;
  rank_tolerance: number;
  singular_values: number[];
  smallest_singular_value: number | null;
  lost_directions: LostDirectionInfo[];
  internal_motions: InternalMotionInfo[];
  dependent_joints: string[];
  kinds: ("wrist" | "elbow" | "shoulder")[];
  exit: ExitInfo | null;
};

export type SmallestSingularValue = { value: number; time: number };

export type SolutionInfo = {
  joint_positions: number[];
  position_error: number;
  orientation_error: number;
  method: string;
  iterations: number;
  restarts: number;
  branch: Record<string, string | number> | null;
  free_joints?: string[] | null;
  elbow_angle?: number | null;
  in_collision?: boolean | null;
  clearance?: number | null;
  pair?: ContactPair | null;
};

export type SpaceInfo = {
  part: "translation" | "rotation" | "combined";
  dimension: number;
  basis: number[][];
  velocity_unit: string;
  force_unit: string;
  measure_unit: string;
};

export type SpacesInfo = {
  base_frame: string;
  tip_frame: string;
  configuration_dimension: number;
  workspace_dimension: number;
  tasks: TaskKind[];
};

export type SphereCover = { spheres: number[][]; excess: number | null; protrusion: number };

export type SplineAnswer = {
  duration: number;
  switching_times: number[];
  segments: SegmentInfo[];
  peaks: PeaksInfo;
  times: number[];
  joint_positions: number[][];
  joint_velocities: number[][];
  joint_accelerations: number[][];
  joint_jerks: number[][];
  certificate: MotionCertificate;
  boundary: "clamped" | "natural" | "not_a_knot" | "periodic" | "assigned";
  system: SystemInfo | null;
  knots: KnotInfo[];
  steps: Step[];
  warnings: string[];
};

export type SplineRequest = {
  language?: "en" | "de";
  samples?: number;
  sample_times?: number[] | null;
  limits?: MotionLimits | null;
  times: number[];
  waypoints: (number | number[])[];
  boundary?: "clamped" | "natural" | "not_a_knot" | "periodic" | "assigned";
  start_velocity?: number | number[] | null;
  end_velocity?: number | number[] | null;
  start_acceleration?: number | number[] | null;
  end_acceleration?: number | number[] | null;
  fictitious_times?: number[] | null;
};

export type SplineSegment = {
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
  law?: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal" | null;
  duration?: number | null;
  type: "spline";
  waypoints: (number[] | JointValues | Pose)[];
  times?: number[] | null;
  waypoint_options?: (MotionOptions | null)[] | null;
  boundary?: "clamped" | "natural" | "not_a_knot" | "periodic" | "assigned";
  blends?: boolean;
  orientation?: "axis_angle" | "zyz" | "zyz_other";
};

export type Step = { title: string; text: string; latex: string[]; plain: string[] };

export type StepResponseInfo = { times: number[]; currents: number[]; angular_velocities: number[] };

export type SymbolEntry = {
  latex: string;
  plain: string;
  meaning_latex: string;
  meaning: string;
  value: number | null;
};

export type SystemInfo = {
  matrix: number[][] | null;
  lower: number[];
  diagonal: number[];
  upper: number[];
  right_side: number[][];
  unknowns: number[];
};

export type TableCertificate = {
  samples: number;
  max_position_error: number;
  max_orientation_error: number;
  seed: number;
};

export type TaskKind = {
  task: "xy" | "xy_phi" | "xyz" | "pose";
  dimension: number;
  rank: number;
  redundancy: number;
  solutions: "none" | "finite" | "infinite";
};

export type TimeLawAnswer = {
  duration: number;
  switching_times: number[];
  segments: SegmentInfo[];
  peaks: PeaksInfo;
  times: number[];
  joint_positions: number[][];
  joint_velocities: number[][];
  joint_accelerations: number[][];
  joint_jerks: number[][];
  certificate: MotionCertificate;
  law: "cubic" | "quintic" | "septic" | "4-3-4" | "trapezoidal" | "parabolic_blends";
  normalised: (number[] | null)[] | null;
  profiles: ProfileInfo[] | null;
  blends: BlendsInfo | null;
  steps: Step[];
  warnings: string[];
};

export type TimeLawRequest = {
  language?: "en" | "de";
  samples?: number;
  sample_times?: number[] | null;
  limits?: MotionLimits | null;
  law: "cubic" | "quintic" | "septic" | "4-3-4" | "trapezoidal" | "parabolic_blends";
  start?: number | number[] | null;
  target?: number | number[] | null;
  start_velocity?: number | number[] | null;
  end_velocity?: number | number[] | null;
  start_acceleration?: number | number[] | null;
  end_acceleration?: number | number[] | null;
  start_jerk?: number | number[] | null;
  end_jerk?: number | number[] | null;
  duration?: number | null;
  waypoints?: (number | number[])[] | null;
  times?: number[] | null;
  blend_time?: number | number[] | null;
  may_reverse?: boolean;
};

export type TimingComparison = {
  segments: number[];
  law: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal";
  uniform_duration: number;
  velocity_factor: number;
  acceleration_factor: number;
  time_optimal_duration: number;
};

export type TipPeaks = { speed: Peak; angular_speed: Peak; acceleration: Peak; angular_acceleration: Peak };

export type ToUrdfAnswer = {
  urdf: string;
  joint_names: string[];
  certificate: TableCertificate;
  notes: string[];
  warnings: string[];
};

export type ToolChoice = {
  joint_travel: number;
  turns: number[];
  branches: Record<string, string | number>[];
  joint_positions: number[][];
};

export type ToolPath = { poses: Pose[]; free: ("rx" | "ry" | "rz")[]; steps?: number };

export type TorqueSpeedLine = {
  no_load_angular_velocity: number;
  no_load_current: number;
  stall_torque: number;
  stall_current: number;
  slope: number;
  most_power: number;
};

export type TrajectoryAnswer = {
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  duration: number;
  completed_fraction: number;
  failure: PlanningFailure | null;
  times: number[];
  joint_positions: number[][];
  joint_velocities: number[][];
  joint_accelerations: number[][];
  joint_torques?: number[][] | null;
  tip_poses: Pose[] | null;
  segments: TrajectorySegmentInfo[];
  audit: Audit;
  path?: ToolChoice | null;
  timing?: TimingComparison[] | null;
  limits: MotionLimitsInfo;
  limit_sources: LimitSourcesInfo;
  steps?: Step[] | null;
  notes: string[];
  certificate: PoseCertificate | null;
};

export type TrajectoryLimits = {
  joint_velocity?: number | number[] | Record<string, number> | null;
  joint_acceleration?: number | number[] | Record<string, number> | null;
  joint_jerk?: number | number[] | Record<string, number> | null;
  joint_torque?: "effort" | number | number[] | Record<string, number> | null;
  tip_velocity?: number | null;
  tip_acceleration?: number | null;
  tip_angular_velocity?: number | null;
  tip_angular_acceleration?: number | null;
};

export type TrajectoryRequest = {
  scene?: string | Scene | null;
  min_clearance?: number | null;
  other_joints?: JointValues | null;
  language?: "en" | "de";
  steps?: boolean;
  limits?: TrajectoryLimits | null;
  velocity_scale?: number | null;
  acceleration_scale?: number | null;
  base_frame?: string | null;
  tip_frame?: string | null;
  start?: Configuration | null;
  start_velocities?: Configuration | null;
  start_accelerations?: Configuration | null;
  end_velocities?: Configuration | null;
  end_accelerations?: Configuration | null;
  segments?: (JointSegment | LineSegment | CircleSegment | SplineSegment)[] | null;
  path?: ToolPath | null;
  payload?: CarriedLoad | null;
  gravity?: boolean | number[];
  law?: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal";
  law_fallback?: boolean;
  duration?: number | null;
  sample_period?: number;
  path_tolerance?: number;
  orientation_tolerance?: number;
  task?: ("x" | "y" | "z" | "rx" | "ry" | "rz")[] | null;
  near_singularity?: "stop" | "damp" | "slow_down";
  min_singular_value?: number;
  compare_timing?: boolean;
  coefficients?: boolean;
  tip_poses?: boolean;
  torques?: boolean;
  pose_format?:
    | "quaternion_xyzw"
    | "quaternion_wxyz"
    | "rpy"
    | "zyz"
    | "rotation_vector"
    | "rotation"
    | "matrix"
    | "ur"
    | "kuka_abc"
    | "abb"
    | "fanuc_wpr";
  at?: RunningMotion | null;
};

export type TrajectorySegmentInfo = {
  index: number;
  type: "joint" | "line" | "circle" | "spline";
  law: "cubic" | "quintic" | "septic" | "trapezoidal" | "jerk_limited" | "time_optimal";
  start_time: number;
  end_time: number;
  length: number | null;
  angle: number | null;
  blended: boolean;
  blend: SegmentBlend | null;
  joint_deviation: Damping | null;
  limits: MotionLimitsInfo;
  notes: string[];
  polynomials?: PolynomialsInfo | null;
};

export type Transmission = {
  direction: number[];
  velocity: number | null;
  force: number | null;
  force_unbounded: boolean;
};

export type TriangleAnswer = {
  case: "SSS" | "SAS" | "SSA" | "ASA" | "AAS";
  triangles: TriangleInfo[];
  steps: Step[];
  warnings: string[];
  certificate: TriangleCheck;
};

export type TriangleCheck = { max_side_error: number; max_angle_error: number };

export type TriangleInfo = {
  a: number;
  b: number;
  c: number;
  alpha: number;
  beta: number;
  gamma: number;
  area: number;
  corners: number[][];
};

export type TriangleRequest = {
  language?: "en" | "de";
  a?: number | null;
  b?: number | null;
  c?: number | null;
  alpha?: number | null;
  beta?: number | null;
  gamma?: number | null;
};

export type Unverified = {
  row: number;
  joint: string;
  parameter: "a" | "alpha" | "d" | "theta";
  absorbed_by: "base" | "tool" | "offsets";
};

export type Validation = {
  orthogonality_error: number;
  determinant: number;
  distance: number;
  is_reflection: boolean;
  is_unique: boolean;
  projected: boolean;
};

export type VelocityLimit = { direction: number[]; alone: number; component: number };

export type VelocityPolytope = { along: VelocityLimit[]; vertices: number[][] | null };

export type VoxelsInfo = {
  size: number;
  dimensions: number;
  origin: number[];
  axes: number[][];
  count: number;
  inner_count: number;
  volume: number;
  inner_volume: number;
  volume_bounds: number[];
  late_share: number | null;
};

export type WorkspaceAnswer = {
  robot: string;
  robot_digest?: string | null;
  joint_names: string[];
  base_frame: string;
  tip_frame: string;
  kind: "cloud" | "grid" | "dexterity";
  samples: number;
  samples_free?: number | null;
  samples_counted: number;
  plane: PlaneInfo | null;
  sequence: "random" | "low_discrepancy";
  random_seed: number;
  joint_ranges: number[][];
  bounding_box: BoxInfo | null;
  reach: ReachInfo | null;
  voxels: VoxelsInfo;
  measure: MeasureInfo;
  dexterity: DexterityInfo | null;
  array: ArrayInfo;
  notes: string[];
  certificate: WorkspaceCertificate;
  contact_certificate?: ContactCertificate | null;
};

export type WorkspaceCertificate = {
  samples: number;
  max_position_error: number;
  max_orientation_error: number;
  seed: number;
  max_jacobian_error: number;
  max_measure_error: number;
};
