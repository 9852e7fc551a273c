"""Time laws under limits.

- `laws`: the table of all laws.
- `trapezoid`: bang-coast-bang; `s_curves`: with limited jerk. `time_scaling`: k times the time.
- `jerk_limited`: from one state to another in the least time or a given one, by the `jerk_profiles` of each joint.
"""
