"""Trajectories: the request."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal, cast

from pydantic import Discriminator, Field, Tag

from gelenk.contract.common import ChainOptions, OnTheWire, Payload, optional
from gelenk.contract.course_motion import Duration
from gelenk.contract.kinematics import ByName, ByOrder, Configuration
from gelenk.contract.options import Directions, WithSteps
from gelenk.contract.pose import ORIENTATIONS, WHOLE, AnswerFormat, Pose, PoseLike, pose_fields
from gelenk.contract.scene import InCell
from gelenk.contract.segment_dicts import LimitsDict, OptionsDict, SegmentDict
from gelenk.contract.statics import CarriedLoad, Gravity
from gelenk.robot.arrays import Array, Configuration as GivenConfiguration
from gelenk.trajectory.audit.words import Law, NearSingularity, OrientationLaw
from gelenk.trajectory.motion.splines import Boundary

MAX_SAMPLES = 100_000
"""Maximum number of samples of a motion."""
MAX_JOB_SAMPLES = 500_000
"""Maximum number of samples of a motion that a job computes."""
MAX_SEGMENTS = 100
MAX_WAYPOINTS = 1000
"""Maximum number of waypoints of all segments together, and of poses of a path."""
MAX_TURNS = 72
"""Maximum number of turns of the tool that are tried at each pose."""

_POSE_FIELDS = WHOLE | {"position", *ORIENTATIONS}


def _target_kind(value: Any) -> str:
    """Distinguish a pose from a configuration by name: a joint may be called `position`, but its value is a number."""
    if isinstance(value, Pose):  # on the way out
        return "<pose>"
    if not isinstance(value, dict):
        return "<list>"
    is_pose = any(key in _POSE_FIELDS and not isinstance(part, int | float) for key, part in value.items())
    return "<pose>" if is_pose else "<object>"


def _limit_kind(value: Any) -> str:
    return "<list>" if isinstance(value, list) else "<object>" if isinstance(value, dict) else "<number>"


def _torque_kind(value: Any) -> str:
    return "<word>" if isinstance(value, str) else _limit_kind(value)


def _segment_kind(value: Any) -> str:
    return f"<{value.get('type') if isinstance(value, dict) else getattr(value, 'type', None)}>"


_Target = Annotated[
    Annotated[ByOrder, Tag("<list>")] | Annotated[ByName, Tag("<object>")] | Annotated[Pose, Tag("<pose>")],
    Discriminator(_target_kind),
]
Target = Annotated[GivenConfiguration | PoseLike, OnTheWire(_Target)]
"""A configuration, or a pose of the tip."""
Place = Annotated[PoseLike, OnTheWire(Pose)]
"""A pose of the tip; a dict from Python code becomes a model."""

_ORIENTATION_THROUGH = (
    "How the orientation changes: `axis_angle`, a rotation spline of continuous angular acceleration; `zyz`, a natural "
    "cubic spline of the Euler angles ZYZ; `zyz_other`, the same with the other triple of each pose after the start."
)

_Bound = Annotated[float, Field(ge=1e-6, le=1e6)]
_Scale = Annotated[float, Field(ge=1e-6, le=1.0)]
JointValues = Annotated[
    Annotated[_Bound, Tag("<number>")]
    | Annotated[list[_Bound], Field(max_length=128, fail_fast=True), Tag("<list>")]
    | Annotated[dict[str, _Bound], Field(max_length=128), Tag("<object>")],
    Discriminator(_limit_kind),
]
"""One number for all joints, one per joint, or numbers by joint name: joints left out keep their limits."""


JointTorques = Annotated[
    Annotated[Literal["effort"], Tag("<word>")]
    | Annotated[_Bound, Tag("<number>")]
    | Annotated[list[_Bound], Field(max_length=128, fail_fast=True), Tag("<list>")]
    | Annotated[dict[str, _Bound], Field(max_length=128), Tag("<object>")],
    Discriminator(_torque_kind),
]
"""The same, or the effort limits of the robot's description."""


