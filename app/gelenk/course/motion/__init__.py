"""Worked solutions of motions in time.

- `time_law_steps`, `trapezoid_steps`, `spline_steps`: those of laws, splines and time scaling.
- `fly_over`, `blended_motion`: a corner passed without a stop, and the motion around it; `fly_over_check` recomputes
  it, `fly_over_steps` writes its worked solution.
- `check`: recomputes ends, knots, joins and peaks.
"""
