"""Knots of a joint motion through waypoints, with their times: checked, and spaced if no times are given.

Without times a step takes as long as its slowest joint needs at its velocity limit, h = max_j |Δq_j|/v_j. This is the
chord length for joints of different kinds; it spaces the knots, and is not yet a time.
"""

from typing import NamedTuple

import numpy as np

from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import compiled
from gelenk.trajectory.joints.fastest import NO_LENGTH
from gelenk.trajectory.laws.time_scaling import LARGEST
from gelenk.trajectory.motion.splines import CLOSED, NEAREST, Boundary, checked_times

WITHIN = 1e-9
"""Distance beyond a limit at which a joint still counts as within, [rad or m]."""


class Knots(NamedTuple):
    """The waypoints, including the start, and their times.

    Attributes:
        times: Times from 0 on; without given times, the spacing of the knots; shape (N,), [s].
        positions: Shape (N, n), [rad or m].
    """

    times: Array
    positions: Array


def knots(start: Array, waypoints: Array | None, times: Array | None, velocity: Array) -> Knots:
    """Return the start and the waypoints after it as knots.

    Args:
        start: Shape (n,), [rad or m].
        waypoints: Shape (m, n), [rad or m].
        times: Time of each waypoint, with the start at 0 s; shape (m,), [s].
        velocity: Limit of each joint, used to space knots without times; shape (n,), [rad/s or m/s].

    Raises:
        InvalidField: There are no waypoints, or numbers that are too large or not finite; times do not increase; or,
            without times, two successive waypoints coincide.
    """
    if waypoints is None or len(waypoints) == 0:
        raise InvalidField("waypoints", "at least one is needed: the start is the first knot, and a spline needs two")
    positions = np.concatenate((start[None], waypoints))
    is_sensible = np.abs(positions) <= LARGEST
    if not is_sensible.all():
        k = int(np.argwhere(~is_sensible)[0, 0])
        raise InvalidField("start" if k == 0 else f"waypoints.{k - 1}", f"must be of magnitude ≤ {LARGEST:g}")
    if times is None:
        return Knots(_spaced(positions, velocity), positions)
    _check_times(times, len(waypoints))
    return Knots(np.concatenate(([0.0], times)), positions)


def _spaced(positions: Array, velocity: Array) -> Array:
    times, lengths, steps = spacing(positions, velocity)
    short = np.flatnonzero(~are_distinct(lengths, steps))
    if len(short) == 0:
        return times
    k = int(short[0])
    before = "the start" if k == 0 else f"entry {k - 1}"
    how = "the same as" if steps[k] <= NO_LENGTH else "less than a millionth of the whole path from"
    raise InvalidField(f"waypoints.{k}", f"is {how} {before}: leave one of the two out, or give `times`")


@compiled
def are_distinct(lengths: Array, steps: Array) -> Flags:
    """Return which steps lead somewhere, by what `spacing` returns of them; shape (N - 1,)."""
    found: Flags = (steps > NO_LENGTH) & (lengths > 2.0 * NEAREST * lengths.sum())
    return found


@compiled
def spacing(positions: Array, velocity: Array) -> tuple[Array, Array, Array]:
    """Return the knots' times, (N,), the length of each step between them, and how far a joint goes, (N - 1,) each."""
    count, n = positions.shape
    times, lengths, steps = np.zeros(count), np.zeros(count - 1), np.zeros(count - 1)
    for k in range(count - 1):
        for j in range(n):
            step = abs(positions[k + 1, j] - positions[k, j])
            lengths[k], steps[k] = max(lengths[k], step / velocity[j]), max(steps[k], step)
        times[k + 1] = times[k] + lengths[k]
    return times, lengths, steps


def _check_times(times: Array, count: int) -> None:
    if len(times) != count:
        raise InvalidField("times", f"{counted(len(times), 'entry')} for {counted(count, 'waypoint')}")
    if not (np.abs(times) <= LARGEST).all():
        raise InvalidField("times", f"each must be at most {LARGEST:g} s")
    checked_times(times, "times")
    if not times[0] > NEAREST * times[-1]:
        raise InvalidField("times.0", f"{times[0]:.10g} s is not after the start of the segment, which is at 0 s")


def check_within(chain: Chain, configurations: Array, field: str) -> None:
    """Refuse configurations, (m, n), [rad or m], of which one is outside the joint limits, with `InvalidField`.

    The field names the first one: an index takes the place of `{}`.
    """
    is_within = (configurations >= chain.lower - WITHIN) & (configurations <= chain.upper + WITHIN)
    if is_within.all():
        return
    k, j = (int(i) for i in np.argwhere(~is_within)[0])
    raise InvalidField(
        field.format(k),
        f"joint {chain.joint_names[j]} at {configurations[k, j]:.10g} is outside its limits "
        f"[{chain.lower[j]:.10g}, {chain.upper[j]:.10g}]",
    )


def check_closed(positions: Array, boundary: Boundary) -> None:
    """Refuse a periodic spline that does not end where it starts, with `InvalidField`."""
    gaps = np.abs(positions[-1] - positions[0])
    if boundary != "periodic" or gaps.max(initial=0.0) <= CLOSED * max(1.0, float(np.abs(positions).max())):
        return
    j = int(gaps.argmax())
    raise InvalidField(
        f"waypoints.{len(positions) - 2}",
        f"a periodic spline ends where it starts, and joint {j + 1} is {gaps[j]:.10g} away from there",
    )
