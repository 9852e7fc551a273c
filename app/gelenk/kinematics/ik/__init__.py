"""Inverse kinematics: from a tip pose to joint configurations, or to the reason why none exists.

- `words`: names of options and results, free of the code that computes them.
- `task`: the pose directions that count, and the errors in them.
- `iteration`, `kernels`: damped least squares from many starts, eight at a time, without Pinocchio.
- `search`: those kernels on a batch, in threads, within limits; `retrace` repeats a start step by step for its trace.
- `steps`, `linearise`, `descent`: the course's methods from one start, with a trace.
- `closed_form`: choice of a composition of `subproblems` for a chain; `compositions` and `branch_kernels` compute all
  branches, `elimination` those of six revolute joints without a closed form; `analytic` combines them, and `valleys`
  finds solutions next to a singularity that rounding hides.
- `continuation`: all solutions of any six joints, proved by their number; `homotopy` tracks them in complex numbers.
- `branches`: all distinct solutions by search; `null_space`: use of a redundant arm's freedom.
- `families`: infinitely many solutions, described by the joints that move and the relations between them.
- `reach`, `verdict`: why a target is unsolved; `nearest`: the closest configuration. `result`: the answer's fields.
- `fixed`: the chain that remains when joints are held.
- `solve`: inverse kinematics of a robot from all of these, each solution recomputed with Pinocchio.
"""
