"""Joints from one configuration to another, at rest at both ends.

The polynomials lead along the straight line of joint space: q = q_i + s(t) Δq, with one s from 0 to 1 for all joints.
What s may do are the least of the joints' limits over |Δq_j|, so that the least duration is a closed form of three
numbers. In the trapezoid each joint has a profile of its own, and all are slowed to the slowest one, as in the course:
no motion of any shape takes less time, T = max_j T_j, so that it is the time-optimal one too. The jerk-limited motion
is of that kind as well where the line would take longer: where the joints' limits are not in one proportion.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.errors import InvalidField
from gelenk.trajectory.jerk_limited import JerkLimits, at_rest, jerk_limited
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem import MotionLimits
from gelenk.trajectory.time_scaling import QUANTITIES, Limits, uniform_scaling
from gelenk.trajectory.trapezoid import Task, fastest, point_to_point
from gelenk.trajectory.words import Law

SMALLEST, LARGEST = 1e-9, 1e9
"""What a limit can be; positions and durations are at most as large."""
NO_LENGTH = 1e-12
"""A displacement up to which joints stand still, [rad or m]."""
ROUNDING = 2e-10
"""How much shorter than the least a duration may be, in fractions of it: as an answer of ten digits is."""
KEEPS_JERK: Final[frozenset[Law]] = frozenset({"quintic", "septic", "jerk_limited"})
"""Laws without jumps of acceleration, the ends included; they keep limits of jerk."""

_SHORTEST_RAMP = 1e-5
"""Share of a given duration that a trapezoid takes at least to accelerate."""
_LEAST_RAMP = 2e-6
"""Share of its least duration that it takes at least: a double has no digits for less."""
_WORTH = 1e-6
"""Share of the duration for which the straight line is left."""
_MOST = 1e6
"""Limits of s beyond that, in units of the time it would take under one of them alone, are as good as none."""


class _Shape(NamedTuple):
    """s(λ) from 0 to 1 in λ = t/T: its coefficients, lowest power first, and the peaks of its derivatives."""

    coefficients: tuple[float, ...]
    peaks: tuple[float, ...]


_SHAPES: Final[dict[Law, _Shape]] = {
    "cubic": _Shape((0.0, 0.0, 3.0, -2.0), (1.5, 6.0)),
    "quintic": _Shape((0.0, 0.0, 0.0, 10.0, -15.0, 6.0), (1.875, 10.0 / math.sqrt(3.0), 60.0)),
    # s' = 140 y³, s'' = 420 y² (1 - 2λ), s''' = 840 (y - 5y²) with y = λ (1 - λ).
    "septic": _Shape((0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0), (2.1875, 16.8 / math.sqrt(5.0), 52.5)),
}


def point_to_point_motion(
    start: Array, target: Array, law: Law, limits: MotionLimits, duration: float | None = None, *, field: str = ""
) -> PiecewisePolynomial:
    """From rest to rest in the least time that the law takes under the limits, or in a given one.

    - cubic, quintic, septic: T is the largest of c₁Δ/v, √(c₂Δ/a) and, except for the cubic, ∛(c₃Δ/j) of any joint, with
      the peaks c of the law: 1.5, 6; 1.875, 5.7735, 60; 2.1875, 7.5132, 52.5. Acceleration is zero at both ends of a
      quintic, jerk too of a septic.
    - jerk_limited: the least time under limits of velocity, acceleration and jerk, along the straight line where that
      takes no longer.
    - trapezoidal: a trapezoid of each joint, the slowest one's as fast as its limits allow, the others slowed by
      k = T/T_j: v/k, a/k². In a given time each keeps its acceleration and coasts more slowly. No ramp is shorter than
      2e-6 of the time: the acceleration is then less than it may be.
    - time_optimal: the same; in a given time it is slowed as a whole.

    In a given time all but the trapezoid are slowed as a whole. Limits of the tip are not examined.

    Args:
        start: Shape (n,), [rad or m].
        target: Shape (n,).
        law: Of time.
        limits: Of the joints.
        duration: T, [s]; the least if left out.
        field: Of the request that this motion stands for; before the names of its fields in refusals.

    Returns:
        The motion, from time 0 on. Where nothing is to move (≤ 1e-12) it stands still as long as it is to last, and
        for no time in one piece whose two breaks are the same.

    Raises:
        InvalidField: The duration is too short; a number is out of the range that can be reckoned with.
    """
    _check(start, target, limits, duration, field)
    steps = target - start
    if np.abs(steps).max(initial=0.0) <= NO_LENGTH:
        return standing(start, duration or 0.0)
    if law == "trapezoidal":
        return _trapezoid(start, steps, limits, duration, field)
    if law == "time_optimal":
        motion = _trapezoid(start, steps, limits, None, field)
    else:
        motion = _on_line(start, steps, _along_line(law, _bounds(steps, limits)))
        if law == "jerk_limited":
            motion = _beside_line(start, target, limits, motion)
    return motion if duration is None else lasting(motion, duration, kept(law, limits), field)


def standing(configuration: Array, duration: float = 0.0) -> PiecewisePolynomial:
    """Joints of shape (n,) that stand still, [rad or m]."""
    return PiecewisePolynomial(np.array([0.0, duration]), configuration[None, None].copy())


def kept(law: Law, limits: MotionLimits) -> Limits:
    """The limits that a law keeps."""
    return Limits(limits.velocity, limits.acceleration, limits.jerk if law in KEEPS_JERK else None)


def lasting(motion: PiecewisePolynomial, duration: float, limits: Limits, field: str = "") -> PiecewisePolynomial:
    """The same motion in a given time, which has to be no shorter.

    Args:
        motion: The fastest one of its kind, from time 0 on.
        duration: T, [s].
        limits: Limits that it keeps; named in the error where the duration is too short.
        field: What has a duration.

    Raises:
        InvalidField: The duration is too short.
    """
    least = motion.duration
    if duration < least * (1.0 - ROUNDING):
        bound = uniform_scaling(motion, limits).binding
        raise InvalidField(
            named(field, "duration"),
            f"must be at least {least:.10g} s, in which joint {bound.joint + 1} comes to its limit of {bound.quantity}",
        )
    return _ending(motion.scaled(duration / least), duration)


def _ending(motion: PiecewisePolynomial, time: float) -> PiecewisePolynomial:
    """Its last break to the last digit where it is wanted, [s]."""
    return PiecewisePolynomial(np.append(motion.breaks[:-1], time), motion.coefficients)


def named(field: str, name: str) -> str:
    """A field of a part of the request."""
    return f"{field}.{name}" if field else name


class Timings(NamedTuple):
    """One path at two timings.

    Attributes:
        uniform_duration: Of the law, scaled so that it just keeps the limits: the larger one of k_vel and √k_acc times
            1 s, unless jerk asks for more, [s].
        velocity_factor: k_vel of the law lasting 1 s: its largest ratio of a velocity to its limit.
        acceleration_factor: k_acc likewise.
        time_optimal_duration: Of the fastest motion along the same way under both limits, [s].
    """

    uniform_duration: float
    velocity_factor: float
    acceleration_factor: float
    time_optimal_duration: float


def compared_point_to_point(start: Array, target: Array, law: Law, limits: MotionLimits) -> Timings:
    """A law of time scaled uniformly, and the fastest motion along the same way; all zero where nothing is to move.

    The trapezoid leads along a path of its own. Its slowest joint is as fast as its limits allow at all, so that
    nothing is left to be gained.

    Args:
        start: Shape (n,), [rad or m].
        target: Shape (n,).
        law: Of time.
        limits: Of the joints; that of jerk counts for the laws that keep it.

    Raises:
        InvalidField: As for `point_to_point_motion`.
    """
    motion = point_to_point_motion(start, target, law, limits)
    if motion.duration == 0.0:
        return Timings(0.0, 0.0, 0.0, 0.0)
    optimal = motion if law == "trapezoidal" else point_to_point_motion(start, target, "time_optimal", limits)
    return timings(motion, limits, optimal.duration)


def timings(uniform: PiecewisePolynomial, limits: MotionLimits, optimal: float) -> Timings:
    """The timings of a motion of some duration, with the factors that it would need if it lasted 1 s.

    Args:
        uniform: The law, scaled.
        limits: Of the joints.
        optimal: Duration of the fastest motion along the same way, [s].
    """
    in_a_second = uniform.scaled(1.0 / uniform.duration)
    by_velocity, by_acceleration = uniform_scaling(in_a_second, Limits(limits.velocity, limits.acceleration)).bounds
    return Timings(uniform.duration, by_velocity.ratio, by_acceleration.ratio, optimal)


def _check(start: Array, target: Array, limits: MotionLimits, duration: float | None, field: str) -> None:
    """Check that all numbers are small enough for their products."""
    for name, values in (("start", start), ("target", target)):
        wrong = ~(np.abs(values) <= LARGEST)
        if wrong.any():
            raise InvalidField(
                named(field, name), f"joint {int(wrong.argmax()) + 1}: must be of magnitude ≤ {LARGEST:g}"
            )
    check_limits(limits, field)
    check_duration(duration, field)


def check_limits(limits: MotionLimits, field: str = "") -> None:
    """Check that limits are usable numbers.

    Raises:
        InvalidField: One is not.
    """
    for quantity in QUANTITIES:
        values = getattr(limits, quantity)
        wrong = ~((values >= SMALLEST) & (values <= LARGEST))
        if wrong.any():
            raise InvalidField(
                named(field, f"limits.joint_{quantity}"),
                f"joint {int(wrong.argmax()) + 1}: must be a number from {SMALLEST:g} to {LARGEST:g}",
            )


def check_duration(duration: float | None, field: str = "") -> None:
    """Check that a duration is a usable number.

    Raises:
        InvalidField: It is not.
    """
    if duration is not None and not 0.0 < duration <= LARGEST:
        raise InvalidField(named(field, "duration"), f"must be greater than 0 s and at most {LARGEST:g} s")


def _bounds(steps: Array, limits: MotionLimits) -> tuple[float, float, float]:
    """The limits of s: velocity, acceleration and jerk, [1/s, 1/s², 1/s³]."""
    moves = steps != 0.0
    sizes = np.abs(steps[moves])
    velocity, acceleration, jerk = (float((getattr(limits, name)[moves] / sizes).min()) for name in QUANTITIES)
    return velocity, acceleration, jerk


def _on_line(start: Array, steps: Array, s: PiecewisePolynomial) -> PiecewisePolynomial:
    """The joints on the straight line, at s(t)."""
    coefficients = s.coefficients * steps
    coefficients[:, 0] += start
    return PiecewisePolynomial(s.breaks, coefficients)


def _beside_line(
    start: Array, target: Array, limits: MotionLimits, on_line: PiecewisePolynomial
) -> PiecewisePolynomial:
    """The jerk-limited motion whose joints only end together, where that takes less time than the one on the line."""
    bounds = JerkLimits(limits.velocity, limits.acceleration, limits.jerk)
    try:
        found = jerk_limited(at_rest(start), at_rest(target), bounds, synchronization="time")
    except InvalidField:
        # Numbers too many powers of ten apart for it; the line's have one unit.
        return on_line
    return found if found.duration < on_line.duration * (1.0 - _WORTH) else on_line


def _along_line(law: Law, bounds: tuple[float, float, float]) -> PiecewisePolynomial:
    """The fastest s from 0 to 1; one coordinate."""
    if law == "jerk_limited":
        return _jerk_limited(bounds)
    shape = _SHAPES[law]
    duration = max(
        (peak / bound) ** (1.0 / k) for k, (peak, bound) in enumerate(zip(shape.peaks, bounds, strict=False), 1)
    )
    coefficients = np.array(shape.coefficients) / duration ** np.arange(len(shape.coefficients))
    return PiecewisePolynomial(np.array([0.0, duration]), coefficients[None, :, None])


def _jerk_limited(bounds: tuple[float, float, float]) -> PiecewisePolynomial:
    """In units of the time it would take under the tightest limit alone, where all numbers are of common size."""
    unit = max(bound ** (-1.0 / k) for k, bound in enumerate(bounds, 1))
    units = [np.array([min(bound * unit**k, _MOST)]) for k, bound in enumerate(bounds, 1)]
    return jerk_limited(at_rest(np.zeros(1)), at_rest(np.ones(1)), JerkLimits(*units)).scaled(unit)


def _trapezoid(
    start: Array, steps: Array, limits: MotionLimits, duration: float | None, field: str
) -> PiecewisePolynomial:
    """Each joint on its own profile, in step with the slowest or lasting a given time."""
    most = (1.0 / _LEAST_RAMP - 1.0) * limits.velocity**2
    tasks = [
        Task(float(L), 0.0, 0.0, float(v), min(float(a), float(high) / abs(float(L))) if L else float(a))
        for L, v, a, high in zip(steps, limits.velocity, limits.acceleration, most, strict=True)
    ]
    try:
        if duration is not None and duration > max(fastest(task).duration for task in tasks) * (1.0 + ROUNDING):
            return _ending(point_to_point(start, _in_long_time(tasks, duration), duration).motion, duration)
        motion = point_to_point(start, tasks).motion
    except InvalidField as error:
        raise InvalidField(named(field, error.field), error.reason) from error
    return motion if duration is None else lasting(motion, duration, kept("trapezoidal", limits), field)


def _in_long_time(tasks: Sequence[Task], duration: float) -> list[Task]:
    """With smaller accelerations where joints would reach their speed too soon for doubles to tell when."""
    room = _SHORTEST_RAMP * (1.0 - _SHORTEST_RAMP) * duration**2
    return [
        replace(task, acceleration=min(task.acceleration, abs(task.distance) / room)) if task.distance else task
        for task in tasks
    ]