class TrajectoryLimits(Payload):
    """Limits of the joints and the tip; from 1e-6 to 1e6 each.

    For the joints, give one number for all, one number each, base to tip, or an object of numbers by joint name:
    joints that it leaves out keep their limits.
    """

    joint_velocity: JointValues | None = optional(
        "|q̇|, [rad/s or m/s]. If left out that of the robot's description; where it has none (or 0, or 100 and more, "
        "which stand for none) 1 rad/s, of a sliding joint 0.25 m/s. A given limit applies even if the description's "
        "is lower, and `notes` then says so."
    )
    joint_acceleration: JointValues | None = optional(
        "|q̈|, [rad/s² or m/s²]; no robot's description has one. If left out, that with which the limit of the "
        "velocity is reached in 0.5 s."
    )
    joint_jerk: JointValues | None = optional(
        "|q⃛|, [rad/s³ or m/s³]; no robot's description has one. If left out, that with which the limit of the "
        "acceleration is reached in 0.1 s. Where a law lets the acceleration jump, the jump does not count."
    )
    joint_torque: JointTorques | None = optional(
        "|τ| of the motors, [N m, or N for sliding], in the same forms; or `effort`, the effort limits of the robot's "
        "description. None if left out. It counts the weight of the links and the `payload`, as `dynamics` does, "
        "without friction. `time_optimal` is as fast as it allows at each place, another law takes longer as a whole. "
        "A motion in which the weight alone asks for more is refused."
    )
    tip_velocity: _Bound | None = optional("Speed of the tip, [m/s]; none if left out.")
    tip_acceleration: _Bound | None = optional("Of the tip, along and across, [m/s²]; none if left out.")
    tip_angular_velocity: _Bound | None = optional("‖ω‖ of the tip, [rad/s]; none if left out.")
    tip_angular_acceleration: _Bound | None = optional("‖ω̇‖ of the tip, [rad/s²]; none if left out.")


class MotionOptions(Payload):
    """Limits and scales of a motion; a segment takes those that it leaves out from the trajectory."""

    limits: Annotated[TrajectoryLimits | LimitsDict, OnTheWire(TrajectoryLimits)] | None = optional(
        "Limits of the joints and the tip; in a segment, each field left out is taken from the trajectory."
    )
    velocity_scale: _Scale | None = optional(
        "Factor of all velocity limits, the tip's too, from 1e-6 to 1; no unit. 1 if left out."
    )
    acceleration_scale: _Scale | None = optional(
        "Factor of all acceleration limits, the tip's too, and of the jerks; likewise."
    )

    def own_limits(self) -> TrajectoryLimits | None:
        """Return the limits; a dict from Python code has become a model."""
        return cast(TrajectoryLimits | None, self.limits)


class SegmentOptions(MotionOptions):
    """Options that every segment has."""

    law: Law | None = optional("Time law; the trajectory's if left out.")
    duration: Duration | None = optional("Duration of the segment, [s]; one shorter than its limits allow is refused.")


class JointSegment(SegmentOptions):
    """Moves all joints together to a configuration, wherever that leads the tip."""

    type: Literal["joint"] = Field(description="All joints together.")
    target: Target = Field(
        description="A configuration, one number per joint or by joint name, [rad or m]; or a pose of `tip_frame` in "
        "`base_frame`, for which the solution nearest to the segment's start is used, with a `scene` the nearest that "
        "touches nothing."
    )


