"""Joint motion through waypoints along a cubic spline, at rest at both ends.

A `clamped` or `assigned` spline is at rest at its ends by itself: it is a motion in time. Another spline is a
path q(u), and a time law s(t) leads from rest to rest along it, q(s(t)). Meaning of the laws:

- `cubic`, `trapezoidal` on a clamped or assigned spline: the spline in time, all times multiplied by the k that just
  keeps the limits of velocity and acceleration. (Since q' = 0 at the ends, the limits would let a trapezoid along
  the path reach its speed at once.) On other splines: that law along the path.
- `quintic`, `septic`, `jerk_limited`: that law along the path, which also keeps jerk limits.
- `time_optimal`: the fastest motion along the path under the limits of velocity and acceleration.

With `times` a clamped or assigned spline takes exactly these; they are then the time law. Laws whose promise they
cannot keep are refused: `time_optimal` always, and `jerk_limited` on a clamped spline, whose acceleration jumps at both
ends.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.joints.excess import first_limit_excess
from gelenk.trajectory.joints.motion import (
    ROUNDING,
    Timings,
    check_duration,
    check_limits,
    kept,
    lasting,
    named,
    standing,
    timings,
)
from gelenk.trajectory.joints.waypoints import Knots, check_closed, check_within, knots
from gelenk.trajectory.laws.time_scaling import ScalingLimits, uniform_scaling
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.problem.problem import Segment
from gelenk.trajectory.timing.time_optimal import time_optimal
from gelenk.trajectory.timing.timing import compared, timed

_AT_REST = ("clamped", "assigned")
"""Boundaries of splines that are at rest at both ends."""
_SCALED = ("cubic", "trapezoidal")
"""Laws for which such a spline is the motion itself, all times multiplied by one factor."""
_STILL = 1e-12
"""Largest q' at an end that counts as rest, in fractions of the steepest step."""


def spline_motion(start: Array, segment: Segment, chain: Chain, *, field: str = "") -> PiecewisePolynomial:
    """Return the motion through the waypoints of a segment; the module explains its law, times and boundary.

    Between waypoints a spline can exceed joint limits: check with `first_limit_excess`.

    Args:
        start: The first knot; shape (n,), [rad or m].
        segment: A segment with `configurations`.
        chain: The moving chain.
        field: Field of the segment; prefixes the names of its fields in errors.

    Returns:
        The motion from time 0 on, at rest at both ends.

    Raises:
        InvalidField: There is no such spline, its times or duration are impossible, or a waypoint is outside limits.
        TooLarge: It has too many pieces for the fastest motion.
    """
    points = _checked(start, segment, chain, field)
    if segment.times is not None:
        return _at_given_times(points, segment, field)
    motion = _fastest(_spline(points, segment), segment, field)
    if segment.duration is None:
        return motion
    return lasting(motion, segment.duration, kept(segment.law, segment.limits), field)


def spline_path(start: Array, segment: Segment, chain: Chain, *, field: str = "") -> PiecewisePolynomial:
    """Return the spline of a segment without its time law: q(u), with knots at `times` or, without them, spaced.

    Args:
        start: The first knot; shape (n,), [rad or m].
        segment: A segment with `configurations`.
        chain: The moving chain.
        field: Field of the segment; prefixes the names of its fields in errors.

    Raises:
        InvalidField: There is no such spline.
    """
    return _spline(_checked(start, segment, chain, field), segment)


def compared_spline(start: Array, segment: Segment, chain: Chain, *, field: str = "") -> Timings:
    """Compare the law of a segment without `times` with the fastest motion along the same path.

    Args:
        start: The first knot; shape (n,), [rad or m].
        segment: A segment with `configurations`.
        chain: The moving chain.
        field: Field of the segment; prefixes the names of its fields in errors.

    Raises:
        InvalidField: There is no such spline.
    """
    limits = segment.limits
    way = spline_path(start, segment, chain, field=field)
    if segment.law not in _SCALED or not _is_at_rest(way):
        return Timings(*compared(None, way, segment.law, limits))
    optimal = time_optimal(way, limits.velocity, limits.acceleration).motion.duration
    return timings(_fastest(way, segment, field), limits, optimal)


class Prefix(NamedTuple):
    """The part of a spline that stays within the joint limits.

    Attributes:
        motion: Motion to the last waypoint that is reached, at rest there.
        waypoints: Number of waypoints reached.
    """

    motion: PiecewisePolynomial
    waypoints: int


def longest_prefix(start: Array, segment: Segment, chain: Chain, *, field: str = "") -> Prefix:
    """Plan through as many waypoints as a spline can pass within the joint limits.

    The spline ends at rest at the last of them. Part of a periodic spline gets a natural boundary; part of a spline at
    given times is slowed down if its stop would exceed the limits.

    Args:
        start: The first knot; shape (n,), [rad or m].
        segment: A segment whose spline exceeds joint limits.
        chain: The moving chain.
        field: Field of the segment; prefixes the names of its fields in errors.

    Raises:
        InvalidField: There is no such spline.
    """
    points = _checked(start, segment, chain, field)
    excess = first_limit_excess(chain, _spline(points, segment))
    if excess is None:
        return Prefix(spline_motion(start, segment, chain, field=field), len(points.times) - 1)
    most = int(np.searchsorted(points.times, excess.time, side="right")) - 1
    boundary = "natural" if segment.boundary == "periodic" else segment.boundary
    shorter = replace(segment, boundary=boundary, duration=None)
    for count in range(min(most, len(points.times) - 2), 0, -1):
        way = _spline(Knots(points.times[: count + 1], points.positions[: count + 1]), shorter)
        if first_limit_excess(chain, way) is None:
            motion = _fastest(way, shorter, field) if segment.times is None else _slowed(way, shorter)
            return Prefix(motion, count)
    return Prefix(standing(start), 0)


