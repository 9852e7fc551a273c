"""Piecewise polynomials in time, the form of every motion.

- `polynomial`: pieces and their values; `composition`: of a path and a law into one polynomial.
- `extremes`: exact peaks.
- `time_laws`: cubic, quintic, septic, 4-3-4. `phases`: motions of constant accelerations, one after the other.
- `splines`: through knots, by a `tridiagonal` system.
"""