class LineSegment(SegmentOptions):
    """Moves the tip straight to a pose, from rest to rest unless it is blended."""

    type: Literal["line"] = Field(description="Straight on.")
    target: Place = Field(description="Pose of `tip_frame` in `base_frame` at its end.")
    blend_radius: float | None = optional(
        "Distance from the target at which the motion leaves this line for the next line or circle, without a stop, "
        "[m]: along a parabola, or at a circle and with `quintic`, `septic` and `jerk_limited` a curve of continuous "
        "curvature, closer to the target.",
        ge=0,
        le=1e6,
    )
    blend_acceleration: _Bound | None = optional(
        "Instead of `blend_radius`, between lines, a_max of the course's fly-over, [m/s²]: the tip's acceleration in "
        "the blend is no more. The radius is v ΔT/2 with ΔT = ‖v K_BC - v K_AB‖/a_max, v the smallest `tip_velocity` "
        "of the lines that are blended. With `trapezoidal` and `time_optimal` the corner then takes ΔT, or longer if "
        "the joints need it."
    )
    blend_time: Duration | None = optional(
        "Instead of `blend_radius`, between lines, ΔT of the course's fly-over, [s]: the radius is v ΔT/2, v the "
        "smallest `tip_velocity` of the lines that are blended, and the tip's acceleration in the blend at most "
        "‖v K_BC - v K_AB‖/ΔT. With `trapezoidal` and `time_optimal` the corner then takes ΔT, or longer if the joints "
        "need it."
    )
    orientation: OrientationLaw = Field(
        default="axis_angle",
        description="How the orientation changes: about one fixed axis in proportion to the length, or the Euler "
        "angles `zyz` each linear in the length, with `zyz_other` to the other triple of the same target.",
    )


class CircleSegment(SegmentOptions):
    """Moves the tip along the arc through one pose to another, less than a full circle."""

    type: Literal["circle"] = Field(description="Along a circle.")
    via: Place = Field(
        description="Pose of `tip_frame` in `base_frame` that the arc passes through, orientation included."
    )
    target: Place = Field(description="Pose at its end.")
    blend_radius: float | None = optional(
        "Distance from the target, along the arc, at which the motion leaves it for the next line or circle, without a "
        "stop, [m]: at most a quarter of the circle, and on a curve of continuous curvature.",
        ge=0,
        le=1e6,
    )
    orientation: OrientationLaw = Field(default="axis_angle", description=_ORIENTATION_THROUGH)


class SplineSegment(SegmentOptions):
    """A cubic spline through configurations, or a smooth path of the tip through poses."""

    type: Literal["spline"] = Field(description="Through points, along a spline.")
    waypoints: Annotated[
        Sequence[GivenConfiguration | PoseLike] | Array,
        OnTheWire(Annotated[list[_Target], Field(min_length=1, max_length=MAX_WAYPOINTS)]),
    ] = Field(
        description="Waypoints after the start, the last one the end: all of them configurations, one number per joint "
        "or by joint name, [rad or m], or all of them poses of `tip_frame` in `base_frame`.",
    )
    times: list[Duration] | None = optional(
        "Time of each, after the segment's start, increasing, [s]; if left out, found from the limits.",
        max_length=MAX_WAYPOINTS,
    )
    waypoint_options: (
        Annotated[
            Sequence[MotionOptions | OptionsDict | None],
            OnTheWire(Annotated[list[MotionOptions | None], Field(max_length=MAX_WAYPOINTS)]),
        ]
        | None
    ) = optional(
        "Of poses, limits and scales on the way to each waypoint, one entry for each; what is left out, or all of it "
        "with null, is taken from the segment. Limits of torque hold along the whole segment."
    )
    boundary: Boundary = Field(
        default="clamped",
        description="End conditions: `clamped`, at rest; `natural`, without acceleration; `not_a_knot`; "
        "`periodic`, the end like the start; `assigned`, at rest and without acceleration.",
    )
    blends: bool = Field(
        default=False,
        description="Of configurations, with the law `trapezoidal`: joints go on straight lines from one to the next, "
        "with parabolic blends that pass beside the inner ones (Craig's linear segments with parabolic blends); "
        "`notes` say how far. No spline then, and no boundary.",
    )
    orientation: OrientationLaw = Field(default="axis_angle", description=f"Of poses. {_ORIENTATION_THROUGH}")


