"""Velocities: the Jacobian, its singularities and inverses, and what follows from it by differentiating.

- `planar`: planar arms, their inverse, damped inverse and pseudo-inverse. `columns`: arms in space, and where they are
  singular. `motion`: an exam, from velocity to jerk.
"""
