"""Demands on a motion: limits of joints and tip, its ends, its path, and its smoothness."""

import math
from dataclasses import dataclass, field, replace

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.result import PathError
from gelenk.trajectory.audit.tip import PathOfTime
from gelenk.trajectory.audit.torques import TorqueLimits


@dataclass(frozen=True, slots=True)
class JointLimits:
    """Limits of each joint, of shape (n,) each; infinite for a joint without a limit, None if no joint has one.

    Attributes:
        velocity, acceleration, jerk: [rad or m per s, s², s³].
        lower, upper: Of the position, [rad or m]; the chain's limit if None.
    """

    velocity: Array | None = None
    acceleration: Array | None = None
    jerk: Array | None = None
    lower: Array | None = None
    upper: Array | None = None


@dataclass(frozen=True, slots=True)
class TipLimits:
    """Limits of the tip, [m/s, rad/s, m/s², rad/s²]; infinite if unlimited."""

    speed: float = math.inf
    angular_speed: float = math.inf
    acceleration: float = math.inf
    angular_acceleration: float = math.inf


@dataclass(frozen=True, slots=True)
class Zone:
    """A part of a motion or a path, between two times or places, that has limits besides those everywhere.

    Attributes:
        joints: Limits of velocity, acceleration and jerk, if any; shape (3, n), [rad or m per s, s², s³].
        torque, stated_jerk: As in `Demands`.
    """

    begin: float
    end: float
    tip: TipLimits
    joints: Array | None = None
    torque: TorqueLimits | None = None
    stated_jerk: Array | None = None

    def between(self, begin: float, end: float) -> "Zone":
        """Return the same limits between other times or places."""
        return replace(self, begin=begin, end=end)


@dataclass(frozen=True, slots=True)
class Demands:
    """The limits that a motion must keep, and the path it must follow.

    Attributes:
        ends: Configurations at the start and the end, shape (n,) each, [rad or m]; None leaves them open.
        path: Demanded pose at each time; None if the tip is free.
        task: Directions that count for the path and for the smallest singular value.
        path_tolerance: Allowed distance from the path, [m].
        orientation_tolerance: Allowed angle from the path's orientation, [rad].
        continuous: Order up to which derivatives must not jump; 1 means C¹.
        zones: Time intervals with their own limits; pieces of the motion begin and end at their bounds.
        keeps_jerk: Whether exceeding a jerk limit fails the audit; otherwise jerk is only compared.
        stated_jerk: Jerk limits enforced within pieces even if `keeps_jerk` is False; shape (n,), [rad/s³ or m/s³].
        way_error: How far the planned motion is from the exact path; None if it follows no path.
        tolerance: Allowed relative excess over a limit, and allowed error at the ends, relative to the derivative's
            peak or to 1; also the allowed jump of position, ten times as much for velocity, and so on.
        end_rates: Velocities, and accelerations if they count, at the start and the end, shape (1 or 2, n) each;
            if None the motion rests at both.
        torque: Limits of the joints' torques; None if torques do not count.
    """

    joints: JointLimits = field(default_factory=JointLimits)
    tip: TipLimits = field(default_factory=TipLimits)
    ends: tuple[Array, Array] | None = None
    path: PathOfTime | None = None
    task: Task = FULL_POSE
    path_tolerance: float = 1e-4
    orientation_tolerance: float = 1e-3
    continuous: int = 1
    zones: tuple[Zone, ...] = ()
    keeps_jerk: bool = True
    stated_jerk: Array | None = None
    way_error: PathError | None = None
    tolerance: float = 1e-9
    end_rates: tuple[Array, Array] | None = None
    torque: TorqueLimits | None = None
