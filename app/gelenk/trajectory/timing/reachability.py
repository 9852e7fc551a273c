"""Reachability along a path: the speeds from which its end can be reached, and the fastest among them [Pham2018].

The path is cut into intervals of length Δ. In each of them u = s̈ is constant, so x = ṡ² goes from x_i to x_i + 2Δu.
The admissible points (u, x_i) of an interval form a convex polygon, given by rows αu + βx ≤ 1; it always contains rest,
u = x = 0. For a given x, the rows bound u from above and from below by lines in x; eliminating u from pairs of such
lines leaves bounds of x. All pairs except those with the speed at the next node are evaluated in advance.
"""

from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled

_NO_WEIGHT = 1e-12
"""α of a row, as a fraction of the largest in its interval, below which the row does not bound u."""
_UNBOUNDED = 1e30
_MOST_STEPS = 100


class Stages(NamedTuple):
    """Constraints of a motion in each of N intervals.

    Attributes:
        lengths: Δ; shape (N,).
        upper: Offsets and slopes of the lines in x that bound u from above, ∞ and 0 for none; shape (2, N, m + 1).
        lower: The same for those that bound u from below, -∞ and 0 for none.
        highest: Largest x at the start of each interval from which the motion can continue; shape (N,).
    """

    lengths: Array
    upper: Array
    lower: Array
    highest: Array


@compiled
def stages(lengths: Array, alpha: Array, beta: Array, least_shares: Array) -> Stages:
    """Build the constraints of intervals from their rows αu + βx ≤ 1.

    Args:
        lengths: Δ > 0; shape (N,).
        alpha, beta: α and β; shape (N, m).
        least_shares: Smallest fraction of x, from 0 to 1, that must be left at the end of each interval; shape (N,).
            Without, where q' of a joint changes sign, the largest x may be one from which the motion can only stop.
    """
    count, m = alpha.shape
    upper, lower = np.zeros((2, count, m + 1)), np.zeros((2, count, m + 1))
    upper[0], lower[0, :, :m] = np.inf, -np.inf
    highest = np.full(count, _UNBOUNDED)
    for i in range(count):
        # x_i + 2Δu ≥ share x_i.
        lower[1, i, m] = -0.5 * (1.0 - least_shares[i]) / lengths[i]
        weightless = _NO_WEIGHT * np.abs(alpha[i]).max()
        for k in range(m):
            a, b = alpha[i, k], beta[i, k]
            if abs(a) > weightless:
                lines = upper if a > 0.0 else lower
                lines[0, i, k], lines[1, i, k] = 1.0 / a, -b / a
            elif b > 0.0:
                highest[i] = min(highest[i], 1.0 / b)
        highest[i] = _highest(upper[:, i], lower[:, i], highest[i])
    return Stages(lengths, upper, lower, highest)


@compiled
def _highest(upper: Array, lower: Array, x: float) -> float:
    """Return the largest x at which no upper line is below a lower one, by Newton's method from the right.

    The gap between the lowest upper and the highest lower line is concave in x and nonnegative at 0: every step ends
    to the right of the zero, and finitely many steps reach it.
    """
    for _ in range(_MOST_STEPS):
        i, j = 0, 0
        for k in range(1, upper.shape[1]):
            i = k if upper[0, k] + upper[1, k] * x < upper[0, i] + upper[1, i] * x else i
            j = k if lower[0, k] + lower[1, k] * x > lower[0, j] + lower[1, j] * x else j
        room, slope = upper[0, i] - lower[0, j], lower[1, j] - upper[1, i]
        if not (slope > 0.0 and slope * x > room and room / slope < x):
            break
        x = room / slope
    return x


@compiled
def controllable(constraints: Stages, end: float) -> Array:
    """Return the largest x at each node from which x ≤ `end` can be reached at the end; shape (N + 1,)."""
    offsets, slopes = constraints.lower
    most = np.append(constraints.highest, end)
    for i in range(len(offsets) - 1, -1, -1):
        # No faster than the motion can brake to the largest x of the next node.
        half = 0.5 / constraints.lengths[i]
        for k in range(offsets.shape[1]):
            climb = slopes[i, k] + half
            if climb > 0.0:
                most[i] = min(most[i], (most[i + 1] * half - offsets[i, k]) / climb)
    return most


@compiled
def fastest(constraints: Stages, most: Array, start: float) -> Array:
    """Return x at each node, from at most `start`, for the largest u that keeps x within `most`; shape (N + 1,)."""
    offsets, slopes = constraints.upper
    x = np.empty(len(most))
    x[0] = min(start, most[0])
    for i in range(len(offsets)):
        u = np.inf
        for k in range(offsets.shape[1]):
            u = min(u, offsets[i, k] + slopes[i, k] * x[i])
        x[i + 1] = max(min(x[i] + 2.0 * constraints.lengths[i] * u, most[i + 1]), 0.0)
    return x
