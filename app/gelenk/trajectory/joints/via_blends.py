"""Joint motion past via points on straight lines with parabolic blends, in the least time of this kind of motion.

If no times are given, each step first lasts as long as its slowest joint needs at its velocity limit. Steps too short
for their blends are stretched, as by Kunz and Stilman [Kunz2011]; then all times are multiplied by the least factor
that keeps the limits. The result contains the distance by which each via point is missed.
"""

from dataclasses import replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.motion import ROUNDING, check_duration, check_limits, named
from gelenk.trajectory.joints.parabolic_blends import Blends, with_accelerations, with_blend_times
from gelenk.trajectory.joints.waypoints import Knots, knots
from gelenk.trajectory.problem.problem import SegmentLimits

_HALVINGS = 40
_LARGEST_FACTOR = 1e12
_STRETCHES = 200
_LEAST_STRETCH, _LARGEST_STRETCH = 1.001, 1.5
_LEAST_SHARE = 1e-3
"""Least fraction of a step that is assumed for its straight line, even if the blends leave less."""


def via_blends(
    start: Array,
    configurations: Array,
    limits: SegmentLimits,
    *,
    times: Array | None = None,
    blend_time: float | None = None,
    duration: float | None = None,
    field: str = "",
) -> Blends:
    """Plan a motion from rest to rest past via points, with constant velocities on lines and accelerations in blends.

    The motion starts and ends exactly at its end points. It misses an inner point by |Δv| t_b / 8 at the point's time
    (`Blends.deviations`). Jerk limits do not apply.

    Args:
        start: Start configuration; shape (n,), [rad or m].
        configurations: Via points after the start, the last one being the end; shape (m, n), [rad or m].
        limits: Joint limits; if no blend time is given, the blends have the full acceleration.
        times: Times of the points after the start; shape (m,), [s]; the shortest found if not given.
        blend_time: t_b of each blend, [s].
        duration: Requested duration, given instead of times, [s].
        field: Request field of this motion, put before the names of its fields in refusals.

    Raises:
        InvalidField: Points or times are invalid, a segment is too short for its blends, the limits are exceeded at
            these times, or the duration is too short.
    """
    check_limits(limits, field)
    check_duration(duration, field)
    points = knots(start, configurations, times, limits.velocity, field)
    if times is not None:
        return _at_given_times(points, limits, blend_time, duration, field)
    return _fastest(points, limits, blend_time, duration, field)


def _at_given_times(
    points: Knots, limits: SegmentLimits, blend_time: float | None, duration: float | None, field: str
) -> Blends:
    if duration is not None:
        raise InvalidField(named(field, "duration"), "is not allowed beside `times`, which determine it")
    try:
        found = _blends(points, limits, blend_time)
    except InvalidField as error:
        raise InvalidField(named(field, error.field), error.reason) from error
    for quantity, values, most in (
        ("velocity", found.velocities, limits.velocity),
        ("acceleration", found.accelerations, limits.acceleration),
    ):
        ratios = np.abs(values) / most
        if ratios.max(initial=0.0) > 1.0 + ROUNDING:
            k, j = np.unravel_index(int(ratios.argmax()), ratios.shape)
            where = f"segment {k + 1}" if quantity == "velocity" else f"the blend at point {k}, the start being 0"
            raise InvalidField(
                named(field, "times"),
                f"joint {j + 1} reaches {ratios[k, j]:.6g} times its limit of {quantity} in {where}: give it more time",
            )
    return found


def _blends(points: Knots, limits: SegmentLimits, blend_time: float | None) -> Blends:
    if blend_time is None:
        return with_accelerations(points.times, points.positions, limits.acceleration)
    return with_blend_times(points.times, points.positions, np.full(len(points.times), blend_time))