Segment = Annotated[
    Annotated[JointSegment, Tag("<joint>")]
    | Annotated[LineSegment, Tag("<line>")]
    | Annotated[CircleSegment, Tag("<circle>")]
    | Annotated[SplineSegment, Tag("<spline>")],
    Discriminator(
        _segment_kind,
        custom_error_type="segment_type",
        custom_error_message="a segment has a `type`: joint, line, circle or spline",
    ),
]


class ToolPath(Payload):
    """A path of the tool (welding, milling, gluing) that may turn about one of its own axes along it.

    Of all branches of the inverse kinematics and all turns tried, at all poses, the sequence with the least joint
    travel is chosen: Σ ‖Δq_j/v_j‖, with the joints' velocity limits v, clear of joint limits and singularities. The
    turns in between are then used for an even motion.
    """

    poses: Annotated[
        Sequence[PoseLike] | Array,
        OnTheWire(
            Annotated[list[Pose], Field(min_length=2, max_length=MAX_WAYPOINTS, fail_fast=True)],
            lambda given: pose_fields(given, "path.poses"),
        ),
    ] = Field(
        description=f"Poses of `tip_frame` in `base_frame`, 2 to {MAX_WAYPOINTS}, the first one included; the tip "
        "passes through their positions on a smooth curve."
    )
    free: list[Literal["rx", "ry", "rz"]] = Field(
        max_length=1,
        description="The axis of `tip_frame` about which the tool may turn, as `rz`; or none, `[]`, if only the "
        "branch is to be chosen.",
        examples=[["rz"]],
    )
    steps: int = Field(
        default=36, ge=1, le=MAX_TURNS, description="Turns that are tried at each pose, spread over a full turn."
    )


_RATES = (
    "one number per joint or by joint name; at rest if left out. That segment is a `joint` motion with the law `cubic` "
    "(velocities), `quintic`, `septic` or `jerk_limited`, or a `spline` through configurations with the law `cubic` "
    "and the boundary `clamped` (velocities) or `assigned`."
)


