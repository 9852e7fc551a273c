"""String values used in motion requests and results, which can be imported without the planner."""

from typing import Literal, TypeAlias

Check: TypeAlias = Literal[
    "velocity", "acceleration", "jerk", "joint_limit", "continuity", "path", "tip", "boundary", "torque", "clearance"
]
PolynomialLaw: TypeAlias = Literal["cubic", "quintic", "septic"]
Law: TypeAlias = Literal[PolynomialLaw, "trapezoidal", "jerk_limited", "time_optimal"]
SegmentType: TypeAlias = Literal["joint", "line", "circle", "spline"]
OrientationLaw: TypeAlias = Literal["axis_angle", "zyz", "zyz_other"]
NearSingularity: TypeAlias = Literal["stop", "damp", "slow_down"]
StopReason: TypeAlias = Literal["out_of_reach", "joint_limit", "singularity", "branch_change", "collision"]
