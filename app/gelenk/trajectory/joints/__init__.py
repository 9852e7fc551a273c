"""Motions of joints through configurations.

- `motion`: from point to point by any law. `moving_ends`: with velocities and accelerations at its ends.
- `splines`, `via_blends`: through or past `waypoints`, by `parabolic_blends`. `ways`: the fastest, at once.
- `excess` finds where a motion leaves the joint limits.
"""
