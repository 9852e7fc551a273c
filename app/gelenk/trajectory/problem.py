"""The request for a trajectory, and its result.

A trajectory begins at a configuration, at rest, and goes through segments: joints to a configuration or a pose, the tip
along a line, a circle or a spline. Each segment has a law of time and limits of its own. It comes to rest between two
segments but where lines are blended.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from gelenk.kinematics.ik.task import FULL_POSE, Task
from gelenk.model.arrays import Array
from gelenk.model.poses import Poses
from gelenk.trajectory.audit import Audit
from gelenk.trajectory.audit_demands import TipLimits
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.splines import Boundary
from gelenk.trajectory.words import Law, NearSingularity, OrientationLaw, SegmentType, StopReason


@dataclass(frozen=True, slots=True)
class MotionLimits:
    """What joints and tip may do in a segment, scales applied; all finite and > 0 except for the tip's, which may be ∞.

    Attributes:
        velocity: Of each joint; shape (n,), [rad/s or m/s].
        acceleration: Shape (n,), [rad/s² or m/s²].
        jerk: Shape (n,), [rad/s³ or m/s³].
        tip: Of the tip.
    """

    velocity: Array
    acceleration: Array
    jerk: Array
    tip: TipLimits = field(default_factory=TipLimits)


@dataclass(frozen=True, slots=True)
class Segment:
    """One part of a trajectory.

    Attributes:
        type: The kind of path.
        law: Of time.
        limits: That hold on it.
        duration: It is to last, [s]; as long as its limits ask for if None.
        configuration: Target of a joint segment; shape (n,), [rad or m].
        pose: T_base_tip at the end, of a joint segment to a pose, a line or a circle; shape (4, 4).
        via: T_base_tip on the way of a circle; shape (4, 4).
        blend_radius: Distance from the end of a line at which it is left for the next, [m]; 0 stops there.
        blend_acceleration: Of the tip in the blend instead of a radius, [m/s²].
        blend_time: Of the blend instead of a radius, [s].
        orientation: How a path of the tip turns: about an axis, of which one that passes orientations has a smooth
            spline, or the Euler angles ZYZ each on their path, on either branch.
        configurations: A joint spline's waypoints after the start; shape (m, n), [rad or m].
        poses: A Cartesian spline's.
        times: When each is to be reached, after the segment's start; shape (m,), [s].
        boundary: Of a spline.
        blends: Whether a joint spline's waypoints are passed beside, on straight lines with parabolic blends.
        stated_jerk: Limits of jerk that were requested, which hold whatever the law; shape (n,), ∞ where none was,
            [rad/s³ or m/s³].
    """

    type: SegmentType
    law: Law
    limits: MotionLimits
    duration: float | None = None
    configuration: Array | None = None
    pose: Array | None = None
    via: Array | None = None
    blend_radius: float = 0.0
    blend_acceleration: float | None = None
    blend_time: float | None = None
    orientation: OrientationLaw = "axis_angle"
    configurations: Array | None = None
    poses: Poses | None = None
    times: Array | None = None
    boundary: Boundary = "clamped"
    blends: bool = False
    stated_jerk: Array | None = None


@dataclass(frozen=True, slots=True)
class Following:
    """How joints are to follow a path of the tip.

    Attributes:
        task: Directions that count; others are left free.
        position_tolerance: Largest distance from the path, also between samples, [m].
        orientation_tolerance: Largest angle, [rad].
        min_singular_value: σ of the Jacobian's rows that count, metres and radians mixed, below which a pose counts as
            near to a singularity.
        near_singularity: What to do there: stop; go on with damped joints and leave the path; go on exactly, slowly.
    """

    task: Task = FULL_POSE
    position_tolerance: float = 1e-4
    orientation_tolerance: float = 1e-3
    min_singular_value: float = 0.01
    near_singularity: NearSingularity = "stop"


@dataclass(frozen=True, slots=True)
class Problem:
    """The request for a trajectory.

    Attributes:
        start: Where it begins, at rest; shape (n,), [rad or m].
        segments: One after the other; at least one.
        following: How joints follow the tip's ways.
        duration: It is to last as a whole, [s]; as long as the limits ask for if None.
        compares_timing: Whether uniform and time-optimal scaling of each segment are to be compared.
    """

    start: Array
    segments: tuple[Segment, ...]
    following: Following = field(default_factory=Following)
    duration: float | None = None
    compares_timing: bool = False


@dataclass(frozen=True, slots=True)
class BlendReport:
    """How a line went over into the next.

    Attributes:
        radius: Distance from the corner at which the line is left, [m].
        start_time: [s].
        end_time: [s].
        acceleration: What the tip's may be in it at most, [m/s²]; None where only the radius was given.
    """

    radius: float
    start_time: float
    end_time: float
    acceleration: float | None


@dataclass(frozen=True, slots=True)
class SegmentReport:
    """The result of a segment, as far as it was done.

    Attributes:
        index: Which, from 0.
        type: The kind of path.
        law: Of time.
        start_time: [s].
        end_time: [s].
        length: Of the tip's path, [m]; of a joint segment None.
        angle: By which the tip turns on it, [rad]; of a joint segment None.
        joint_deviation: From the path at most that damping cost: distance [m] and angle [rad]; None if not damped.
        blended: Whether it is left for the next without a stop.
        blend: How, if the motion gets that far.
        notes: What else is to be known.
    """

    index: int
    type: SegmentType
    law: Law
    start_time: float
    end_time: float
    length: float | None = None
    angle: float | None = None
    joint_deviation: tuple[float, float] | None = None
    blended: bool = False
    blend: BlendReport | None = None
    notes: tuple[str, ...] = ()

    def slowed(self, factor: float) -> "SegmentReport":
        """The same in `factor` times the time."""
        return self._timed(lambda time: factor * time)

    def moved(self, start: float) -> "SegmentReport":
        """The same, all of it beginning at a time, [s]."""
        return self._timed(lambda time: start + time)

    def _timed(self, change: Callable[[float], float]) -> "SegmentReport":
        blend = self.blend
        if blend is not None:
            blend = replace(blend, start_time=change(blend.start_time), end_time=change(blend.end_time))
        return replace(self, start_time=change(self.start_time), end_time=change(self.end_time), blend=blend)


@dataclass(frozen=True, slots=True)
class TimingComparison:
    """One path of a segment (or of blended ones) at two timings.

    Attributes:
        segments: Which, from 0.
        law: That is scaled uniformly.
        uniform_duration: The law, scaled so that some limit is just reached, [s].
        velocity_factor: k that the velocity limits alone ask for, of the law lasting 1 s.
        acceleration_factor: The same of the acceleration limits: a time of √k times keeps them.
        time_optimal_duration: [s].
    """

    segments: tuple[int, ...]
    law: Law
    uniform_duration: float
    velocity_factor: float
    acceleration_factor: float
    time_optimal_duration: float


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a trajectory ends before its time.

    Attributes:
        reason: Of what kind.
        segment: Which one could not be done, from 0.
        time: Where the answer's motion ends, [s].
        position: Of the tip, where it could not go on; shape (3,), [m].
        joint: Which one is at its limit.
        detail: In a sentence.
    """

    reason: StopReason
    segment: int
    time: float
    position: Array
    joint: str | None
    detail: str


@dataclass(frozen=True, slots=True)
class Trajectory:
    """The result of a problem.

    Attributes:
        motion: Of the joints, from 0 s on.
        segments: Those that were done, wholly or in part.
        completed_fraction: Of the segments, each counting alike, a part of one by its length.
        failure: Why it is not 1.
        audit: The judgement of the motion.
        timing: If requested.
    """

    motion: PiecewisePolynomial
    segments: tuple[SegmentReport, ...]
    completed_fraction: float
    failure: Failure | None
    audit: Audit
    timing: tuple[TimingComparison, ...] = ()