def _fastest(
    points: Knots, limits: SegmentLimits, blend_time: float | None, duration: float | None, field: str
) -> Blends:
    """Plan with times that fit the blends: stretch steps one by one, then scale all by the least possible factor."""
    steps = np.diff(points.positions, axis=0)
    lengths = _stretched(np.diff(points.times), steps, limits, blend_time)
    low, high = 0.0, 1.0
    while not _fits(high * lengths, steps, limits, blend_time):
        low, high = high, 2.0 * high
        if high > _LARGEST_FACTOR:
            raise InvalidField(
                named(field, "waypoints"), "steps and limits are too many powers of ten apart for blends"
            )
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if _fits(middle * lengths, steps, limits, blend_time) else (middle, high)
    timed = Knots(np.concatenate(([0.0], np.cumsum(high * lengths))), points.positions)
    try:
        found = _blends(timed, limits, blend_time)
    except InvalidField as error:
        raise InvalidField(named(field, error.field), error.reason) from error
    return found if duration is None else _lasting(found, duration, timed, limits, blend_time, field)


def _stretched(lengths: Array, steps: Array, limits: SegmentLimits, blend_time: float | None) -> Array:
    """Lengthen each step until its blends fit; shape (N - 1,), [s]."""
    for _ in range(_STRETCHES):
        loads = _loads(lengths, steps, limits, blend_time)
        if (loads <= 1.0).all():
            break
        lengths = lengths * np.where(loads > 1.0, np.clip(np.sqrt(loads), _LEAST_STRETCH, _LARGEST_STRETCH), 1.0)
    return lengths


def _fits(lengths: Array, steps: Array, limits: SegmentLimits, blend_time: float | None) -> bool:
    return bool((_loads(lengths, steps, limits, blend_time) <= 1.0).all())


def _loads(lengths: Array, steps: Array, limits: SegmentLimits, blend_time: float | None) -> Array:
    """Return the largest ratio of each step's blend times to its duration and of its rates to their limits; (N - 1,).

    Args:
        lengths: Durations of the steps; shape (N - 1,), [s].
        steps: Δq; shape (N - 1, n), [rad or m].
        limits: Joint limits.
        blend_time: Duration of each blend, [s]; that of the full acceleration if None.
    """
    h, sides = lengths[:, None], np.zeros((len(lengths), 1))
    sides[0] += 1.0
    sides[-1] += 1.0
    if blend_time is None:
        # End blends: the smaller root of h t_b - sides t_b²/2 = |Δq|/a; without a root, more than the step has.
        needed = np.abs(steps) / limits.acceleration
        blends = 2.0 * needed / (h + np.sqrt(np.maximum(h**2 - 2.0 * sides * needed, 0.0)))
    else:
        blends = np.full_like(steps, blend_time)
    velocities = steps / np.maximum(h - 0.5 * sides * blends, _LEAST_SHARE * h)
    changes = np.abs(np.diff(velocities, axis=0, prepend=0.0, append=0.0)) / limits.acceleration
    durations = changes.copy() if blend_time is None else np.full_like(changes, blend_time)
    durations[0], durations[-1] = blends[0], blends[-1]
    shares = np.full((len(durations), 1), 0.5)
    shares[0] = shares[-1] = 1.0
    loads = [(durations[:-1] * shares[:-1] + durations[1:] * shares[1:]) / h, np.abs(velocities) / limits.velocity]
    if blend_time is not None:
        loads += [changes[:-1] / blend_time, changes[1:] / blend_time]
    largest: Array = np.max(loads, axis=0).max(axis=1)
    return largest


def _lasting(
    found: Blends, duration: float, points: Knots, limits: SegmentLimits, blend_time: float | None, field: str
) -> Blends:
    """Slow the motion down to a given duration: as a whole, or planned again with the given blend time."""
    least = found.motion.duration
    if duration < least * (1.0 - ROUNDING):
        raise InvalidField(named(field, "duration"), f"must be at least {least:.10g} s")
    factor = duration / least
    if blend_time is not None:
        times = points.times * (duration / points.times[-1])
        return _blends(Knots(times, points.positions), limits, blend_time)
    return replace(
        found,
        motion=found.motion.scaled(factor),
        velocities=found.velocities / factor,
        accelerations=found.accelerations / factor**2,
        durations=found.durations * factor,
    )
