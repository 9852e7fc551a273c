"""Trajectories: time laws, splines, lines and corners, orientations.

- `polynomials`: cubic, quintic and spline. `profiles`: bang-coast-bang, of one joint and of two in step.
- `paths`: a line, a fly-over. `scaling`: limits. `turn`: an orientation about one axis.
- `planned`: an exam, from the joints to a line and back.
"""
