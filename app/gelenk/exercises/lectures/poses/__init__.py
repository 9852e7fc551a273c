"""Orientations and poses of bodies.

- `frames`: two rotations composed, and a transform inverted. `triples`: ZYZ angles, roll, pitch and yaw, and where they
  degenerate. `axis`: axis and angle, and an exam about a camera on a gripper.
"""
