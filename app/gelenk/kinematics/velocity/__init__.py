"""Motion of the tip from motion of the joints, and back.

- `jacobian`: Jacobians in every reference frame and representation, with derivatives.
- `subspaces`: range and kernel of a Jacobian and of its transpose; `task_space`: the rows of J that a task selects.
- `velocity`: twist, acceleration, jerk and snap of the tip.
- `inverse_velocity`: joint rates for a given tip motion, by `linear_inverse`: exact, pseudo- and damped inverses.
- `words`: the names of these inverses and of their outcomes, without the code that computes them.
"""
