"""All solutions of a target, proved by their number.

- `continuation`: all solutions of any six joints; `homotopy` tracks them in complex numbers, `special` counts those of
  special geometries.
- `families`: infinitely many solutions, described by the joints that move and the relations between them.
"""
