"""Exact extremes of a motion: values at the ends of its pieces, and at the roots of the derivative between them.

A slightly inexact root does no harm, because the value is stationary there.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_STEPS, _EXACT = 60, 1e-15
"""Most steps to a zero, and the last one's length."""
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


def candidates(motion: PiecewisePolynomial) -> tuple[Array, Array]:
    """Return the times at which a motion can be extreme, and its values there; shape (M, k, n) each.

    These are both ends of each piece and the zeros of its derivative; zeros outside the piece are moved to its ends.
    """
    lengths = np.diff(motion.breaks)[:, None]
    c = np.ascontiguousarray(motion.coefficients) * (lengths ** np.arange(motion.coefficients.shape[1]))[:, :, None]
    inner = _stationary(c)
    ends = np.zeros((c.shape[0], 1, c.shape[2]))
    u = np.concatenate([ends, inner, ends + 1.0], axis=1)
    values = np.broadcast_to(c[:, -1:], u.shape)
    for k in range(c.shape[1] - 2, -1, -1):
        values = values * u + c[:, k : k + 1]
    # The end of a piece is exactly the next one's start, so that a lookup at that time finds the break.
    starts, stops = motion.breaks[:-1, None, None], motion.breaks[1:, None, None]
    return np.where(u == 1.0, stops, starts + u * lengths[:, :, None]), values


@compiled
def _stationary(c: Array) -> Array:
    """Find the zeros in [0, 1] of the derivative of polynomials, lowest power first; (M, d + 1, n) → (M, d - 1, n).

    The zeros of each derivative separate those of the one before it, so that between them each has one zero at most.
    Where there are fewer than d - 1, or the derivative does not change its sign, the rest is 0.
    """
    pieces, size, n = c.shape
    found, slope = np.zeros((pieces, max(size - 2, 0), n)), np.empty(max(size - 1, 1))
    for i in range(pieces):
        for j in range(n):
            for k in range(1, size):
                slope[k - 1] = k * c[i, k, j]
            _zeros(slope, found[i, :, j])
    return found


@compiled
def _zeros(c: Array, zeros: Array) -> None:
    """Write the zeros in (0, 1) of a polynomial of degree d at which its sign changes into the first of d places."""
    degree, count = len(c) - 1, 0
    edges = np.empty(degree + 2)
    for order in range(degree - 1, -1, -1):
        edges[0], edges[count + 1] = 0.0, 1.0
        for k in range(count):
            edges[k + 1] = zeros[k]
        last, count = count + 1, 0
        for k in range(last):
            low, high = edges[k], edges[k + 1]
            below, above = _derivative(c, order, low), _derivative(c, order, high)
            if below * above < 0.0:
                zeros[count] = _zero_between(c, order, low, high, below)
                count += 1
    zeros[count:] = 0.0


@inlined
def _derivative(c: Array, order: int, x: float) -> float:
    value = 0.0
    for k in range(len(c) - 1, order - 1, -1):
        factor = 1.0
        for i in range(order):
            factor *= k - i
        value = value * x + factor * c[k]
    return value


@inlined
def _zero_between(c: Array, order: int, low: float, high: float, below: float) -> float:
    """Return the one zero between two places of unlike sign by Newton's method, halving where that leads out."""
    x = 0.5 * (low + high)
    for _ in range(_STEPS):
        value, slope = _derivative(c, order, x), _derivative(c, order + 1, x)
        if value * below > 0.0:
            low = x
        else:
            high = x
        following = x - value / slope if slope != 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - x) <= _EXACT:
            return following
        x = following
    return x
