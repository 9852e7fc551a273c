"""Recomputation of answers through Pinocchio, and the differences.

- `judge`: samples, the allowed difference, poses and Jacobians; `own_pose`: one pose, where Pinocchio leaves it;
  `tables`: DH tables; `motion`: twists up to snaps.
- `words`: the certificates, without the code that computes them.
"""
