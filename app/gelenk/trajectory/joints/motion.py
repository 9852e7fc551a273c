"""Joint motions from one configuration to another, at rest at both ends.

The polynomials lead along the straight line in joint space: q = q_i + s(t) Δq, with one s from 0 to 1 for all joints.
The limits of s are the smallest of the joints' limits over |Δq_j|. In the trapezoid each joint has its own profile, and
all are slowed down to the slowest one, as in the course: T = max_j T_j. No motion of any shape takes less time, so it
is also the time-optimal one. Jerk-limited joints are slowed down likewise, each with its own profile, if the line would
take longer, as when their limits are not in one proportion.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.joints.fastest import NO_LENGTH, fastest_motion, shape_of
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.laws.time_scaling import LARGEST, ScalingLimits, check_limits, uniform_scaling
from gelenk.trajectory.laws.trapezoid import JointMove, point_to_point
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.path_geometry import geometry_of
from gelenk.trajectory.problem.parts import standing
from gelenk.trajectory.problem.problem import SegmentLimits
from gelenk.trajectory.timing.timing import Timings
from gelenk.trajectory.timing.torque_constraints import optimal_within, torque_factor

ROUNDING = 2e-10
"""Allowed relative shortfall of a duration below the least one, because answers are rounded to ten digits."""

_SHORTEST_RAMP = 1e-5
"""Least acceleration time of a trapezoid, as a share of a given duration."""


def point_to_point_motion(
    start: Array, target: Array, law: Law, limits: SegmentLimits, duration: float | None = None
) -> PiecewisePolynomial:
    """Return the motion from rest to rest, in the least time of a law under the limits or in a given time.

    - cubic, quintic, septic: T is the largest of c₁Δ/v, √(c₂Δ/a) and, except for the cubic, ∛(c₃Δ/j) of any joint, with
      the peaks c of the law: 1.5, 6; 1.875, 5.7735, 60; 2.1875, 7.5132, 52.5. Acceleration is zero at both ends of a
      quintic, and jerk too for a septic.
    - jerk_limited: the least time under limits of velocity, acceleration and jerk.
    - trapezoidal: the slowest joint is as fast as its limits allow, the others are slowed down by k = T/T_j: v/k, a/k².
      In a given time each keeps its acceleration and coasts more slowly. No ramp is shorter than 2e-6 of the time; if
      it would be, the acceleration is reduced.
    - time_optimal: the same, except in a given time, or where torques exceed their limits: then it is slowed down, or
      the fastest along the straight line in joint space if that takes less time.

    In a given time all laws but the trapezoid are slowed down as a whole. Tip limits are not considered.

    Args:
        start, target: Shape (n,), [rad or m].
        duration: T, [s]; the least if None.

    Returns:
        The motion, from time 0 on. If nothing moves (≤ 1e-12), it stands still for the given duration; without one, it
        is one piece whose two breaks are equal.

    Raises:
        InvalidField: The duration is too short, or a number is out of the supported range.
    """
    for name, values in (("start", start), ("target", target)):
        wrong = ~(np.abs(values) <= LARGEST)
        if wrong.any():
            raise InvalidField(name, f"joint {int(wrong.argmax()) + 1}: must be of magnitude ≤ {LARGEST:g}")
    check_limits(limits.joints)
    check_duration(duration)
    steps = target - start
    if np.abs(steps).max(initial=0.0) <= NO_LENGTH:
        return standing(start, duration or 0.0)
    motion = PiecewisePolynomial(*fastest_motion(start, target, limits.joints, shape_of(law)))
    if law == "time_optimal" and limits.torque is not None:
        motion = _within_torques(start, steps, limits, limits.torque, motion)
    if duration is None:
        return motion
    if law == "trapezoidal":
        return _in_time(start, steps, limits, motion, duration)
    return lasting(motion, duration, law, limits)


def _within_torques(
    start: Array, steps: Array, limits: SegmentLimits, torque: TorqueLimits, motion: PiecewisePolynomial
) -> PiecewisePolynomial:
    """Return the motion; where its torques exceed their limits, it or the one on the straight line, slower."""
    factor = torque_factor(motion, torque)
    if factor == 1.0:
        return motion
    line = PiecewisePolynomial(np.array([0.0, 1.0]), np.stack((start, steps))[None])
    straight = optimal_within(geometry_of(None, line, limits)).motion
    return min(motion.scaled(factor), straight, key=lambda one: one.duration)


def kept_limits(law: Law, limits: SegmentLimits) -> ScalingLimits:
    """Return the limits that a law keeps."""
    return ScalingLimits(limits.velocity, limits.acceleration, limits.jerk if LAWS[law].keeps_jerk else None)


def lasting(motion: PiecewisePolynomial, duration: float, law: Law, limits: SegmentLimits) -> PiecewisePolynomial:
    """Slow the fastest motion with a law down to a duration, [s]; `InvalidField` names the limit that forbids it."""
    least = motion.duration
    if duration < least * (1.0 - ROUNDING):
        bound = uniform_scaling(motion, kept_limits(law, limits)).binding
        raise InvalidField(
            "duration",
            f"must be at least {least:.10g} s, when joint {bound.joint} reaches its limit of {bound.quantity}",
        )
    return motion.lasting(duration)


def compared_point_to_point(start: Array, target: Array, law: Law, limits: SegmentLimits) -> Timings:
    """Compare a uniformly scaled law with the fastest motion along the same path; all zero if nothing moves.

    The trapezoid has its own path. Its slowest joint is already as fast as its limits allow, so nothing can be gained.
    """
    limits = replace(limits, torque=None)
    motion = point_to_point_motion(start, target, law, limits)
    if motion.duration == 0.0:
        return Timings(0.0, 0.0, 0.0, 0.0)
    optimal = motion if law == "trapezoidal" else point_to_point_motion(start, target, "time_optimal", limits)
    return timings(motion, limits, optimal.duration)


def timings(uniform: PiecewisePolynomial, limits: SegmentLimits, optimal: float) -> Timings:
    """Compare a motion by a scaled law with the fastest one along its path, which lasts `optimal`, [s]."""
    in_a_second = uniform.scaled(1.0 / uniform.duration)
    bounds = uniform_scaling(in_a_second, ScalingLimits(limits.velocity, limits.acceleration)).bounds
    return Timings(uniform.duration, bounds[0].ratio, bounds[1].ratio, optimal)


def check_duration(duration: float | None) -> None:
    """Refuse a duration, [s], that is not a usable number, with `InvalidField`."""
    if duration is not None and not 0.0 < duration <= LARGEST:
        raise InvalidField("duration", f"must be greater than 0 s and at most {LARGEST:g} s")


def _in_time(
    start: Array, steps: Array, limits: SegmentLimits, motion: PiecewisePolynomial, duration: float
) -> PiecewisePolynomial:
    """Return the trapezoid of a given duration, [s], with the accelerations of the limits; `motion` is the fastest."""
    if not duration > motion.duration * (1.0 + ROUNDING):
        return lasting(motion, duration, "trapezoidal", limits)
    tasks = [
        JointMove(float(L), 0.0, 0.0, float(v), float(a))
        for L, v, a in zip(steps, limits.velocity, limits.acceleration, strict=True)
    ]
    found = point_to_point(start, _in_long_time(tasks, duration), duration).motion
    return PiecewisePolynomial(np.append(found.breaks[:-1], duration), found.coefficients)


def _in_long_time(tasks: Sequence[JointMove], duration: float) -> list[JointMove]:
    """Reduce the acceleration of joints whose ramps would be too short for doubles to resolve."""
    room = _SHORTEST_RAMP * (1.0 - _SHORTEST_RAMP) * duration**2
    return [
        replace(task, acceleration=min(task.acceleration, abs(task.distance) / room)) if task.distance else task
        for task in tasks
    ]
