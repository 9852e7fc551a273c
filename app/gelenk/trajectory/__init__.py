"""Motions: time laws, splines and paths, all built from polynomial pieces.

- `motion`: polynomials in time and what is made of them. `problem`: the request for a trajectory and its result.
- `laws`: from one state to another under limits. `paths`: paths of the tip without time. `timing`: the time that
  joints take along a path. `joints`: motions through configurations. `follow`: joints along a path of the tip;
  `tool`: the choice of turns that the path of a tool leaves open.
- `audit`: checks a motion with code that shares nothing with the planners.
- `plan` joins `joint_part` and `tip_part`.
"""
