"""Recomputation of answers through Pinocchio, and the differences.

- `judge`: poses, frames, Jacobians and DH tables.
"""
