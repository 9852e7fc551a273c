"""Motions along a straight line: of a point without a robot, and of a planar arm's tip.

- `line`: the line and its time law, by `line_steps`; what each axis of a PPP robot alone would need.
- `turn`: the orientation along it, by axis and angle and by Euler angles.
- `planar_line`: a line of a 2R arm on one branch, and its joints over time, exactly.
- `pipeline`: samples of such a line and the spline through them.
- `segment_steps`: the segments of a robot's trajectory.
"""
