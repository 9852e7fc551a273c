/** The motion that is being built, of the chain on the screen: read and changed in one place. */

import { shownChain, type ShownChain } from "../../robot/chain.ts";
import type { State } from "../../state.ts";
import type { Store } from "../../store.ts";
import type { Units } from "../../ui/quantity.ts";
import { moved } from "./configurations.ts";
import { belongs, defined, fresh, type Limits, type Motion, type Segment } from "./motion.ts";

/** Motions of other chains, to come back to. */
const LEFT = new Map<string, Motion>();

export class Draft {
  constructor(readonly store: Store<State>) {}

  /** Only while the robot is on the screen, as it is while the panel is open. */
  get chain(): ShownChain {
    return shownChain(this.store.value)!;
  }

  get motion(): Motion {
    const { motion } = this.store.value;
    return belongs(motion, this.chain) ? motion : fresh(this.chain);
  }

  get units(): Units {
    return this.store.value;
  }

  /** Unless there is a motion of this chain already: go on with the one that was left, or begin where the robot is. */
  begin(): void {
    const { motion } = this.store.value;
    if (belongs(motion, this.chain)) return;
    if (motion) LEFT.set(keyOf(motion), motion);
    const own = fresh(this.chain);
    const left = LEFT.get(keyOf(own)) ?? null;
    this.store.set({ motion: belongs(left, this.chain) ? left : own });
  }

  /** Move the robot to a configuration of the chain. */
  goTo(configuration: readonly number[]): void {
    this.store.set({ positions: moved(this.chain, this.chain.positions, configuration) });
  }

  /** Change some fields; undefined takes one out. */
  set(patch: { [K in keyof Motion]?: Motion[K] | undefined }): void {
    this.store.set({ motion: defined<Motion>({ ...this.motion, ...patch }) });
  }

  /** Change some limits of the whole motion likewise. */
  limit(patch: { [K in keyof Limits]?: Limits[K] | undefined }): void {
    const limits = defined<Limits>({ ...this.motion.limits, ...patch });
    this.set({ limits: Object.keys(limits).length ? limits : undefined });
  }

  edit(index: number, change: (segment: Segment) => Segment): void {
    const segments = this.motion.segments.map((segment, i) => (i === index ? defined(change(segment)) : segment));
    this.set({ segments });
  }
}

function keyOf({ robot, base_frame, tip_frame }: Motion): string {
  return JSON.stringify([robot, base_frame, tip_frame]);
}
