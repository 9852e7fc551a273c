"""Kinematics and dynamics of robots with NumPy, numba and Pinocchio; independent of HTTP and settings.

- `simd`: compiled batches of poses, Jacobians and Hessians, without Pinocchio. `judge`: the same through Pinocchio,
  and the certificates.
- `poses`, `velocity`, `ellipsoids`, `force`, `singularity`, `dynamics`, `workspace`: a room for each subject.
- `warm_up`: one run of all kernels at start-up, so that no request waits for the compiler.
"""
