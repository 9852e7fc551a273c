"""Motions of joints through configurations.

- `motion`: from point to point by any law. `splines`, `via_blends`: through or past `waypoints`, by
  `parabolic_blends`.
- `excess` finds where a motion leaves the joint limits.
"""
