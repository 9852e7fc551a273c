/** Whether the picture is right: the browser's pose beside the service's, which Pinocchio has recomputed. */

import type { Matrix4 } from "three";

import { type Api, asProblem, Latest, Paced } from "../../api.ts";
import type { ShownChain } from "../../robot/chain.ts";
import type { RobotModel } from "../../robot/model.ts";
import { asMatrix, difference } from "../../robot/pose.ts";
import { t } from "../../texts/index.ts";
import type { ForwardAnswer } from "../../types.ts";
import { element } from "../../ui/dom.ts";
import type { ProblemView } from "../../ui/problem.ts";
import { inUnit, type Kind, scientific, type Units, withUnit } from "../../ui/quantity.ts";

/** Rounding of a long chain in doubles stays far below; anything above is an error of one of the two. */
const TOLERANCE = 1e-9;

export class Agreement {
  readonly host = element("p", { class: "agreement", role: "status" });
  #latest = new Latest();
  #model: RobotModel | null = null;
  #paced = new Paced<{ chain: ShownChain; T: Matrix4 }>(({ chain, T }) => this.#ask(chain, T));

  constructor(
    private readonly api: Api,
    private readonly units: () => Units,
    private readonly problem: ProblemView,
  ) {}

  stop(): void {
    this.#paced.cancel();
    this.#latest.cancel();
  }

  /** Ask the service for the same pose, and say how far the two are apart. */
  check(chain: ShownChain, T: Matrix4): void {
    if (chain.path === null) {
      this.stop();
      this.#say("idle", t("Add the table to the robots (Robot, DH table) to compare this with the service."));
      return;
    }
    if (chain.model !== this.#model) this.#latest.cancel();
    this.#model = chain.model;
    this.#paced.want({ chain, T });
  }

  async #ask(chain: ShownChain, T: Matrix4): Promise<void> {
    const call = { joint_positions: [chain.configuration], ...chain.ends, pose_format: "matrix" };
    try {
      const path = `${chain.path}/fk`;
      const answer = await this.#latest.run((signal) => this.api.post<ForwardAnswer>(path, call, signal));
      if (!answer) return;
      this.problem.show(null);
      this.#compare(
        T,
        answer,
        chain.joints.map((joint) => joint.name),
      );
    } catch (error) {
      this.#say("idle", "");
      this.problem.show(asProblem(error));
    }
  }

  #compare(T: Matrix4, answer: ForwardAnswer, names: string[]): void {
    const apart = difference(T, asMatrix(answer.poses[0]));
    const isOrdered = names.join() === answer.joint_names.join();
    const agrees = isOrdered && apart.position < TOLERANCE && apart.angle < TOLERANCE;
    const length = (value: number) => small(value, "length", this.units());
    this.host.dataset["position"] = String(apart.position);
    this.host.dataset["angle"] = String(apart.angle);
    this.#say(
      agrees ? "good" : "bad",
      (agrees ? t("Browser and service agree: ") : t("Browser and service differ: ")) +
        t("{position}, {angle} apart. ", {
          position: length(apart.position),
          angle: small(apart.angle, "angle", this.units()),
        }) +
        t("Service and Pinocchio: {max_position_error}.", {
          max_position_error: length(answer.certificate.max_position_error),
        }),
    );
  }

  #say(tone: "good" | "bad" | "idle", text: string): void {
    this.host.dataset["tone"] = tone;
    this.host.textContent = text;
  }
}

function small(value: number, kind: Kind, units: Units): string {
  return withUnit(scientific(inUnit(value, kind, units)), kind, units);
}
