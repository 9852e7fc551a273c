"""What a robot does: NumPy, numba and Pinocchio; no HTTP, no settings.

- `lanes`: eight numbers side by side in a register, as a type for compiled functions.
- `kernels`: compiled batches of poses, Jacobians and Hessians on flat arrays; never Pinocchio.
- `forward`: poses of tips and frames.
- `jacobian`: Jacobians in every reference and representation, with derivatives.
- `ik`: from poses to configurations, or to the reason why there is none.
- `compare`: does a DH table describe a chain, and if not, where is it wrong; `comparison` holds its parts.
- `derive`: the worked solution of a DH table, in symbols and in numbers.
- `certify`: the same numbers through Pinocchio, and how far the two are apart.
- `warm`: all of it once, so that nobody waits for a compiler.
- `configuration`: configurations as callers give them → one array in the chain's order.
"""
