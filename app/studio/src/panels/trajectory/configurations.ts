/** The robot at another configuration than the one on the screen. */

import type { Matrix4 } from "three";

import type { ShownChain } from "../../robot/chain.ts";
import type { Positions } from "../../state.ts";

/** The positions of the whole robot with the chain's joints at a configuration, the others as they are. */
export function moved({ joints }: ShownChain, others: Positions, configuration: readonly number[]): Positions {
  const own = joints.map(({ name }, index) => [name, configuration[index]!]);
  return { ...others, ...(Object.fromEntries(own) as Positions) };
}

/** T_base_tip at each of some configurations; afterwards the scene is as before. */
export function posesAt(chain: ShownChain, configurations: readonly (readonly number[])[]): Matrix4[] {
  const { model, base, tip } = chain;
  const found = configurations.map((configuration) => {
    model.place(moved(chain, chain.positions, configuration));
    return model.pose(base, tip);
  });
  model.place(chain.positions);
  return found;
}

export function poseAt(chain: ShownChain, configuration: readonly number[]): Matrix4 {
  return posesAt(chain, [configuration])[0]!;
}
