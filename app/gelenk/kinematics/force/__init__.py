"""Forces at the tip and torques at the joints, at rest.

- `wrenches`: wrenches in other frames and at other points; `statics`: torques from wrenches, and back.
"""
