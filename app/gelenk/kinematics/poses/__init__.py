"""Poses of tips and frames.

- `forward`: forward kinematics of a batch.
"""
