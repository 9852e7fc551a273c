"""Joints along a path of the tip, on one branch.

- `follow`: the whole. `integrate` takes steps (`step`) along a `rate_field` within `bounds`, from one point that
  `nearest` finds to the next; `exact` refines q'' to that of the exact path; `rows` gives the rows of J that count.
- `ladder` finds the cheapest way through configurations to choose from, one of each rung.
- `damped` leaves the path near singularities; `verdict` says why following ends.
"""
