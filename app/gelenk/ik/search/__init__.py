"""Inverse kinematics from a start configuration, without Pinocchio.

- `words`: names of options and results, free of the code that computes them.
- `task`: the pose directions that count, and the errors in them; `reach`: bounds on how far a chain extends.
- `iteration`, `kernels`: damped least squares from many starts, eight at a time.
- `search`: those kernels on a batch, in threads, within limits; `retrace` repeats a start step by step for its trace.
  `restarts`: many solutions of each target.
- `linearise`, `descent`: the course's methods from one start, with a trace.
- `null_space`: use of a redundant arm's freedom.
"""
