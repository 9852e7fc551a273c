"""Segments of a motion as plain dicts, for checkers of types: the fields of `trajectory_request`'s models."""

from collections.abc import Mapping, Sequence
from typing import Literal, NotRequired, TypeAlias, TypedDict

from gelenk.contract.pose import PoseLike
from gelenk.robot.arrays import Array, Configuration
from gelenk.trajectory.audit.words import Law, OrientationLaw
from gelenk.trajectory.motion.splines import Boundary

_OfJoints: TypeAlias = float | Sequence[float] | Mapping[str, float] | Array


class LimitsDict(TypedDict, total=False):
    """`TrajectoryLimits`."""

    joint_velocity: _OfJoints
    joint_acceleration: _OfJoints
    joint_jerk: _OfJoints
    joint_torque: Literal["effort"] | _OfJoints
    tip_velocity: float
    tip_acceleration: float
    tip_angular_velocity: float
    tip_angular_acceleration: float


class OptionsDict(TypedDict, total=False):
    """`MotionOptions`."""

    limits: LimitsDict
    velocity_scale: float
    acceleration_scale: float


class _SegmentOptions(OptionsDict, total=False):
    law: Law
    duration: float


class JointDict(_SegmentOptions):
    """`JointSegment`."""

    type: Literal["joint"]
    target: Configuration | PoseLike


class LineDict(_SegmentOptions):
    """`LineSegment`."""

    type: Literal["line"]
    target: PoseLike
    blend_radius: NotRequired[float]
    blend_acceleration: NotRequired[float]
    blend_time: NotRequired[float]
    orientation: NotRequired[OrientationLaw]


class CircleDict(_SegmentOptions):
    """`CircleSegment`."""

    type: Literal["circle"]
    via: PoseLike
    target: PoseLike
    blend_radius: NotRequired[float]
    orientation: NotRequired[OrientationLaw]


class SplineDict(_SegmentOptions):
    """`SplineSegment`."""

    type: Literal["spline"]
    waypoints: Sequence[Configuration | PoseLike] | Array
    times: NotRequired[Sequence[float] | Array]
    waypoint_options: NotRequired[Sequence[OptionsDict | None]]
    boundary: NotRequired[Boundary]
    blends: NotRequired[bool]
    orientation: NotRequired[OrientationLaw]


SegmentDict: TypeAlias = JointDict | LineDict | CircleDict | SplineDict
