"""Inverse kinematics by hand.

- `by_hand`: what the core finds for an arm that is given by its rows.
- `planar`: the elbow by the law of cosines, two and three links in a plane. `spatial`: SCARA and the anthropomorphic
  arm. `wrist`: the angles of a spherical wrist, and an exam about an arm of six joints.
"""
