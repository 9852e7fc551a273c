"""Joints along a path of the tip, on one branch.

- `follow`: the whole. `integrate` takes steps (`step`) along a `rate_field` within `bounds`, from one point that
  `kernels` find to the next; `exact` refines q'' to that of the exact path; `rows` gives the rows of J that count.
- `swept` follows a whole path at once where nothing stands in its way.
- Spare joints look `ahead` over their self-motion where the shortest rates lead to an end: `ladder` finds the cheapest
  way through configurations to choose from, one of each rung, and `guided` the exact joint path next to it.
- `damped` leaves the path near singularities; `verdict` says why following ends.
"""
