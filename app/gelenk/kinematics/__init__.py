"""Kinematics and dynamics of robots with NumPy, numba and Pinocchio; independent of HTTP and settings.

- `lanes`: a numba type for compiled functions that holds eight numbers in one vector register.
- `kernels`: compiled batches of poses, Jacobians and Hessians on flat arrays, without Pinocchio.
- `forward`: poses of tips and frames.
- `jacobian`: Jacobians in every reference frame and representation, with derivatives.
- `subspaces`: range and kernel of a Jacobian and of its transpose; `task_space`: the rows of J that a task selects.
- `velocity`: twist, acceleration, jerk and snap of the tip; `certify_motion`: the check of these through Pinocchio.
- `inverse_velocity`: joint rates for a given tip motion, by `linear_inverse`: exact, pseudo- and damped inverses.
  `words` holds the names of these inverses and of their outcomes, without the code that computes them.
- `singularity`: lost directions, and the joints that cause the loss; `singularity_kinds` names the singularity,
  `singularity_distance` finds the nearest one, `singularity_path` those along a path of configurations.
  `certify_singularity` checks the reports with Pinocchio's Jacobian.
- `manipulability`: ellipsoids and measures; `polytope` and `limited_motion`: the same within the joint limits.
- `wrenches`, `statics`: torques at rest. `dynamics`: equations of motion, by `mechanism` (Pinocchio's algorithms, for
  the variables of a chain), checked by `lagrangian` on `bodies` (sums over bodies from our own Jacobians).
- `workspace`: the positions that a tip reaches, from up to a million samples; `sampling`, `tip_motion`, `voxels`,
  `survey` and `dexterity` are its parts.
- `ik`: from poses to configurations, or to the reason why none exists.
- `dh_of_chain`: the DH table of a chain; nearly parallel axes become parallel where the error stays small.
- `compare`: whether a DH table describes a chain, and where it is wrong if not; `comparison` holds its parts.
- `derive`: the worked solution of a DH table, in symbols and in numbers.
- `certify`: recomputation of results through Pinocchio, and the differences.
- `warm`: one run of all kernels at start-up, so that no request waits for the compiler.
- `configuration`: configurations as callers give them → one array in the chain's order.
"""
