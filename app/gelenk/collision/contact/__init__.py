"""Contacts and distances of a robot's pieces and those around it.

- `world`: robot and scene together, with the `nodes` that carry the pieces; `flat`: the same as arrays.
- `kernels`: contacts of many configurations, each worked out in a `room`; verdicts of eight at a time, first by
  `spheres`. `pair` decides about two pieces, by `gjk` while they are apart, by `penetration` in contact. `gradient`:
  how distances change with the joints.
- `always`: links whose pieces are in contact at every configuration.
- `judge`: the same by Pinocchio and Coal; `words`: its certificate.
"""
