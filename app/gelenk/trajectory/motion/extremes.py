"""Exact extremes of a motion: values at the ends of its pieces, and at the roots of the derivative between them.

A slightly inexact root does no harm, because the value is stationary there.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_SAME = 1e-12


@dataclass(frozen=True, slots=True)
class Peaks:
    """The value of each coordinate furthest from zero, with its sign, and its first time [s]; shape (n,) each."""

    values: Array
    times: Array


def peaks(motion: PiecewisePolynomial, order: int) -> Peaks:
    """Find the largest magnitude of a derivative, also at both ends of each piece; order 1 is the velocity."""
    flat_times, flat = (found.reshape(-1, found.shape[-1]) for found in candidates(motion.derivative(order)))
    sizes = np.abs(flat)
    late = np.where(sizes >= sizes.max(axis=0) * (1.0 - _SAME), flat_times, np.inf)
    first = late.argmin(axis=0)
    columns = np.arange(flat.shape[1])
    return Peaks(flat[first, columns], flat_times[first, columns])


def peaks_by_order(motion: PiecewisePolynomial, highest: int = 3) -> dict[int, Peaks]:
    """Return the peaks of the derivatives from velocity up to an order, by their orders."""
    return {order: peaks(motion, order) for order in range(1, highest + 1)}


def largest_ratio(motion: PiecewisePolynomial, order: int, limits: Array) -> tuple[float, int]:
    """Find the largest ratio of a derivative's magnitude to its limits, (n,) or (M, n); and the coordinate's index."""
    from gelenk.trajectory.motion.stationary import largest  # noqa: PLC0415 - a client has no compiler

    c = np.ascontiguousarray(motion.coefficients)
    bounds = np.ascontiguousarray(np.broadcast_to(limits, (len(c), c.shape[2])))
    found: tuple[float, int] = largest(c, np.diff(motion.breaks), order, bounds)
    return found


def candidates(motion: PiecewisePolynomial) -> tuple[Array, Array]:
    """Return the times at which a motion can be extreme, and its values there; shape (M, k, n) each.

    These are both ends of each piece and the zeros of its derivative; zeros outside the piece are moved to its ends.
    """
    from gelenk.trajectory.motion.stationary import stationary  # noqa: PLC0415 - a client has no compiler

    lengths = np.diff(motion.breaks)[:, None]
    c = np.ascontiguousarray(motion.coefficients) * (lengths ** np.arange(motion.coefficients.shape[1]))[:, :, None]
    inner = stationary(c)
    ends = np.zeros((c.shape[0], 1, c.shape[2]))
    u = np.concatenate([ends, inner, ends + 1.0], axis=1)
    values = np.broadcast_to(c[:, -1:], u.shape)
    for k in range(c.shape[1] - 2, -1, -1):
        values = values * u + c[:, k : k + 1]
    # The end of a piece is exactly the next one's start, so that a lookup at that time finds the break.
    starts, stops = motion.breaks[:-1, None, None], motion.breaks[1:, None, None]
    return np.where(u == 1.0, stops, starts + u * lengths[:, :, None]), values
