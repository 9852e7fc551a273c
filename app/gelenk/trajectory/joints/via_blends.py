"""Joint motion past via points on straight lines with parabolic blends, in the least time of this kind of motion.

If no times are given, each step first lasts as long as its slowest joint needs at its velocity limit. Steps too short
for their blends are stretched, as by Kunz and Stilman [Kunz2011]; then all times are multiplied by the least factor
that keeps the limits.
"""

from dataclasses import replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.motion import ROUNDING, check_duration
from gelenk.trajectory.joints.parabolic_blends import Blends, shared, with_accelerations
from gelenk.trajectory.joints.waypoints import Knots, knots
from gelenk.trajectory.laws.time_scaling import check_limits
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
    duration: float | None = None,
) -> Blends:
    """Plan a motion from rest to rest past via points, with constant velocities on lines and accelerations in blends.

    It starts and ends exactly at its end points, and misses the others by `Blends.deviations`. Jerk is not limited.

    Args:
        start: Shape (n,), [rad or m].
        configurations: Via points after the start, the last one being the end; shape (m, n), [rad or m].
        limits: Of the joints; the blends have the full acceleration.
        times: Of the points after the start; shape (m,), [s]; the shortest found if not given.
        duration: Given instead of times, [s].

    Raises:
        InvalidField: Points or times are invalid, a segment is too short for its blends, the limits are exceeded at
            these times, or the duration is too short.
    """
    check_limits(limits.joints)
    check_duration(duration)
    points = knots(start, configurations, times, limits.velocity)
    if times is None:
        found = _fastest(points, limits)
        return found if duration is None else _lasting(found, duration)
    if duration is not None:
        raise InvalidField("duration", "is not allowed beside `times`, which determine it")
    found = with_accelerations(points.times, points.positions, limits.acceleration)
    ratios = np.abs(found.velocities) / limits.velocity
    if ratios.max(initial=0.0) > 1.0 + ROUNDING:
        k, j = np.unravel_index(int(ratios.argmax()), ratios.shape)
        raise InvalidField(
            "times",
            f"joint {j + 1} reaches {ratios[k, j]:.6g} times its limit of velocity in segment {k + 1}: give it more "
            "time",
        )
    return found


def _fastest(points: Knots, limits: SegmentLimits) -> Blends:
    """Stretch steps one by one until they fit the blends, then scale all by the least possible factor."""
    steps = np.diff(points.positions, axis=0)
    lengths = _stretched(np.diff(points.times), steps, limits)
    low, high = 0.0, 1.0
    while (_loads(high * lengths, steps, limits) > 1.0).any():
        low, high = high, 2.0 * high
        if high > _LARGEST_FACTOR:
            raise InvalidField("waypoints", "steps and limits are too many powers of ten apart for blends")
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (_loads(middle * lengths, steps, limits) > 1.0).any() else (low, middle)
    times = np.concatenate(([0.0], np.cumsum(high * lengths)))
    return with_accelerations(times, points.positions, limits.acceleration)


def _stretched(lengths: Array, steps: Array, limits: SegmentLimits) -> Array:
    for _ in range(_STRETCHES):
        loads = _loads(lengths, steps, limits)
        if (loads <= 1.0).all():
            break
        lengths = lengths * np.where(loads > 1.0, np.clip(np.sqrt(loads), _LEAST_STRETCH, _LARGEST_STRETCH), 1.0)
    return lengths


def _loads(lengths: Array, steps: Array, limits: SegmentLimits) -> Array:
    """Return the largest ratio of each step's blend times to its duration or of its rates to limits; shape (N - 1,)."""
    h, sides = lengths[:, None], np.zeros((len(lengths), 1))
    sides[0] += 1.0
    sides[-1] += 1.0
    # End blends: the smaller root of h t_b - sides t_b²/2 = |Δq|/a; without a root, more than the step has.
    needed = np.abs(steps) / limits.acceleration
    blends = 2.0 * needed / (h + np.sqrt(np.maximum(h**2 - 2.0 * sides * needed, 0.0)))
    velocities = steps / np.maximum(h - 0.5 * sides * blends, _LEAST_SHARE * h)
    durations = np.abs(np.diff(velocities, axis=0, prepend=0.0, append=0.0)) / limits.acceleration
    durations[0], durations[-1] = blends[0], blends[-1]
    parts = shared(durations)
    loads = np.maximum((parts[:-1] + parts[1:]) / h, np.abs(velocities) / limits.velocity)
    largest: Array = loads.max(axis=1)
    return largest


def _lasting(found: Blends, duration: float) -> Blends:
    least = found.motion.duration
    if duration < least * (1.0 - ROUNDING):
        raise InvalidField("duration", f"must be at least {least:.10g} s")
    factor = duration / least
    return replace(
        found,
        motion=found.motion.scaled(factor),
        velocities=found.velocities / factor,
        accelerations=found.accelerations / factor**2,
        durations=found.durations * factor,
    )
