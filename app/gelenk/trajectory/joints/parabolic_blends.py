"""Straight segments past via points, joined by parabolic blends: a trapezoidal velocity profile with several coasts.

The blend at an inner point is centred on the point's time, with one half in each adjacent segment, so the motion
misses the point by |Δv| t_b / 8. The first and the last blend lie wholly within their segments, so the motion starts
and ends exactly at its end points and on time [Craig, 7.3].
"""

from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.phases import of_phases
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_ROUNDING = 1e-12
_ACCELERATION = "limits.joint_acceleration"


@dataclass(frozen=True, slots=True)
class Blends:
    """A motion of straight segments and parabolic blends.

    Attributes:
        velocities: On the straight segments; shape (N - 1, n), [rad/s or m/s].
        accelerations: In the blends, signed; shape (N, n), [rad/s² or m/s²].
        durations: Of the blends; shape (N, n), [s].
        deviations: Distance by which the motion misses each point at its time; shape (N, n), [rad or m].
    """

    motion: PiecewisePolynomial
    velocities: Array
    accelerations: Array
    durations: Array
    deviations: Array


def with_blend_times(times: Array, points: Array, blend_times: Array) -> Blends:
    """Plan blends of given durations, from which the accelerations follow; `InvalidField` if a segment is too short.

    Args:
        times: Times of the points, increasing; shape (N,), [s].
        points: Via points; shape (N, n), [rad or m].
        blend_times: t_b > 0 of each point; shape (N,), [s].
    """
    lengths, steps = np.diff(times), np.diff(points, axis=0)
    _check_room(lengths, np.repeat(blend_times[:, None], points.shape[1], axis=1), "blend_time")
    travel = lengths.copy()
    # The line of an end segment passes through the middle of its end blend, so it has half a blend less time.
    travel[0] -= 0.5 * blend_times[0]
    travel[-1] -= 0.5 * blend_times[-1]
    velocities = steps / travel[:, None]
    durations = np.broadcast_to(blend_times[:, None], points.shape)
    accelerations = _changes(velocities) / durations
    return _assembled(times, points, velocities, accelerations, durations, "blend_time")


def with_accelerations(times: Array, points: Array, accelerations: Array) -> Blends:
    """Plan blends with an acceleration a > 0 of each joint, (n,), [rad/s² or m/s²]; they last t_b = |Δv|/a.

    `InvalidField` if a segment is too short for its blends, or an end segment for its distance from rest. Times and
    points are those of `with_blend_times`.
    """
    lengths, steps = np.diff(times), np.diff(points, axis=0)
    velocities = steps / lengths[:, None]
    last = len(lengths) - 1
    rests = 2 if last == 0 else 1
    ends = [_end_blend(lengths[k], np.abs(steps[k]), accelerations, rests, k) for k in (0, last)]
    for k, blend in zip((0, last), ends, strict=True):
        velocities[k] = steps[k] / (lengths[k] - 0.5 * rests * blend)
    changes = _changes(velocities)
    durations = np.abs(changes) / accelerations
    durations[0], durations[-1] = ends
    _check_room(lengths, durations, _ACCELERATION)
    return _assembled(times, points, velocities, np.copysign(accelerations, changes), durations, _ACCELERATION)


def _end_blend(length: float, distance: Array, acceleration: Array, ends: int, segment: int) -> Array:
    """Return t_b of an end segment, the smaller root of T t_b - c t_b² = L/a: c = 1 if both ends rest, else 1/2."""
    room = length**2 - 2.0 * ends * distance / acceleration
    short = np.flatnonzero(room < -_ROUNDING * length**2)
    if len(short) > 0:
        j = int(short[0])
        least = 2.0 * ends * distance[j] / length**2
        raise InvalidField(
            _ACCELERATION,
            f"segment {segment + 1} of {length:.10g} s is too short for joint {j + 1}: it needs an acceleration of at "
            f"least {least:.10g}, or {np.sqrt(2.0 * ends * distance[j] / acceleration[j]):.10g} s",
        )
    found: Array = 2.0 * distance / acceleration / (length + np.sqrt(np.maximum(room, 0.0)))
    return found


def shared(durations: Array) -> Array:
    """Return the time that blends take of each adjacent segment: half of an inner one, all of an end one; (N, n)."""
    parts = 0.5 * durations
    parts[[0, -1]] = durations[[0, -1]]
    return parts


def _check_room(lengths: Array, durations: Array, field: str) -> None:
    parts = shared(durations)
    taken = parts[:-1] + parts[1:]
    late = np.argwhere(taken > lengths[:, None] * (1.0 + _ROUNDING))
    if len(late) > 0:
        k, j = (int(i) for i in late[0])
        raise InvalidField(
            field,
            f"segment {k + 1} of {lengths[k]:.10g} s is too short for its blends, which take {taken[k, j]:.10g} s of "
            f"it (joint {j + 1}): give it more time, or a "
            + ("shorter blend" if field == "blend_time" else "greater acceleration"),
        )


def _changes(velocities: Array) -> Array:
    """Return Δv at each point, starting and ending at rest; shape (N, n)."""
    return np.diff(velocities, axis=0, prepend=0.0, append=0.0)


def _assembled(
    times: Array, points: Array, velocities: Array, accelerations: Array, durations: Array, field: str
) -> Blends:
    parts = shared(durations)
    straights = np.maximum(np.diff(times)[:, None] - parts[:-1] - parts[1:], 0.0)
    phases = np.zeros((points.shape[1], 2 * len(times) - 1, 2))
    phases[:, ::2] = np.stack((durations, accelerations), axis=-1).swapaxes(0, 1)
    phases[:, 1::2, 0] = straights.T
    deviations = np.abs(_changes(velocities)) * durations / 8.0
    deviations[0] = deviations[-1] = 0.0
    motion = of_phases(points[0], np.zeros(points.shape[1]), phases.tolist(), float(times[0]), field)
    return Blends(motion, velocities, accelerations, durations, deviations)
