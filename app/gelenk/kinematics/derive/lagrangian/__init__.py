"""The equations of motion of a planar arm by the Lagrangian, as a lecturer works them out: M q̈ + C q̇ + g = τ.

- `bodies`: masses, centres of mass, inertias and gravity as they were given; what was left out is a symbol.
- `plane`: the arm in its plane, where all angles add up: the centres of mass in frame 0.
- `equations`: velocities, energies, M, Christoffel symbols, C and g as polynomials.
- `writing`: these as a textbook prints them.
- `squares`: squares of sums within a polynomial.
- `texts`: what goes into the symbolic part and comes out of it, as plain data.
- `symbolic`: all of it for one table; it knows neither NumPy nor Pinocchio.
- `numeric`: M, C and g at given configurations, from the columns of Jacobians.
- `check`: formulas and numbers against Pinocchio.
- `steps`: the derivation in the order of the lecture.
- `solution`: all of it together.
"""
