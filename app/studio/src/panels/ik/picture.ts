/** The target and the answers in the picture: solutions as ghosts, what comes nearest as one of another colour. */

import { Group } from "three";

import { type ShownChain, shownChain } from "../../robot/chain.ts";
import { asMatrix } from "../../robot/pose.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import { jointHue } from "../../view/colours.ts";
import { Ghost } from "../../view/ghosts.ts";
import { clear, put, triad } from "../../view/shapes.ts";
import type { View } from "../../view/view.ts";
import { distance } from "./distance.ts";
import { moved, type Outcome } from "./solver.ts";

/** Ghosts at a time: more of them hide one another, and the picture slows down. */
export const MOST_GHOSTS = 8;
const MOST_SWEPT = 16;

const USUAL = 0.24;
const POINTED = 0.7;
const FAINT = 0.1;
const NEAREST = 0.5;
/** From here on a ghost would flicker inside of the robot. */
const SAME = 1e-3;

export class Picture {
  #group = new Group();
  #target = new Group();
  #ghosts = new Map<number, Ghost>();
  #nearest: Ghost | null = null;
  #sweep: Ghost[] = [];
  #stops: (() => void)[];

  constructor(
    private readonly view: View,
    private readonly store: Store<State>,
    private readonly outcome: Store<Outcome>,
  ) {
    view.scene.add(this.#group, this.#target);
    this.#stops = [
      store.watch(["unit", "dark"], ({ unit }) => {
        clear(this.#target);
        this.#target.add(triad(unit * 0.8));
      }),
      store.watch(["model", "base", "tip", "target", "positions", "unit", "dark"], (state) => this.#placeTarget(state)),
      store.watch(["model", "meshes", "dark"], () => this.#draw()),
      outcome.watch(["result", "isFollowing", "isWalking"], () => this.#draw()),
      outcome.watch(["pointed"], () => this.#paint()),
      outcome.watch(["swept"], () => this.#sweepOut()),
      store.watch(["positions"], () => this.#paint()),
    ];
  }

  close(): void {
    for (const stop of this.#stops) stop();
    this.#clear();
    clear(this.#target);
    this.view.scene.remove(this.#group, this.#target);
    this.view.draw();
  }

  #placeTarget(state: Readonly<State>): void {
    const chain = shownChain(state);
    this.#target.visible = chain !== null && state.target !== null;
    if (chain && state.target)
      put(this.#target, chain.model.link(chain.base).matrixWorld.clone().multiply(asMatrix(state.target)));
    this.view.draw();
  }

  #draw(): void {
    this.#clear();
    const { result, isFollowing, isWalking } = this.outcome.value;
    const chain = this.#chain();
    if (chain && result && !isWalking) {
      if (!isFollowing) for (const i of result.solutions.slice(0, MOST_GHOSTS).keys()) this.#add(chain, i);
      if (result.nearest) {
        this.#nearest = new Ghost(chain.model, chain.joints, "bad", NEAREST, "nearest");
        this.#nearest.group.name = "nearest";
        this.#place(this.#nearest, result.nearest.joint_positions);
      }
    }
    this.#paint();
  }

  /** The chain that the answer is of; null where another robot is on the screen by now. */
  #chain(): ShownChain | null {
    const chain = shownChain(this.store.value);
    const names = this.outcome.value.answer?.joint_names.join();
    return chain && chain.joints.map((joint) => joint.name).join() === names ? chain : null;
  }

  #add(chain: ShownChain, index: number): void {
    const ghost = new Ghost(chain.model, chain.joints, jointHue(index), USUAL, String(index + 1));
    ghost.group.name = `ghost ${index}`;
    this.#ghosts.set(index, ghost);
    this.#place(ghost, this.outcome.value.result!.solutions[index]!.joint_positions);
  }

  #place(ghost: Ghost, values: readonly number[]): void {
    const { positions } = this.store.value;
    ghost.place(moved(this.store.value, this.outcome.value.answer!.joint_names, values), positions);
    this.#group.add(ghost.group, ghost.label);
  }

  /** The family that is pointed at, as ghosts all along it, in the place of those of the solutions. */
  #sweepOut(): void {
    for (const ghost of this.#sweep) ghost.remove();
    this.#sweep = [];
    const { swept, result } = this.outcome.value;
    const chain = this.#chain();
    const sweep = swept === null || !chain ? [] : (result?.families?.[swept]?.sweep ?? []);
    const every = Math.max(1, sweep.length / MOST_SWEPT);
    for (let i = 0; chain && Math.floor(i) < sweep.length; i += every) {
      const ghost = new Ghost(chain.model, chain.joints, "accent", USUAL);
      ghost.group.name = `sweep ${this.#sweep.length}`;
      this.#sweep.push(ghost);
      this.#place(ghost, sweep[Math.floor(i)]!);
    }
    this.#paint();
  }

  /** Bring out the one that is pointed at; hide those that are where the robot is. */
  #paint(): void {
    const { pointed, result, isFollowing, isWalking } = this.outcome.value;
    const chain = this.#chain();
    if (chain && result) {
      if (pointed !== null && result.solutions[pointed] && !this.#ghosts.has(pointed)) this.#add(chain, pointed);
      const isShown = !isFollowing && !isWalking && !this.#sweep.length;
      for (const [index, ghost] of this.#ghosts) {
        const isPointed = index === pointed;
        ghost.paint(
          result.solutions[index]!.in_collision ? "bad" : jointHue(index),
          isPointed ? POINTED : pointed === null ? USUAL : FAINT,
        );
        const isHere = distance(chain, result.solutions[index]!.joint_positions) < SAME;
        ghost.show(!isHere && (isPointed || (isShown && index < MOST_GHOSTS)));
      }
      if (this.#nearest && result.nearest) this.#nearest.show(distance(chain, result.nearest.joint_positions) > SAME);
    }
    this.view.draw();
  }

  #clear(): void {
    for (const ghost of this.#ghosts.values()) ghost.remove();
    this.#ghosts.clear();
    this.#nearest?.remove();
    this.#nearest = null;
    for (const ghost of this.#sweep) ghost.remove();
    this.#sweep = [];
  }
}
