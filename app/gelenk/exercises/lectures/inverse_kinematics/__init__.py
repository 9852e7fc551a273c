"""Inverse kinematics by hand.

- `by_hand`: what the core finds for an arm that is given by its rows.
- `triangle`: the elbow by the law of cosines. `planar`: two and three links in a plane. `spatial`: SCARA and the
  anthropomorphic arm. `wrist`: the angles of a spherical wrist. `decoupling`: an exam about an arm of six joints.
"""
