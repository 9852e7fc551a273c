"""Knots of a joint motion through waypoints, with their times: checked, and spaced if no times are given.

Without times a step takes as long as its slowest joint needs at its velocity limit, h = max_j |Δq_j|/v_j. This is the
chord length for joints of different kinds; it spaces the knots, and is not yet a time.
"""

from typing import NamedTuple

import numpy as np

from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.joints.motion import LARGEST, NO_LENGTH, named
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


def knots(start: Array, waypoints: Array | None, times: Array | None, velocity: Array, field: str = "") -> Knots:
    """Return the start and the waypoints after it as knots.

    Args:
        start: Shape (n,), [rad or m].
        waypoints: Shape (m, n), [rad or m].
        times: Time of each waypoint, with the start at 0 s; shape (m,), [s].
        velocity: Limit of each joint, used to space knots without times; shape (n,), [rad/s or m/s].
        field: Field of the segment; prefixes the names of its fields in errors.

    Raises:
        InvalidField: There are no waypoints, or numbers that are too large or not finite; times do not increase; or,
            without times, two successive waypoints coincide.
    """
    name = named(field, "waypoints")
    if waypoints is None or len(waypoints) == 0:
        raise InvalidField(name, "at least one is needed: the start is the first knot, and a spline needs two")
    positions = np.concatenate((start[None], waypoints))
    too_large = np.argwhere(~(np.abs(positions) <= LARGEST))
    if len(too_large) > 0:
        k = int(too_large[0, 0])
        raise InvalidField("start" if k == 0 else f"{name}.{k - 1}", f"must be of magnitude ≤ {LARGEST:g}")
    if times is None:
        return Knots(_spaced(positions, velocity, name), positions)
    _check_times(times, len(waypoints), named(field, "times"))
    return Knots(np.concatenate(([0.0], times)), positions)


def _spaced(positions: Array, velocity: Array, name: str) -> Array:
    """Return times spaced by the steps of the slowest joint."""
    steps = np.abs(np.diff(positions, axis=0))
    lengths = (steps / velocity).max(axis=1, initial=0.0)
    is_same = steps.max(axis=1, initial=0.0) <= NO_LENGTH
    short = np.flatnonzero(is_same | ~(lengths > 2.0 * NEAREST * lengths.sum()))
    if len(short) == 0:
        times: Array = np.concatenate(([0.0], np.cumsum(lengths)))
        return times
    k = int(short[0])
    before = "the start" if k == 0 else f"entry {k - 1}"
    how = "the same as" if is_same[k] else "less than a millionth of the whole path from"
    raise InvalidField(f"{name}.{k}", f"is {how} {before}: leave one of the two out, or give `times`")


def _check_times(times: Array, count: int, name: str) -> None:
    if len(times) != count:
        raise InvalidField(name, f"{counted(len(times), 'entry')} for {counted(count, 'waypoint')}")
    if not (np.abs(times) <= LARGEST).all():
        raise InvalidField(name, f"each must be at most {LARGEST:g} s")
    checked_times(times, name)
    if not times[0] > NEAREST * times[-1]:
        raise InvalidField(f"{name}.0", f"{times[0]:.10g} s is not after the start of the segment, which is at 0 s")


def check_within(chain: Chain, waypoints: Array, field: str = "") -> None:
    """Check that waypoints are within the joint limits.

    Args:
        chain: Chain with the joint limits.
        waypoints: Shape (m, n), [rad or m].
        field: Field of the segment.

    Raises:
        InvalidField: A waypoint is outside; the first one is named.
    """
    outside = np.argwhere(~((waypoints >= chain.lower - WITHIN) & (waypoints <= chain.upper + WITHIN)))
    if len(outside) == 0:
        return
    k, j = (int(i) for i in outside[0])
    raise InvalidField(
        f"{named(field, 'waypoints')}.{k}",
        f"joint {chain.joint_names[j]} at {waypoints[k, j]:.10g} is outside its limits "
        f"[{chain.lower[j]:.10g}, {chain.upper[j]:.10g}]",
    )


def check_closed(positions: Array, boundary: Boundary, field: str = "") -> None:
    """Check that a periodic spline ends where it starts.

    Raises:
        InvalidField: It does not.
    """
    gaps = np.abs(positions[-1] - positions[0])
    if boundary != "periodic" or gaps.max(initial=0.0) <= CLOSED * max(1.0, float(np.abs(positions).max())):
        return
    j = int(gaps.argmax())
    raise InvalidField(
        f"{named(field, 'waypoints')}.{len(positions) - 2}",
        f"a periodic spline ends where it starts, and joint {j + 1} is {gaps[j]:.10g} away from there",
    )
