/** Asks for the solutions of the target: all that were wanted, or the next one while the target is being moved. */

import { type Api, asProblem, Latest, type Problem } from "../../api.ts";
import { type ShownChain, shownChain } from "../../robot/chain.ts";
import { surroundings } from "../../scene/objects.ts";
import type { State } from "../../state.ts";
import { Store } from "../../store.ts";
import type { InverseAnswer, InverseResult, Pose } from "../../types.ts";
import { type FullOptions, fullOptions, inverseCall } from "./call.ts";

/** What the service has said, and how it stands with the next answer. */
export interface Outcome {
  /** Of the target and chain on the screen; null before the first answer, and where there is none. */
  answer: InverseAnswer | null;
  result: InverseResult | null;
  problem: Problem | null;
  isBusy: boolean;
  isCancelled: boolean;
  /** Whether the target is being moved, and the robot with it. */
  isFollowing: boolean;
  /** Whether the ways of the course's methods are in the picture, in the place of the solutions. */
  isWalking: boolean;
  /** The solution that the pointer or the focus is on. */
  pointed: number | null;
  /** The family of solutions likewise. */
  swept: number | null;
}

const NOTHING: Outcome = {
  answer: null,
  result: null,
  problem: null,
  isBusy: false,
  isCancelled: false,
  isFollowing: false,
  isWalking: false,
  pointed: null,
  swept: null,
};

export class Solver {
  readonly outcome = new Store<Outcome>(NOTHING);
  #latest = new Latest();
  #isChasing = false;
  /** Where the target has been moved to since the last call. */
  #moved: Pose | null = null;
  #isAtRest = false;
  #timer = 0;
  #followed: Pose | null = null;
  /** The answer that is being waited for while the target moves, until the robot has it. */
  #round: Promise<void> = Promise.resolve();

  constructor(
    private readonly api: Api,
    private readonly store: Store<State>,
  ) {}

  /** Whether the robot is being brought after this very target. */
  isAfter(target: Pose): boolean {
    return this.outcome.value.isFollowing && target === this.#followed;
  }

  /** Solve the target as wanted, from the posture on the screen. */
  async solve(): Promise<void> {
    this.#stop();
    this.outcome.set({ isFollowing: false });
    await this.#ask((options) => options);
  }

  /** Bring the robot after a target that is being moved, until `rest`; resolves when it has come one step nearer. */
  follow(target: Pose): Promise<void> {
    clearTimeout(this.#timer);
    this.outcome.set({ isFollowing: true });
    this.#moved = target;
    this.#isAtRest = false;
    this.#followed = target;
    // Asked first: while the service computes there is time to show the target.
    void this.#chase();
    this.store.set({ target });
    return this.#round;
  }

  /** The target stays where it is, or does if it is not moved for a while: solve it as wanted when the robot is there. */
  rest(after = 0): void {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => {
      this.#isAtRest = true;
      if (!this.#isChasing) void this.solve();
    }, after);
  }

  cancel(): void {
    this.#stop();
    this.#latest.cancel();
    this.outcome.set({ isBusy: false, isCancelled: true, isFollowing: false });
  }

  #stop(): void {
    clearTimeout(this.#timer);
    this.#moved = null;
    this.#isAtRest = false;
  }

  /** What was said was of another robot or chain. */
  forget(): void {
    this.cancel();
    this.outcome.set(NOTHING);
  }

  /** Call after call while the target moves: the next one begins when there is an answer, or none would ever arrive. */
  async #chase(): Promise<void> {
    if (this.#isChasing) return;
    this.#isChasing = true;
    while (this.#moved) {
      const target = this.#moved;
      this.#moved = null;
      this.#round = this.#ask((options) => ({ ...options, solutions: "one" }), target).then(() => this.#take());
      await this.#round;
    }
    this.#isChasing = false;
    if (this.#isAtRest) await this.solve();
  }

  #take(): void {
    const { answer, result, isFollowing } = this.outcome.value;
    const found = result?.solutions[0];
    if (isFollowing && answer && found)
      this.store.set({ positions: moved(this.store.value, answer.joint_names, found.joint_positions) });
  }

  async #ask(change: (options: FullOptions) => FullOptions, target = this.store.value.target): Promise<void> {
    const state = this.store.value;
    const chain = shownChain(state);
    if (!chain?.path || !target) return;
    const options = change(fullOptions(state.inverse, chain.joints.length));
    const call = { ...inverseCall(chain, target, options), ...surroundings(state.scene, chain.others) };
    const asked = this.#latest.run((signal) => this.#post(chain, call, signal));
    this.outcome.set({ isBusy: true, isCancelled: false });
    try {
      const answer = await asked;
      const found = { problem: null, isBusy: false, pointed: null, swept: null };
      if (answer) this.outcome.set({ answer, result: answer.results[0]!, ...found });
    } catch (error) {
      this.#stop();
      this.outcome.set({ ...NOTHING, problem: asProblem(error) });
    }
  }

  #post(chain: ShownChain, call: Record<string, unknown>, signal: AbortSignal): Promise<InverseAnswer> {
    return this.api.post<InverseAnswer>(`${chain.path}/ik`, call, signal);
  }
}

/** The positions with some joints at others. */
export function moved(state: Readonly<State>, names: readonly string[], values: readonly number[]): State["positions"] {
  return { ...state.positions, ...Object.fromEntries(names.map((name, i) => [name, values[i]!])) };
}
