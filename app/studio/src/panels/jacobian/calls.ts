/** What the service says of one configuration: the matrix, the ellipsoids, and what is singular. */

import { type Api, Latest, Problem } from "../../api.ts";
import type { ShownChain } from "../../robot/chain.ts";
import type { JacobianAnswer, ManipulabilityAnswer, SingularityAnswer, SingularityReport } from "../../types.ts";
import { FORMS, type Form, type PartChoice } from "./choices.ts";

/** What makes metres of radians where both count, [m]. */
const LENGTH = 1;
/** The nearest singularity takes longer to find than a slider's next step: it is looked for after a rest, [ms]. */
const REST = 250;

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

async function ask(apis: Apis, chain: ShownChain, form: Form, part: PartChoice, signal: AbortSignal): Promise<Answers> {
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
async function askNearest(
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

/** What the one who asks is told. */
export interface Listener {
  answered(answers: Answers): void;
  /** The report with the nearest singularity; null while that is being looked for. */
  nearest(report: SingularityReport | null, chain: ShownChain): void;
  failed(error: unknown): void;
}

/** Asks about one configuration after the other: what is overtaken by the next one is dropped. */
export class Inquiry {
  #answers = new Latest();
  #nearest = new Latest();
  #rest = 0;

  constructor(
    private readonly apis: Apis,
    private readonly listener: Listener,
  ) {}

  about(chain: ShownChain, form: Form, part: PartChoice): void {
    this.stop();
    const { apis, listener } = this;
    this.#answers
      .run((signal) => ask(apis, chain, form, part, signal))
      .then((answers) => answers && listener.answered(answers))
      .catch((error: unknown) => listener.failed(error));
    listener.nearest(null, chain);
    this.#rest = window.setTimeout(() => {
      this.#nearest
        .run((signal) => askNearest(apis.singularity, chain, part, signal))
        .then((report) => report && listener.nearest(report, chain))
        .catch((error: unknown) => listener.failed(error));
    }, REST);
  }

  stop(): void {
    clearTimeout(this.#rest);
    this.#answers.cancel();
    this.#nearest.cancel();
  }
}

function asAnswer(error: unknown): Problem {
  if (error instanceof Problem) return error;
  throw error;
}

function columnsOf({ jacobians, joint_names }: JacobianAnswer): number[][] {
  return joint_names.map((_, j) => jacobians[0]!.map((row) => row[j]!));
}
