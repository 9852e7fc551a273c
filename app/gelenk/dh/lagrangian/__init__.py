"""The equations of motion of a planar arm by the Lagrangian, as a lecturer derives them: M q̈ + C q̇ + g = τ.

- `bodies`: masses, centres of mass, inertias and gravity as given; a quantity that was left out is a symbol.
- `plane`: the arm in its plane, where all angles add up: the centres of mass in frame 0.
- `equations`: velocities, energies, M, Christoffel symbols, C and g as polynomials.
- `writing`: writes these as a textbook prints them.
- `squares`: finds squares of sums in a polynomial.
- `texts`: input and output of the symbolic part, as plain data.
- `symbolic`: the symbolic part for one table; it uses neither NumPy nor Pinocchio.
- `numeric`: M, C and g at given configurations, from the columns of Jacobians.
- `check`: compares formulas and numbers with Pinocchio.
- `steps`: the derivation in the order of the lecture.
- `solution`: puts all parts together.
"""
