"""Motions in time: time laws, splines and paths, put together from polynomial pieces.

- `polynomial`: what every motion is made of: pieces of polynomials in time; `extremes`: its exact peaks.
- `time_laws`: cubic, quintic, septic, 4-3-4; `trapezoid`: bang-coast-bang, `parabolic_blends` past via points, both
  made of `phases`; `splines` through knots, by a `tridiagonal` system; `time_scaling`: k times the time. Their
  `…_steps` are worked solutions, with `formulas`; `certify` goes through ends, knots, joins and peaks a second time.
- `paths`, `spline_paths`: ways of the tip by arc length, without time: lines, circles, splines, blended corners; made
  of `curves` and of `orientation_paths`, `rotation_splines`, which stand on `so3`.
- `fly_over`, `blended_motion`: a corner passed without a stop, and the motion around it; `fly_over_check` goes through
  it a second time, `fly_over_steps` writes it down.
- `jerk_limited`: from one state to another in the least time, on ruckig. `time_optimal`: along a given path, by
  `reachability` of path speeds, on `intervals` whose limits hold in between too.
- `audit`: a motion judged by code that shares nothing with what planned it: `audit_pieces` of the joints, `audit_tip`
  of the tip, by `audit_demands`.
"""