class Motion(ChainOptions, MotionOptions, WithSteps):
    """A motion through segments, one after the other, or along the path of a tool."""

    start: Configuration | None = optional(
        "Configuration in which the motion begins, one number per joint of the chain or by joint name, [rad or m]; "
        "required without `at`. With `path` it may be left out: then the motion begins at the first pose; otherwise a "
        "motion of the joints, segment 0, leads there, and its travel counts."
    )
    start_velocities: Configuration | None = Field(
        default=None, description=f"At the start of the first segment, [rad/s or m/s], {_RATES}"
    )
    start_accelerations: Configuration | None = optional(
        "Likewise, [rad/s² or m/s²]; not with `cubic`, unless the boundary is `assigned`."
    )
    end_velocities: Configuration | None = optional("At the end of the last segment, [rad/s or m/s], likewise.")
    end_accelerations: Configuration | None = optional("At the end of the last segment, [rad/s² or m/s²], likewise.")
    segments: (
        Annotated[
            Sequence[Segment | SegmentDict],
            OnTheWire(Annotated[list[Segment], Field(min_length=1, max_length=MAX_SEGMENTS)]),
        ]
        | None
    ) = optional(
        f"One after the other, with a stop between two that are not blended; 1 to {MAX_SEGMENTS}, with at most "
        f"{MAX_WAYPOINTS} waypoints in all. Required without `path`."
    )
    path: ToolPath | None = optional(
        "Instead of `segments`, the path of a tool that may turn about one of its axes; of arms with six joints whose "
        "inverse kinematics has a closed form, or with seven if it has one once a joint is held: that joint stays "
        "where it is best along the path. From rest to rest, and in all directions (no `task`)."
    )
    payload: CarriedLoad | None = optional("A load carried by the tip during the whole motion; it counts for torques.")
    gravity: Gravity = Field(
        default=True,
        description="For torques: true for 9.81 m/s² along -z of the root link, false for none, or the gravity in the "
        "axes of the root link, [m/s²].",
        examples=[[0.0, 0.0, -9.81]],
    )
    law: Law = Field(
        default="trapezoidal",
        description="Of time along each segment: polynomials from rest to rest (`cubic`; `quintic`, acceleration zero "
        "at both ends; `septic`, jerk too), `trapezoidal` velocity, `jerk_limited`, or `time_optimal`: as fast as the "
        "limits of velocity, acceleration and torque allow at each place. Along blended segments and splines of poses "
        "the motion is slow only where the path bends, and as smooth as the law: `time_optimal` in place of `cubic` "
        "and `trapezoidal`, else its moving average; `notes` say so.",
    )
    law_fallback: bool = Field(
        default=False,
        description="Whether another law may replace one that cannot be kept: `time_optimal`, with `near_singularity` "
        "`slow_down`. Each segment of the answer gives its `law`. Otherwise the call is refused.",
    )
    duration: Duration | None = optional(
        "Duration of the whole motion, [s]; one shorter than the limits allow is refused."
    )
    sample_period: _Bound = Field(
        default=0.01,
        description="From one sample to the next, [s]; the last one is exactly at the end.",
    )
    path_tolerance: float = Field(
        default=1e-4,
        ge=1e-7,
        le=1.0,
        description="Allowed distance of the tip from its path, also between samples, [m]. `way_error` of the answer's "
        "`audit` gives the difference of the peaks from those of the exact path.",
    )
    orientation_tolerance: float = Field(default=1e-3, ge=1e-6, le=1.0, description="Allowed angle from it, [rad].")
    task: Directions | None = optional(
        "The directions in which the path counts, as in `ik`; all six if left out. `x y z` along the base's axes, `rx "
        "ry rz` about the path's: `x y z rx ry` is a position and an approach axis.",
        examples=[["x", "y", "z", "rx", "ry"]],
    )
    near_singularity: NearSingularity = Field(
        default="stop",
        description="What to do on a tip path where `min_singular_value` is not kept: `stop`, the motion ends there; "
        "`damp`, it continues with damped joints and leaves the path, as each segment reports; `slow_down`, it goes on "
        "exactly and slows down there as the joints' limits require, with the law `time_optimal`.",
    )
    min_singular_value: float = Field(
        default=0.01,
        ge=1e-6,
        le=1e3,
        description="Smallest singular value of the Jacobian's rows that count below which a configuration is near to "
        "a singularity, [m or rad] per [rad or m]: units are mixed.",
    )
    compare_timing: bool = Field(
        default=False,
        description="Whether to give the time-optimal duration of each path beside that of a law scaled uniformly.",
    )
    coefficients: bool = Field(default=False, description="Whether to include each segment's polynomials in full.")
    tip_poses: bool = Field(default=True, description="Whether to include the tip's poses at the samples.")
    torques: bool = Field(default=False, description="Whether to include the motors' torques at the samples.")
    pose_format: AnswerFormat = "quaternion_xyzw"

    def moves(self) -> Sequence[Segment]:
        """Return the segments, none along a `path`; dicts from Python code have become models."""
        return cast(Sequence[Segment], self.segments or ())


class RunningMotion(Payload):
    """A motion that is being carried out, by the request that it was planned from, and a time in it."""

    trajectory: Motion = Field(
        description="The former request, with its `start`, and without its `scene`, `min_clearance` and "
        "`other_joints`; it is planned again, and nothing needs to be stored. Of a motion that began with `at` itself, "
        "give the start with its velocities and accelerations."
    )
    time: float = Field(ge=0.0, le=1e6, description="Since its start, [s].")


class TrajectoryRequest(Motion, InCell):
    """A motion through segments, one after the other, from rest, from given rates, or out of another motion."""

    at: RunningMotion | None = optional(
        "Instead of `start`, a running motion and a time: the new one begins in its state there, with its velocities "
        "and, if the first segment's law takes them, accelerations."
    )
