"""The time that joints take along a path, under limits of joints and tip.

- `timing`: the choice of a law, or given times. `path_laws`: given laws; `averages`: smooth laws along paths
  that bend.
- `time_optimal`: in the least time, by `reachability` of path speeds at `nodes` of the path.
- `tip_constraints`, `torque_constraints`: limits of the tip and of torques as rows; `path_peaks`: the largest
  use of a limit along a path.
"""
