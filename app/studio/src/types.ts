/** Names for what travels over the public API; `schema.ts`, which is made from its document, says what is in it. */

import type * as api from "./schema.ts";

export type ChainEnds = api.ChainEnds;
export type CollisionAnswer = api.CollisionAnswer;
export type CollisionBodies = api.CollisionBodies;
export type CollisionBody = api.CollisionBody;
export type CollisionResult = CollisionAnswer["results"][number];
export type CompareAnswer = api.CompareAnswer;
export type CoursePictures = api.CoursePictures;
export type DeriveAnswer = api.DeriveAnswer;
export type ExerciseGrade = api.ExerciseGrade;
export type ExerciseList = api.ExerciseList;
export type ExerciseSolution = api.ExerciseSolution;
export type ExerciseVariant = api.ExerciseVariant;
export type ForwardAnswer = api.ForwardAnswer;
export type InverseAnswer = api.InverseAnswer;
export type JacobianAnswer = api.JacobianAnswer;
export type JobInfo = api.JobInfo;
export type JointInfo = Omit<api.JointInfo, "origin" | "axis">;
export type LinkShape = api.LinkShape;
export type ManipulabilityAnswer = api.ManipulabilityAnswer;
export type Pose = api.Pose;
export type RobotInfo = api.RobotInfo;
export type RobotSummary = api.RobotSummary;
export type Scene = api.Scene;
export type SceneInfo = api.SceneInfo;
export type SceneList = api.SceneList;
export type SceneObject = api.SceneObject;
export type SingularityAnswer = api.SingularityAnswer;
export type ToUrdfAnswer = api.ToUrdfAnswer;

/** The notations that the studio shows; those of pendants are for calls. */
export type PoseFormat = Exclude<
  NonNullable<api.ForwardRequest["pose_format"]>,
  "ur" | "kuka_abc" | "abb" | "fanuc_wpr"
>;

export type DhTable = api.DhTablePayload;
export type DhRow = DhTable["joints"][number];
export type Convention = DhTable["convention"];
export type TableAnswer = api.FromUrdfAnswer;

export const DIRECTIONS = ["x", "y", "z", "rx", "ry", "rz"] as const satisfies api.InverseAnswer["task"];
export type Direction = (typeof DIRECTIONS)[number];

/** Fields of a call of `ik`, beside the targets, the seeds and the chain. */
export type InverseOptions = Omit<api.InverseRequest, "targets" | "seeds" | "base_frame" | "tip_frame">;
export type InverseMethod = NonNullable<InverseOptions["method"]>;
export type InverseResult = api.InverseAnswer["results"][number];
export type InverseSolution = InverseResult["solutions"][number];
export type Errors = Pick<InverseSolution, "position_error" | "orientation_error">;
export type SolutionFamily = NonNullable<InverseResult["families"]>[number];
export type Iteration = NonNullable<InverseResult["trace"]>[number];

export type Reference = api.JacobianAnswer["reference"];
export type Representation = api.JacobianAnswer["representation"];

export type Part = api.ManipulabilityAnswer["spaces"][number]["part"];
export type PartAnswer = NonNullable<api.ManipulabilityAnswer["results"][number][Part]>;
export type Ellipsoid = PartAnswer["velocity_ellipsoid"];

export type SingularityReport = api.SingularityAnswer["singularities"][number];
export type NearestSingularity = NonNullable<SingularityReport["nearest"]>;

/** A formula of a worked solution; null where it has too many terms to be written out. */
export type MatrixFormula = Pick<api.DeriveAnswer["A"][number], "name" | "latex">;
export type ColumnFormulas = NonNullable<api.DeriveAnswer["jacobian"]>["columns"][number];
/** The numbers of a worked solution at a configuration; transforms and the Jacobian row by row. */
export type SolutionNumbers = Pick<
  api.DeriveAnswer["numeric"][number],
  "A" | "T_0" | "T_base_tool" | "columns" | "jacobian" | "determinant"
>;

export type WorkspaceSummary = api.WorkspaceAnswer;

export type TrajectoryAnswer = api.TrajectoryAnswer;
export type TrajectoryRequest = api.TrajectoryRequest;

export type Language = NonNullable<api.ExerciseRequest["language"]>;
export type ExerciseInfo = api.ExerciseInfo;
export type ExerciseField = api.ExerciseField;
export type FieldGrade = api.ExerciseFieldGrade;

export type TimeLawRequest = api.TimeLawRequest;
export type TimeLawAnswer = api.TimeLawAnswer;
export type SplineRequest = api.SplineRequest;
export type SplineAnswer = api.SplineAnswer;
export type FlyOverRequest = api.FlyOverRequest;
export type FlyOverAnswer = api.FlyOverAnswer;
export type OrientationRequest = api.OrientationRequest;
export type OrientationAnswer = api.OrientationAnswer;
export type TriangleRequest = api.TriangleRequest;
export type TriangleAnswer = api.TriangleAnswer;
export type MobilityRequest = api.MobilityRequest;
export type MobilityAnswer = api.MobilityAnswer;
export type EncoderRequest = api.EncoderRequest;
export type EncoderAnswer = api.EncoderAnswer;
export type DcMotorRequest = api.DcMotorRequest;
export type DcMotorAnswer = api.DcMotorAnswer;
