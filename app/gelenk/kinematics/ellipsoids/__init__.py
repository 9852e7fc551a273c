"""What the tip can do with joint velocities or torques of norm one, or within the joint limits.

- `manipulability`: ellipsoids and measures; `limited_motion`: the same within the limits of each joint.
"""
