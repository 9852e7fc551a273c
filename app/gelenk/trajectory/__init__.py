"""Motions: time laws, splines and paths, all built from polynomial pieces.

- `polynomial`: piecewise polynomials in time, the form of every motion; `extremes`: their exact peaks.
- `time_laws`: cubic, quintic, septic, 4-3-4; `trapezoid`: bang-coast-bang; `parabolic_blends` past via points, built
  like the trapezoid from `phases`; `splines` through knots, by a `tridiagonal` system; `time_scaling`: k times the
  time. Their `…_steps` are worked solutions, with `formulas`; `certify` recomputes ends, knots, joins and peaks.
- `paths`, `spline_paths`: paths of the tip by arc length, without time: lines, circles, splines, blended corners;
  built from `curves` and from `orientation_paths` and `rotation_splines`, which use `so3`.
- `fly_over`, `blended_motion`: a corner passed without a stop, and the motion around it; `fly_over_check` recomputes
  it, `fly_over_steps` writes its worked solution.
- `jerk_limited`: from one state to another in the least time, with Ruckig. `time_optimal`: along a given path, by
  `reachability` of path speeds, on `intervals` whose limits also hold between grid points.
- `joint_motion`: from point to point by any law; `joint_splines`, `via_blends`: through or past `joint_waypoints`;
  `joint_excess` finds where a motion leaves the joint limits.
- `follow`: joints along a path of the tip, on one branch: `follow_trace` takes steps (`follow_step`) along a
  `follow_course` within `follow_bounds`, `follow_exact` refines q'' to that of the exact path, `follow_damped` leaves
  the path near singularities, `follow_verdict` says why following ends; `follow_rows` gives the rows of J that count.
- `timing`: the time that joints take along a path, by `way_laws` and `s_curves` or time-optimally, under limits of
  joints and tip (`way_geometry`, `way_peaks`, `tip_rows`); `chain_laws` find the speed of each of several blended
  lines; `composition` composes path and law into one polynomial; `passing_times` is the law of given times.
- `problem`: the request for a trajectory and its result, in `words`; `plan` joins its `parts`: `joint_part`, and
  `tip_part` along `ways`; `whole_audit` joins their audits.
- `audit`: checks a motion with code that shares nothing with the planners: `audit_pieces` for the joints, `audit_tip`
  for the tip, both also between samples by `audit_peaks`; `audit_demands` are the requirements.
"""
