"""Piecewise polynomials in time, the form of every motion.

- `polynomial`: pieces and their values, by `evaluation`; `composition`: of a path and a law into one polynomial.
- `extremes`: exact peaks, at `stationary` places.
- `time_laws`: cubic, quintic, septic, 4-3-4. `phases`: motions of constant accelerations, one after the other.
- `splines`: through knots, by a `tridiagonal` system.
"""
