"""Forces at the tip and torques at the joints, at rest.

- `statics`: torques from wrenches, in other frames and at other points too, and back.
"""
