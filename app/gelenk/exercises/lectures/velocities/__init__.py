"""Velocities: the Jacobian, its singularities and inverses, and what follows from it by differentiating.

- `two_links`: the planar arm, its inverse, its damped inverse. `columns`: arms in space, and where they are singular.
- `redundant`: the pseudo-inverse. `motion`: an exam, from velocity to jerk.
"""
