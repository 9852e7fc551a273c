"""Results of planning that are part of an answer as they are, without the code that computes them."""

from dataclasses import dataclass

from gelenk.robot.result import Result
from gelenk.trajectory.audit.result import Moment
from gelenk.trajectory.audit.words import Law, StopReason


@dataclass(frozen=True, slots=True)
class Damping(Result):
    """How far the tip left its path because its joints were damped.

    Attributes:
        distance: At most, [m].
        angle: At most, [rad].
    """

    distance: float
    angle: float


@dataclass(frozen=True, slots=True)
class SegmentBlend(Result):
    """How a segment was blended into the next.

    Attributes:
        radius: Distance from the corner at which the motion leaves the segment, [m].
        start_time: When it begins, [s].
        end_time: When it ends, [s].
        acceleration: Limit of the tip's in it, [m/s²]; null where `blend_radius` was given, and only the limits of the
            segments count.
    """

    radius: float
    start_time: float
    end_time: float
    acceleration: float | None


@dataclass(frozen=True, slots=True)
class PlanningFailure(Result):
    """Why a trajectory ends early.

    Attributes:
        reason: Why the motion ends before its goal.
        segment: Index of the segment that could not be completed, from 0.
        time: Where the motion ends, [s].
        position: Tip position in the base frame where it could not go on, [m].
        joint: The joint at its limit.
        detail: An explanation in one sentence, with numbers.
        first_contact: With `collision`, the moment at which the motion as requested would first come nearer than it
            may; the motion ends before. Null if the pose that a `joint` segment leads to is reached in contact only.
        nearest: With `collision`, the moment at which the motion as requested would come nearest, or deepest; likewise.
    """

    reason: StopReason
    segment: int
    time: float
    position: tuple[float, ...]
    joint: str | None
    detail: str
    first_contact: Moment | None = None
    nearest: Moment | None = None


@dataclass(frozen=True, slots=True)
class TimingComparison(Result):
    """Two timings of one path, without limits of torque.

    Attributes:
        segments: Indices of the segments, from 0; several if they are blended.
        law: The law that is scaled uniformly.
        uniform_duration: The law, scaled so that some limit is just reached, [s].
        velocity_factor: k_vel, the largest ratio of a velocity to its limit if the law lasts 1 s; no unit.
        acceleration_factor: k_acc, likewise of accelerations; no unit. The law's duration is the larger one of k_vel
            and √k_acc in seconds, longer where the limits of jerk ask for it.
        time_optimal_duration: Of the fastest motion along the same path, [s].
    """

    segments: tuple[int, ...]
    law: Law
    uniform_duration: float
    velocity_factor: float
    acceleration_factor: float
    time_optimal_duration: float


@dataclass(frozen=True, slots=True)
class ToolChoice(Result):
    """How the tool is turned along a `path`, and on which branch, at each of its poses as far as they are reached.

    Attributes:
        joint_travel: Σ ‖Δq_j/v_j‖ along the path, with the joints' velocity limits v, [s]: no sequence of the turns and
            branches tried has less, with one of seven joints held; the turns in between were then used.
        turns: Of the tip about its free axis, counted on beyond ±π, [rad].
        branches: Names of the choices that make up the branch, as in `ik`.
        joint_positions: One row per pose, [rad or m].
    """

    joint_travel: float
    turns: tuple[float, ...]
    branches: tuple[dict[str, str | int], ...]
    joint_positions: tuple[tuple[float, ...], ...]
