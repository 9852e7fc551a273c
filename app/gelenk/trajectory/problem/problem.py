"""The request for a trajectory, and its result.

A trajectory starts at a configuration and runs through segments: the joints move to a configuration or a pose, or the
tip along a line, a circle or a spline. Each segment has its own time law and limits. The motion stops between two
segments unless they are blended; at its start and its end it may move, if joint motions are there.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.demands import TipLimits
from gelenk.trajectory.audit.result import Audit
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.audit.words import Law, NearSingularity, OrientationLaw, SegmentType
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import Boundary, EndRates
from gelenk.trajectory.problem.result import Damping, PlanningFailure, SegmentBlend, TimingComparison, ToolChoice

OPEN = np.full((3, 3), np.nan)
"""Orientation of a pose on a tip path that leaves it open: that of the pose before."""

BLENDABLE = ("line", "circle")
"""Types of segments that can be blended into one another."""


@dataclass(frozen=True, slots=True)
class SegmentLimits:
    """Limits of joints and tip in a segment, scale factors included; > 0, and finite except for the tip's.

    Attributes:
        velocity, acceleration, jerk: Of each joint; shape (n,), [rad or m per s, s², s³].
        torque: Limits of torque, if torques count.
    """

    velocity: Array
    acceleration: Array
    jerk: Array
    tip: TipLimits = field(default_factory=TipLimits)
    torque: TorqueLimits | None = None

    @property
    def joints(self) -> Array:
        """Limits of velocity, acceleration and jerk; shape (3, n)."""
        return np.array([self.velocity, self.acceleration, self.jerk])


@dataclass(frozen=True, slots=True)
class FreeTool:
    """A turn of the tip about an axis of its own that a path leaves open.

    Attributes:
        axis: In the tip's frame, a unit vector, or zero if only the branch is to be chosen; shape (3,).
        steps: Angles per turn that are tried.
    """

    axis: Array
    steps: int


@dataclass(frozen=True, slots=True)
class ToolTurn:
    """Turns of the tip about an axis of its own, (3,), at places of a path, (R,), [m]; shape (R,), [rad].

    `guide` is the joints' motion along the path, near which spare joints stay.
    """

    axis: Array
    places: Array
    turns: Array
    guide: PiecewisePolynomial | None = None

    @property
    def is_blocked(self) -> bool:
        """Whether it leads nowhere, because no place after the first can be reached."""
        return len(self.places) < 2


@dataclass(frozen=True, slots=True)
class Segment:
    """One segment of a requested trajectory.

    Attributes:
        duration: Requested duration, [s]; the shortest within the limits if None.
        configuration: Target of a joint segment; shape (n,), [rad or m].
        pose: T_base_tip at the end of a line, a circle or a joint segment to a pose; shape (4, 4).
        via: T_base_tip in between on a circle; shape (4, 4).
        blend_radius: Distance from the end of a line or a circle, along it, at which its blend into the next begins,
            [m]; 0 for none.
        blend_acceleration, blend_time: Between lines, the tip's acceleration [m/s²] or a duration [s] in its place.
        orientation: How a tip path turns: about an axis (on a smooth spline if it passes several orientations), or by
            ZYZ Euler angles on either branch.
        configurations: Waypoints of a joint spline after the start; shape (m, n), [rad or m].
        poses: Waypoints of a Cartesian spline after the start; all of them, if the tip turns along it.
        turn: How the tip turns about an axis of its own along a spline of poses.
        ways: Limits and stated jerk on the way to each of these waypoints, if they have their own, as m segments.
        times: Time of each waypoint, counted from the start of the segment; shape (m,), [s].
        blends: Whether joints pass beside the waypoints on straight lines with parabolic blends, not on a spline.
        stated_jerk: Requested jerk limits, which hold for every law; ∞ where none was requested; shape (n,),
            [rad/s³ or m/s³].
        ends: Rates at both ends of a joint segment, of a law that allows them; at rest if None.
    """

    type: SegmentType
    law: Law
    limits: SegmentLimits
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
    ways: tuple["Segment", ...] = ()
    times: Array | None = None
    boundary: Boundary = "clamped"
    blends: bool = False
    stated_jerk: Array | None = None
    ends: EndRates | None = None
    turn: ToolTurn | None = None


@dataclass(frozen=True, slots=True)
class Following:
    """How the joints follow a path of the tip.

    Attributes:
        task: Constrained directions; the others are free.
        position_tolerance: Largest distance from the path, also between samples, [m].
        orientation_tolerance: Largest angle from the path's orientation, [rad].
        min_singular_value: Smallest singular value of the Jacobian's constrained rows, metres and radians mixed, below
            which a pose counts as near a singularity.
        near_singularity: What to do there: stop, damp the joints and leave the path, or slow down on the exact path.
    """

    task: Task = FULL_POSE
    position_tolerance: float = 1e-4
    orientation_tolerance: float = 1e-3
    min_singular_value: float = 0.01
    near_singularity: NearSingularity = "stop"


@dataclass(frozen=True, slots=True)
class TrajectoryProblem:
    """The request for a trajectory.

    Attributes:
        start: Shape (n,), [rad or m].
        segments: At least one, in order.
        duration: Of the whole, [s]; the shortest within the limits if None.
        compares_timing: Whether to compare uniform and time-optimal timing of each segment.
        tool: Of a path that leaves a turn of the tip open. The last segment is then a spline of all of its poses. If
            there is one before, the joints move to the first pose; else the motion begins there, wherever the start is.
        cell: What nothing of the robot may come near to; contacts do not count if None.
    """

    start: Array
    segments: tuple[Segment, ...]
    following: Following = field(default_factory=Following)
    duration: float | None = None
    compares_timing: bool = False
    tool: FreeTool | None = None
    cell: Cell | None = None


@dataclass(frozen=True, slots=True)
class SegmentReport:
    """The result of a segment, as far as it was completed.

    Attributes:
        index: Of the segment, from 0.
        start_time, end_time: [s].
        length, angle: Of the tip's path, [m], and of its turning, [rad]; None for a joint segment.
        joint_deviation: Deviation from the path where joints were damped.
        blended: Whether the motion passes into the next segment without a stop.
        blend: Blend into the next segment, if the motion gets that far.
    """

    index: int
    type: SegmentType
    law: Law
    start_time: float
    end_time: float
    length: float | None = None
    angle: float | None = None
    joint_deviation: Damping | None = None
    blended: bool = False
    blend: SegmentBlend | None = None
    notes: tuple[str, ...] = ()

    def retimed(self, factor: float = 1.0, start: float = 0.0) -> "SegmentReport":
        """Return the report of the motion in `factor` times its time, and later by `start`, [s]."""
        if factor == 1.0 and start == 0.0:
            return self
        blend = self.blend
        if blend is not None:
            begin, end = start + factor * blend.start_time, start + factor * blend.end_time
            blend = replace(blend, start_time=begin, end_time=end)
        begin, end = start + factor * self.start_time, start + factor * self.end_time
        return replace(self, start_time=begin, end_time=end, blend=blend)


@dataclass(frozen=True, slots=True)
class Trajectory:
    """The result of planning a trajectory.

    Attributes:
        motion: Of the joints, starting at 0 s.
        segments: Those that were completed wholly or in part.
        completed_fraction: Completed fraction; segments count equally, an incomplete one by its completed length.
        failure: Why the trajectory ends early; None if it is complete.
        laws: s(t) of each path of the tip, [m or rad], from its start, with the index of its first segment.
        choice: Of the turns of a tool that a path leaves open.
    """

    motion: PiecewisePolynomial
    segments: tuple[SegmentReport, ...]
    completed_fraction: float
    failure: PlanningFailure | None
    audit: Audit
    timing: tuple[TimingComparison, ...] = ()
    laws: tuple[tuple[int, PiecewisePolynomial], ...] = ()
    choice: ToolChoice | None = None
