"""Trapezoidal velocity profiles (accelerate, coast, brake) of one or several synchronised joints.

A profile goes from v_i to a coasting velocity v_p and on to v_f, always with the full acceleration. In the shortest
time v_p = ±min(v_max, √(±a L + (v_i² + v_f²)/2)); there is no coast if the root is the smaller of the two. The sign is
that of the distance, unless v_i and v_f already carry the joint too far: then it has to turn back, which is refused
unless it is allowed. In a given time the acceleration is kept, and v_p follows from the distance, which increases
monotonically with v_p.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.phases import Phase, of_phases
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_ROUNDING = 1e-12
_MOST = 1e30
"""Ratio above which a refusal does not suggest an acceleration."""


@dataclass(frozen=True, slots=True)
class JointMove:
    """The motion required of one joint, signed along its axis.

    Attributes:
        distance: L, [rad or m].
        start_velocity, end_velocity: v_i and v_f, [rad/s or m/s].
        max_velocity: v_max > 0, at least |v_i| and |v_f|; infinite for no limit, [rad/s or m/s].
        acceleration: a > 0, [rad/s² or m/s²].
    """

    distance: float
    start_velocity: float
    end_velocity: float
    max_velocity: float
    acceleration: float

    @property
    def is_at_rest(self) -> bool:
        """Whether the joint starts and ends at rest, as in the course."""
        return self.start_velocity == 0.0 == self.end_velocity


@dataclass(frozen=True, slots=True)
class Profile:
    """A velocity profile that goes from v_i to v_p, stays there, and goes on to v_f.

    Attributes:
        start_velocity, peak_velocity, end_velocity: v_i, v_p and v_f, [rad/s or m/s].
        acceleration: Magnitude of the acceleration in the first and the last phase, [rad/s² or m/s²].
        first, coast, last: Durations of the phases, [s]; the coast may be 0.
    """

    start_velocity: float
    peak_velocity: float
    end_velocity: float
    acceleration: float
    first: float
    coast: float
    last: float

    @property
    def duration(self) -> float:
        """Total duration of the three phases, [s]."""
        return self.first + self.coast + self.last

    @property
    def reverses(self) -> bool:
        """Whether the joint reverses its direction."""
        return max(self._velocities()) > 0.0 > min(self._velocities())

    def phases(self) -> tuple[Phase, Phase, Phase]:
        """Return the duration, [s], and the signed acceleration of each phase."""
        v_i, v_p, v_f = self._velocities()
        rise, fall = math.copysign(self.acceleration, v_p - v_i), math.copysign(self.acceleration, v_f - v_p)
        return (self.first, rise), (self.coast, 0.0), (self.last, fall)

    def slowed(self, factor: float) -> "Profile":
        """Return the same motion in k = `factor` times the time: v/k, a/k²."""
        v_i, v_p, v_f = (velocity / factor for velocity in self._velocities())
        times = (self.first * factor, self.coast * factor, self.last * factor)
        return Profile(v_i, v_p, v_f, self.acceleration / factor**2, *times)

    def _velocities(self) -> tuple[float, float, float]:
        return self.start_velocity, self.peak_velocity, self.end_velocity


def fastest(task: JointMove) -> Profile:
    """Return the profile of the shortest time; it turns back if it cannot go straight."""
    L, a, v_i, v_f = task.distance, task.acceleration, task.start_velocity, task.end_velocity
    # Signed distance from v_i straight to v_f.
    direct = (v_i + v_f) * abs(v_f - v_i) / (2.0 * a)
    if abs(L - direct) <= _ROUNDING * max(abs(L), abs(direct)):
        sign = math.copysign(1.0, v_i + v_f)
    else:
        sign = math.copysign(1.0, L - direct)
    squared = max(sign * a * L + 0.5 * (v_i**2 + v_f**2), 0.0)
    without_limit = max(math.sqrt(squared), sign * v_i, sign * v_f)
    speed = min(without_limit, task.max_velocity)
    first, last = (speed - sign * v_i) / a, (speed - sign * v_f) / a
    coast = 0.0
    if without_limit > task.max_velocity:
        coast = (squared - speed**2) / (a * speed)
    return Profile(v_i, sign * speed, v_f, a, first, max(coast, 0.0), last)


def lasting(task: JointMove, duration: float) -> Profile | None:
    """Return the profile of a given duration, [s], with the task's acceleration; None if it does not exist."""
    low, high = sorted((task.start_velocity, task.end_velocity))
    L, a = task.distance, task.acceleration
    spread = (high - low) / a
    if duration < spread * (1.0 - _ROUNDING):
        return None
    gap = 0.5 * (high - low) * spread
    if high * duration - gap <= L:
        velocity = _beyond(L, low, high, a, duration)
    elif low * duration + gap >= L:
        velocity = _beyond(-L, -high, -low, a, duration)
        velocity = None if velocity is None else -velocity
    else:
        velocity = (L - 0.5 * (high + low) * spread) / (duration - spread)
    if velocity is None or abs(velocity) > task.max_velocity * (1.0 + _ROUNDING):
        return None
    first, last = abs(velocity - task.start_velocity) / a, abs(task.end_velocity - velocity) / a
    coast = max(duration - first - last, 0.0)
    return Profile(task.start_velocity, velocity, task.end_velocity, a, first, coast, last)


def _beyond(L: float, low: float, high: float, a: float, duration: float) -> float | None:
    """Return the coasting velocity above both end velocities, the smaller root of a quadratic; None without a root."""
    total = a * duration + low + high
    constant = a * L + 0.5 * (low**2 + high**2)
    discriminant = total**2 - 4.0 * constant
    if discriminant < -_ROUNDING * total**2:
        return None
    root = math.sqrt(max(discriminant, 0.0))
    return max(2.0 * constant / (total + root) if total > 0.0 else 0.5 * (total - root), high)


