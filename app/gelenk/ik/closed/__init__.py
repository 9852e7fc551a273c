"""Closed forms: every solution of a target at once.

- `closed_form`: choice of a chain of `subproblems` for an arm; `subproblem_chains` and `branch_kernels` compute all
  branches. `nearest_branch` computes that of one target at a time, as Python calls it.
- `elimination`: the branches of six revolute joints without a closed form.
"""
