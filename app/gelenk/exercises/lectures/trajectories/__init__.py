"""Trajectories: time laws, splines, lines and corners, orientations.

- `polynomials`: cubic and quintic. `profiles`: bang-coast-bang, of one joint and of two in step.
- `spline`: velocities at the knots. `corner`: a fly-over. `line`: a line with its time law. `scaling`: limits.
- `turn`: an orientation about one axis. `planned`: an exam, from the joints to a line and back.
"""