@dataclass(frozen=True, slots=True)
class PointToPoint:
    """A motion from one configuration to another in which all joints start and end together.

    Attributes:
        profiles: Profile of each joint in this motion.
        own: Fastest profile of each joint by itself.
        factors: k = T/T_j of each joint whose own profile was slowed down; None if it was planned for the duration.
    """

    motion: PiecewisePolynomial
    profiles: tuple[Profile, ...]
    own: tuple[Profile, ...]
    factors: tuple[float | None, ...]


def point_to_point(
    starts: Array, tasks: Sequence[JointMove], duration: float | None = None, *, may_reverse: bool = False
) -> PointToPoint:
    """Plan trapezoidal profiles for all joints, synchronised with the slowest or lasting a given time.

    When synchronised with the slowest, a joint that starts and ends at rest is slowed uniformly by k = T/T_j, as in the
    course: v/k, a/k². This would change nonzero end velocities, so a joint that has them keeps its acceleration and
    coasts more slowly. So do all joints if the duration is given.

    Args:
        starts: Initial positions; shape (n,), [rad or m].
        duration: T, [s]; by default that of the slowest joint.
        may_reverse: Whether a joint may turn back if it cannot go straight.

    Raises:
        InvalidField: The end velocities are impossible with this distance and these limits, or the duration is too
            short, or too long for a joint that cannot go so slowly.
    """
    for j, task in enumerate(tasks):
        _check(task, j, may_reverse)
    own = tuple(fastest(task) for task in tasks)
    slowest = max(profile.duration for profile in own)
    end = slowest if duration is None else duration
    for j, profile in enumerate(own):
        if end < profile.duration * (1.0 - _ROUNDING):
            raise InvalidField("duration", f"joint {j + 1} needs at least {profile.duration:.10g} s")
    found = [
        _in_step(task, one, j, end, duration is None) for j, (task, one) in enumerate(zip(tasks, own, strict=True))
    ]
    profiles = tuple(profile for profile, _ in found)
    if not may_reverse:
        for j, (task, profile) in enumerate(zip(tasks, profiles, strict=True)):
            _check_straight(task, profile, j)
    motion = of_phases(
        starts, np.array([task.start_velocity for task in tasks]), [profile.phases() for profile in profiles]
    )
    return PointToPoint(motion, profiles, own, tuple(factor for _, factor in found))


def _in_step(task: JointMove, own: Profile, joint: int, end: float, may_slow: bool) -> tuple[Profile, float | None]:
    """Return a joint's profile of the common duration, and the factor by which its own one was slowed, if it was."""
    if abs(end - own.duration) <= _ROUNDING * end:
        return own, 1.0
    if may_slow and task.is_at_rest:
        if task.distance == 0.0:
            return Profile(0.0, 0.0, 0.0, 0.0, 0.0, end, 0.0), None
        factor = end / own.duration
        return own.slowed(factor), factor
    profile = lasting(task, end)
    if profile is None:
        raise InvalidField(
            "duration",
            f"joint {joint + 1} cannot keep its end velocities over {end:.10g} s: give another duration, smaller end "
            "velocities, or another acceleration",
        )
    return profile, None


def _check(task: JointMove, joint: int, may_reverse: bool) -> None:
    name = f"joint {joint + 1}"
    for field, velocity in (("start_velocity", task.start_velocity), ("end_velocity", task.end_velocity)):
        if abs(velocity) > task.max_velocity:
            raise InvalidField(field, f"{name}: {velocity:.10g} is beyond the limit of {task.max_velocity:.10g}")
        if velocity * task.distance < 0.0 and not may_reverse:
            raise InvalidField(field, f"{name}: {velocity:.10g} leads away from the target: set `may_reverse` for that")
    L, a = abs(task.distance), task.acceleration
    v_i, v_f = abs(task.start_velocity), abs(task.end_velocity)
    needed = abs(v_i**2 - v_f**2)
    if may_reverse or needed <= 2.0 * a * L * (1.0 + _ROUNDING):
        return
    lowest = math.sqrt(max(max(v_i, v_f) ** 2 - 2.0 * a * L, 0.0))
    highest = math.sqrt(min(v_i, v_f) ** 2 + 2.0 * a * L)
    faster, slower = ("start", "end") if v_i > v_f else ("end", "start")
    acceleration = f"an acceleration of at least {needed / (2.0 * L):.10g}, " if needed <= _MOST * L else ""
    raise InvalidField(
        f"{faster}_velocity",
        f"{name}: from {v_i:.10g} to {v_f:.10g} it needs a distance of |v_i² - v_f²|/2a = {needed / (2.0 * a):.10g}, "
        f"and there is {L:.10g}. Feasible: {acceleration}a speed of at most {highest:.10g} at the {faster} or of at "
        f"least {lowest:.10g} at the {slower}; or `may_reverse`, to go beyond and come back",
    )


def _check_straight(task: JointMove, profile: Profile, joint: int) -> None:
    if profile.reverses:
        v_i, v_f, a = task.start_velocity, task.end_velocity, task.acceleration
        slowest = math.sqrt(max(0.5 * (v_i**2 + v_f**2) - a * abs(task.distance), 0.0))
        longest = (abs(v_i) + abs(v_f) - 2.0 * slowest) / a
        raise InvalidField(
            "duration",
            f"joint {joint + 1} with its end velocities takes at most {longest:.10g} s without turning back, and the "
            f"motion takes {profile.duration:.10g} s",
        )
