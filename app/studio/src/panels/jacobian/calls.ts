/** What the service says of one configuration: the matrix, the ellipsoids, and what is singular. */

import { type Api, Problem } from "../../api.ts";
import type { ShownChain } from "../../robot/chain.ts";
import type { JacobianAnswer, ManipulabilityAnswer, SingularityAnswer, SingularityReport } from "../../types.ts";
import { FORMS, type Form, type PartChoice } from "./choices.ts";

/** What makes metres of radians where both count, [m]. */
export const LENGTH = 1;

/** Where each call goes through, so that it is shown as a request. */
export interface Apis {
  matrix: Api;
  axes: Api;
  singularity: Api;
  /** For what the panel asks besides. */
  other: Api;
}

export interface Answers {
  chain: ShownChain;
  form: Form;
  part: PartChoice;
  /** Or why there is none: an analytic one degenerates where its angles do. */
  matrix: JacobianAnswer | Problem;
  /** Columns of the geometric Jacobian of the tip along the base's axes. */
  columns: number[][];
  axes: ManipulabilityAnswer;
  report: SingularityReport;
}

export async function ask(
  apis: Apis,
  chain: ShownChain,
  form: Form,
  part: PartChoice,
  signal: AbortSignal,
): Promise<Answers> {
  const call = { joint_positions: [chain.configuration], ...chain.ends };
  const jacobian = (api: Api, { reference, representation }: Form) =>
    api.post<JacobianAnswer>(`${chain.path}/jacobian`, { ...call, reference, representation }, signal);
  const combined = part.value === "combined" ? { characteristic_length: LENGTH } : {};
  const [matrix, plain, axes, singularity] = await Promise.all([
    jacobian(apis.matrix, form).catch(asAnswer),
    form === FORMS[0] ? null : jacobian(apis.other, FORMS[0]!),
    apis.axes.post<ManipulabilityAnswer>(`${chain.path}/manipulability`, { ...call, ...combined }, signal),
    apis.other.post<SingularityAnswer>(
      `${chain.path}/singularities`,
      { ...call, task: part.task, ...combined },
      signal,
    ),
  ]);
  const geometric = plain ?? (matrix instanceof Problem ? null : matrix);
  if (!geometric) throw matrix;
  return { chain, form, part, matrix, columns: columnsOf(geometric), axes, report: singularity.singularities[0]! };
}

/** The report again, with the nearest singularity. */
export async function askNearest(
  api: Api,
  chain: ShownChain,
  part: PartChoice,
  signal: AbortSignal,
): Promise<SingularityReport> {
  const call = {
    joint_positions: [chain.configuration],
    ...chain.ends,
    task: part.task,
    ...(part.value === "combined" ? { characteristic_length: LENGTH } : {}),
    nearest: true,
  };
  return (await api.post<SingularityAnswer>(`${chain.path}/singularities`, call, signal)).singularities[0]!;
}

function asAnswer(error: unknown): Problem {
  if (error instanceof Problem) return error;
  throw error;
}

function columnsOf({ jacobians, joint_names }: JacobianAnswer): number[][] {
  return joint_names.map((_, j) => jacobians[0]!.map((row) => row[j]!));
}
