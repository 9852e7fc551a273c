"""Compiled batches of poses, Jacobians and Hessians on flat arrays.

- `lanes`: a numba type that holds eight numbers in one vector register.
- `plain`: the kernels as plain Python, for a process that computes a few numbers and ends.
- `kernels`: the batches. `vectors`: products of small vectors for compiled code.
- `block`: many arrays as two arguments of a compiled function.
"""
