"""What a robot does: NumPy, numba and Pinocchio; no HTTP, no settings.

- `lanes`: eight numbers side by side in a register, as a type for compiled functions.
- `kernels`: compiled batches of poses, Jacobians and Hessians on flat arrays; never Pinocchio.
- `forward`: poses of tips and frames.
- `jacobian`: Jacobians in every reference and representation, with derivatives.
- `subspaces`: range and kernel of a Jacobian and of its transpose; `task_space`: the rows of it that a task counts.
- `velocity`: twist, acceleration, jerk and snap of the tip; `certify_motion`: the same through Pinocchio.
- `inverse_velocity`: joint rates behind those, on `linear_inverse`: exact, pseudo- and damped inverses.
  `words` names these and what is reported, without what computes it.
- `singularity`: what is lost where, and which joints make it so; `singularity_kinds` names it, `singularity_distance`
  finds the nearest, `singularity_path` those between the configurations of a path.
  `certify_singularity` asks Pinocchio's Jacobian about all of them.
- `manipulability`: ellipsoids and measures; `polytope` and `limited_motion`: the same within the limits of the joints.
- `wrenches`, `statics`: torques at rest. `dynamics`: equations of motion, on `mechanism` (Pinocchio's algorithms, for
  the variables of a chain) and judged by `lagrangian` on `bodies` (sums over bodies from our own Jacobians).
- `workspace`: where a tip gets to, by a million samples; `sampling`, `tip_motion`, `voxels`, `survey`
  and `dexterity` are its parts.
- `ik`: from poses to configurations, or to the reason why there is none.
- `dh_of_chain`: the DH table of a chain, nearly parallel axes taken as parallel where that costs little.
- `compare`: does a DH table describe a chain, and if not, where is it wrong; `comparison` holds its parts.
- `derive`: the worked solution of a DH table, in symbols and in numbers.
- `certify`: the same numbers through Pinocchio, and how far the two are apart.
- `warm`: all of it once, so that no request waits for a compiler.
- `configuration`: configurations as callers give them → one array in the chain's order.
"""
