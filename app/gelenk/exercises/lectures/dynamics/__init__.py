"""Dynamics by the Lagrangian: M q̈ + C q̇ + g = τ of planar arms in a vertical plane.

- `pendulum`: one link. `two_links`: gravity, mass matrix and torques of two links; the last one is an exam.
"""
