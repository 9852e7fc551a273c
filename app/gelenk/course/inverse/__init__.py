"""Inverse kinematics as it is done by hand.

- `solver`: how the numbers of an arm without a solution by hand were found.
"""
