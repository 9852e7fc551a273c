"""What is said of a target: its distinct solutions, or why there is none.

- `branches`: all distinct solutions by search; `near_singular`: those next to a singularity that rounding hides.
- `verdict`: why a target is unsolved, and the closest configuration. `result`: the answer's fields.
- `fixed`: the chain that remains when joints are held. `judge`: recomputes solutions with Pinocchio.
"""
