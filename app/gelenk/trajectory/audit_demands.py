"""What a motion has to keep to: limits of joints and tip, its ends, its path, how smooth it is."""

import math
from dataclasses import dataclass, field

from gelenk.kinematics.ik.task import FULL_POSE, Task
from gelenk.model.arrays import Array
from gelenk.trajectory.audit_tip import PathOfTime


@dataclass(frozen=True, slots=True)
class JointLimits:
    """What each joint may do; infinite, or None for all, where there is no limit; shape (n,) each.

    Attributes:
        velocity: [rad/s or m/s].
        acceleration: [rad/s² or m/s²].
        jerk: [rad/s³ or m/s³].
        lower: Position, [rad or m]; the chain's if left out.
        upper: Likewise.
    """

    velocity: Array | None = None
    acceleration: Array | None = None
    jerk: Array | None = None
    lower: Array | None = None
    upper: Array | None = None


@dataclass(frozen=True, slots=True)
class TipLimits:
    """The limits of the tip; infinite where there is none."""

    speed: float = math.inf
    angular_speed: float = math.inf
    acceleration: float = math.inf
    angular_acceleration: float = math.inf


@dataclass(frozen=True, slots=True)
class Ends:
    """Where a motion is to begin and end; None leaves it open. At rest unless velocities say otherwise.

    Attributes:
        start: Configuration; shape (n,), [rad or m].
        end: Likewise.
        start_velocity: Zero if left out; shape (n,), [rad/s or m/s].
        end_velocity: Likewise.
        start_acceleration: Open if left out; shape (n,), [rad/s² or m/s²].
        end_acceleration: Likewise.
    """

    start: Array | None = None
    end: Array | None = None
    start_velocity: Array | None = None
    end_velocity: Array | None = None
    start_acceleration: Array | None = None
    end_acceleration: Array | None = None


@dataclass(frozen=True, slots=True)
class Stretch:
    """Some time of a motion in which the tip has limits of its own, beside those that hold everywhere.

    Attributes:
        begin: [s].
        end: [s].
        tip: The limits.
    """

    begin: float
    end: float
    tip: TipLimits


@dataclass(frozen=True, slots=True)
class WayError:
    """By how much ratios to limits differ at most from those of the exact path of the tip at the same law of time.

    Attributes:
        velocity: Of the joints; ∞ where it is not known.
        acceleration: Likewise.
        jerk: Likewise.
    """

    velocity: float
    acceleration: float
    jerk: float


@dataclass(frozen=True, slots=True)
class Demands:
    """The limits that a motion must keep, and the path it must follow.

    Attributes:
        joints: Limits of the joints.
        tip: Limits of the tip.
        ends: Where it begins and ends.
        path: Pose wanted at each time; none if left out.
        task: Directions in which it, and nearness to a singularity, counts.
        path_tolerance: Allowed distance from it, [m].
        orientation_tolerance: Allowed angle from it, [rad].
        continuous: Derivatives up to this order do not jump; 1 is C¹.
        stretches: Of time in which the tip has limits of its own; pieces of the motion begin and end there.
        keeps_jerk: Whether limits of jerk are kept, or only compared with.
        stated_jerk: Limits of jerk that are kept even so, where acceleration does not jump; shape (n,),
            [rad/s³ or m/s³].
        way_error: How far the planned motion is from the exact path; None where it follows none.
        tolerance: Allowed excess over a limit, relatively, and error of ends, relative to the largest value of that
            derivative or to 1; likewise of jumps of position, ten times as much of those of velocity, and so on.
    """

    joints: JointLimits = field(default_factory=JointLimits)
    tip: TipLimits = field(default_factory=TipLimits)
    ends: Ends = field(default_factory=Ends)
    path: PathOfTime | None = None
    task: Task = FULL_POSE
    path_tolerance: float = 1e-4
    orientation_tolerance: float = 1e-3
    continuous: int = 1
    stretches: tuple[Stretch, ...] = ()
    keeps_jerk: bool = True
    stated_jerk: Array | None = None
    way_error: WayError | None = None
    tolerance: float = 1e-9
