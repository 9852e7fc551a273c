"""Joints past via points on straight lines with parabolic blends, in the least time of their kind.

Without times each step is first as long as its slowest joint needs for it at its limit of velocity. Steps without room
for their blends are stretched until they have it, as by Kunz and Stilman [Kunz2011]; then all times are multiplied by
the least factor with which the limits are kept. The answer says how far a via point is missed.
"""

from dataclasses import replace

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.errors import InvalidField
from gelenk.trajectory.joint_motion import ROUNDING, check_duration, check_limits, named
from gelenk.trajectory.joint_waypoints import Knots, knots
from gelenk.trajectory.parabolic_blends import Blends, with_accelerations, with_blend_times
from gelenk.trajectory.problem import MotionLimits

_HALVINGS = 40
_LARGEST_FACTOR = 1e12
_STRETCHES = 200
_LEAST_STRETCH, _LARGEST_STRETCH = 1.001, 1.5
_LEAST_SHARE = 1e-3
"""Of a step that is taken for its straight line, where its blends do not leave as much."""


def via_blends(
    start: Array,
    configurations: Array,
    limits: MotionLimits,
    *,
    times: Array | None = None,
    blend_time: float | None = None,
    duration: float | None = None,
    field: str = "",
) -> Blends:
    """From rest to rest past via points: velocities constant on straight lines, accelerations in the blends.

    It begins and ends in its end points. An inner point it passes beside, at the point's time, by |Δv| t_b / 8: see
    `Blends.deviations`. Limits of jerk are none of it.

    Args:
        start: Shape (n,), [rad or m].
        configurations: Via points after the start, the last one the end; shape (m, n).
        limits: Of the joints. Where no blend time is given, blends have the full acceleration.
        times: Of the points, after the start; shape (m,), [s]; the least of their proportion if left out.
        blend_time: t_b of each blend, [s].
        duration: In the place of times, [s].
        field: What this stands for in the request, before the names of its fields in refusals.

    Raises:
        InvalidField: Points or times that cannot be taken, a segment too short for its blends, limits that are passed
            at these times, or a duration that is too short.
    """
    check_limits(limits, field)
    check_duration(duration, field)
    points = knots(start, configurations, times, limits.velocity, field)
    if times is not None:
        return _at_given_times(points, limits, blend_time, duration, field)
    return _fastest(points, limits, blend_time, duration, field)


def _at_given_times(
    points: Knots, limits: MotionLimits, blend_time: float | None, duration: float | None, field: str
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
                f"joint {j + 1} comes to {ratios[k, j]:.6g} times its limit of {quantity} in {where}: "
                "give it more time",
            )
    return found


def _blends(points: Knots, limits: MotionLimits, blend_time: float | None) -> Blends:
    if blend_time is None:
        return with_accelerations(points.times, points.positions, limits.acceleration)
    return with_blend_times(points.times, points.positions, np.full(len(points.times), blend_time))


def _fastest(
    points: Knots, limits: MotionLimits, blend_time: float | None, duration: float | None, field: str
) -> Blends:
    """At times that leave each blend its room: steps stretched one by one, then all by the least factor that does."""
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


def _stretched(lengths: Array, steps: Array, limits: MotionLimits, blend_time: float | None) -> Array:
    """Each step longer until its blends have room in it; shape (N - 1,), [s]."""
    for _ in range(_STRETCHES):
        loads = _loads(lengths, steps, limits, blend_time)
        if (loads <= 1.0).all():
            break
        lengths = lengths * np.where(loads > 1.0, np.clip(np.sqrt(loads), _LEAST_STRETCH, _LARGEST_STRETCH), 1.0)
    return lengths


def _fits(lengths: Array, steps: Array, limits: MotionLimits, blend_time: float | None) -> bool:
    return bool((_loads(lengths, steps, limits, blend_time) <= 1.0).all())


def _loads(lengths: Array, steps: Array, limits: MotionLimits, blend_time: float | None) -> Array:
    """How much each step is used by its blends and velocities, and by accelerations in its blends: 1 is all of it.

    Args:
        lengths: Of the steps; shape (N - 1,), [s].
        steps: Δq; shape (N - 1, n), [rad or m].
        limits: Of the joints.
        blend_time: Of each blend, [s]; as long as the full acceleration takes if None.
    """
    h, sides = lengths[:, None], np.zeros((len(lengths), 1))
    sides[0] += 1.0
    sides[-1] += 1.0
    if blend_time is None:
        # Of an end blend: h t_b - sides t_b²/2 = |Δq|/a, the smaller root; where there is none, more than there is.
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
    found: Blends, duration: float, points: Knots, limits: MotionLimits, blend_time: float | None, field: str
) -> Blends:
    """The same in a given time: slowed as a whole, or at the blend time that is given."""
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
