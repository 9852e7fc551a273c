"""Motions in time: time laws, splines and paths, put together from polynomial pieces.

- `polynomial`: what every motion is made of: pieces of polynomials in time; `extremes`: its exact peaks.
- `time_laws`: cubic, quintic, septic, 4-3-4; `trapezoid`: bang-coast-bang, `parabolic_blends` past via points, both
  made of `phases`; `splines` through knots, by a `tridiagonal` system; `time_scaling`: k times the time. Their
  `…_steps` are worked solutions, with `formulas`; `certify` goes through ends, knots, joins and peaks a second time.
- `paths`, `spline_paths`: paths of the tip by arc length, without time: lines, circles, splines, blended corners; made
  of `curves` and of `orientation_paths`, `rotation_splines`, which stand on `so3`.
- `fly_over`, `blended_motion`: a corner passed without a stop, and the motion around it; `fly_over_check` goes through
  it a second time, `fly_over_steps` writes it down.
- `jerk_limited`: from one state to another in the least time, on ruckig. `time_optimal`: along a given path, by
  `reachability` of path speeds, on `intervals` whose limits hold in between too.
- `joint_motion`: from point to point by any law; `joint_splines`, `via_blends` through or past `joint_waypoints`;
  `joint_excess` tells where a motion leaves the joints' limits.
- `follow`: joints along a way of the tip, on one branch: `follow_trace` takes steps (`follow_step`) of a
  `follow_course` within `follow_bounds`, `follow_exact` makes peaks those of the exact way, `follow_damped` leaves the
  path near singularities, `follow_verdict` says why it ends; all see J's `follow_rows` that count.
- `timing`: the time that joints take along a way, by `way_laws` and `s_curves` or time-optimally, under limits of
  joints and tip (`way_geometry`, `way_peaks`, `tip_rows`); `chain_laws` give each of several blended lines its speed;
  `composition` makes one polynomial of way and law; `passing_times` is the law of given times.
- `problem`: the request for a trajectory and its result, in `words`; `plan` joins its `parts`: `joint_part`, and
  `tip_part` along `ways`; `whole_audit` joins their judgements.
- `audit`: a motion judged by code that shares nothing with what planned it: `audit_pieces` of the joints, `audit_tip`
  of the tip, both between samples too by `audit_peaks`; what it has to keep to are `audit_demands`.
"""