class SmoothnessClass(NamedTuple):
    """Smoothness of a motion.

    Attributes:
        continuous: Order up to which derivatives of the joints do not jump within it.
        has_bounded_jerk: Whether acceleration jumps neither within it nor at its ends, and jerk is limited.
    """

    continuous: int
    has_bounded_jerk: bool


def promised(segment: Segment) -> SmoothnessClass:
    """Return how smooth the motion of a joint segment is, for a spline or from point to point."""
    keeps_jerk = kept(segment.law, segment.limits).jerk is not None
    if segment.configurations is None:
        return SmoothnessClass(2 if keeps_jerk else 1, keeps_jerk)
    if segment.times is not None:
        return SmoothnessClass(2, keeps_jerk and segment.boundary == "assigned")
    is_scaled = segment.law in _SCALED and segment.boundary in _AT_REST
    return SmoothnessClass(2 if keeps_jerk or is_scaled else 1, keeps_jerk)


def _checked(start: Array, segment: Segment, chain: Chain, field: str) -> Knots:
    """Check a segment, and return its knots."""
    check_limits(segment.limits, field)
    check_duration(segment.duration, field)
    points = knots(start, segment.configurations, segment.times, segment.limits.velocity, field)
    check_within(chain, points.positions[1:], field)
    check_closed(points.positions, segment.boundary, field)
    if segment.times is not None:
        _check_law_of_times(segment, field)
    return points


def _check_law_of_times(segment: Segment, field: str) -> None:
    if segment.boundary not in _AT_REST:
        raise InvalidField(
            named(field, "boundary"),
            f"with `times` a `{segment.boundary}` spline would neither start nor end at rest: leave `times` out, so "
            "that a time law leads from rest to rest, or take `clamped` or `assigned`",
        )
    if segment.duration is not None:
        raise InvalidField(named(field, "duration"), "is not allowed beside `times`, which determine it")
    if segment.law == "time_optimal":
        raise InvalidField(
            named(field, "times"),
            "are not allowed with the law `time_optimal`, which finds them",
        )
    if segment.law == "jerk_limited" and segment.boundary == "clamped":
        raise InvalidField(
            named(field, "boundary"),
            "at given `times` the acceleration of a `clamped` spline jumps at both ends, which the law `jerk_limited` "
            "forbids: take `assigned`, or leave `times` out",
        )


def _spline(points: Knots, segment: Segment) -> PiecewisePolynomial:
    return cubic_spline(points.times, points.positions, segment.boundary).motion


def _is_at_rest(way: PiecewisePolynomial) -> bool:
    """Return whether a spline is at rest at both ends: a clamped or assigned one, or another one by chance."""
    chords = np.diff(way.at(way.breaks), axis=0) / np.diff(way.breaks)[:, None]
    ends = way.derivative().at(way.breaks[[0, -1]])
    return bool(np.abs(ends).max(initial=0.0) <= _STILL * np.abs(chords).max(initial=0.0))


def _at_given_times(points: Knots, segment: Segment, field: str) -> PiecewisePolynomial:
    motion = _spline(points, segment)
    scaling = uniform_scaling(motion, _kept_at_times(segment))
    if scaling.course_factor > 1.0 + ROUNDING:
        bound = scaling.binding
        raise InvalidField(
            named(field, "times"),
            f"joint {bound.joint + 1} reaches {bound.ratio:.6g} times its limit of {bound.quantity} at "
            f"{bound.time:.6g} s: to keep the limits, multiply all times by {scaling.course_factor:.10g}",
        )
    return motion


def _slowed(motion: PiecewisePolynomial, segment: Segment) -> PiecewisePolynomial:
    """Return the motion at its times, slowed down if it exceeds the limits."""
    return motion.scaled(uniform_scaling(motion, _kept_at_times(segment)).course_factor)


def _kept_at_times(segment: Segment) -> ScalingLimits:
    """Return the limits of a spline in time; jerk is limited only if acceleration does not jump at its ends."""
    return kept(segment.law if segment.boundary == "assigned" else "cubic", segment.limits)


def _fastest(way: PiecewisePolynomial, segment: Segment, field: str) -> PiecewisePolynomial:
    """Return the motion from rest to rest along a path in the least time of the law."""
    limits = segment.limits
    if segment.law in _SCALED and _is_at_rest(way):
        factor = uniform_scaling(way, kept(segment.law, limits)).factor
        return way.scaled(factor or 1.0)
    try:
        if segment.law == "time_optimal":
            return time_optimal(way, limits.velocity, limits.acceleration).motion
        return timed(None, way, segment.law, limits).motion
    except InvalidField as error:
        raise InvalidField(named(field, error.field), error.reason) from error
