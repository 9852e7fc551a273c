"""Inverse kinematics: from a pose of the tip to configurations, or to the reason why there is none.

- `words`: what can be chosen and what is reported, by name, without what computes it.
- `task`: which directions of a pose count, and errors in them.
- `kernels`: many starts of damped least squares, eight at a time. No Pinocchio.
- `search`: those kernels on a batch, in threads, within limits; `retrace` tells what they did, step by step.
- `steps`, `linearise`, `descent`: the course's methods from one start, with a trace.
- `closed_form`: which composition of `subproblems` a chain is served by; `compositions` and `branch_kernels` find all
  branches, `elimination` those of six turning joints without one; `analytic` puts them together, and `valleys` finds
  what rounding hides next to a singularity.
- `continuation`: all solutions of any six joints, proved by their number; `homotopy` follows them in complex numbers.
- `branches`: every distinct solution by search; `null_space`: what to do with a redundant arm's freedom.
- `families`: where solutions are infinitely many, which joints move among them and how they are tied.
- `reach`, `verdict`: why a target is not solved; `nearest`: what comes nearest to it. `result`: what the answer holds.
- `fixed`: the chain that remains where joints are held.
- `solve`: all of it for a robot, each solution recomputed through Pinocchio.
"""
