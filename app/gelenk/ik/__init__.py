"""Inverse kinematics: from a tip pose to joint configurations, or to the reason why none exists.

- `solve`: inverse kinematics of a robot from all of these, each solution recomputed with Pinocchio; `analytic`: its
  methods that list every solution; `clear`: solutions in a cell; `quick`: one solution for a target.
- `search`: methods from a start. `closed`: closed forms and elimination. `count`: all solutions, proved by their
  number. `verdict`: distinct solutions, or why there is none.
"""
