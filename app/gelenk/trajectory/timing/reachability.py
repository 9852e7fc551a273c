"""Reachability along a path: the speeds from which its end can be reached, and the fastest among them [Pham2018].

The path is cut into intervals of length Δ. In each of them u = s̈ is constant, so x = ṡ² goes from x_i to x_i + 2Δu.
The admissible points (u, x_i) of an interval form a convex polygon, given by rows αu + βx ≤ 1; it always contains rest,
u = x = 0. For a given x, the rows bound u from above and from below by lines in x; eliminating u from pairs of such
lines leaves bounds of x. All pairs except those with the speed at the next node are evaluated in advance, so one step
costs only three vector operations.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array

_NO_WEIGHT = 1e-12
"""α of a row, as a fraction of the largest in its interval, below which the row does not bound u."""
_UNBOUNDED = 1e30
_MOST_STEPS = 100


@dataclass(frozen=True, slots=True)
class Stages:
    """Constraints of a motion in each of N intervals.

    Attributes:
        lengths: Δ; shape (N,).
        upper: Offsets and slopes of the lines in x that bound u from above, ∞ and 0 for none; shape (2, N, m).
        lower: The same for those that bound u from below, -∞ and 0 for none.
        highest: Largest x at the start of each interval from which the motion can continue; shape (N,).
        least_shares: Smallest fraction of x that must be left at the end of each interval; shape (N,).
    """

    lengths: Array
    upper: Array
    lower: Array
    highest: Array
    least_shares: Array


def stages(lengths: Array, alpha: Array, beta: Array, least_shares: Array) -> Stages:
    """Build the constraints of intervals from their rows αu + βx ≤ 1.

    Args:
        lengths: Δ > 0; shape (N,).
        alpha, beta: α and β; shape (N, m).
        least_shares: Those of `Stages`, from 0 to 1. Without them, where q' of a joint changes sign, the largest x may
            be one from which the motion can only stop.
    """
    is_without = np.abs(alpha) <= _NO_WEIGHT * np.abs(alpha).max(axis=1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        offsets, slopes = 1.0 / alpha, -beta / alpha
        bounds = np.where(is_without & (beta > 0.0), 1.0 / beta, _UNBOUNDED)
    is_above, is_below = ~is_without & (alpha > 0.0), ~is_without & (alpha < 0.0)
    upper = np.stack((np.where(is_above, offsets, np.inf), np.where(is_above, slopes, 0.0)))
    lower = np.stack((np.where(is_below, offsets, -np.inf), np.where(is_below, slopes, 0.0)))
    # x_i + 2Δu ≥ share x_i.
    onward = np.stack((np.zeros_like(lengths), -0.5 * (1.0 - least_shares) / lengths))[:, :, None]
    highest = _highest(upper, np.concatenate((lower, onward), axis=2), np.minimum(bounds.min(axis=1), _UNBOUNDED))
    return Stages(lengths, upper, lower, highest, least_shares)


def _highest(upper: Array, lower: Array, x: Array) -> Array:
    """Return the largest x at which no upper line is below a lower one, by Newton's method from the right.

    The gap between the lowest upper and the highest lower line is concave in x and nonnegative at 0: every step ends
    to the right of the zero, and finitely many steps reach it.
    """
    rows = np.arange(len(x))
    for _ in range(_MOST_STEPS):
        i = (upper[0] + upper[1] * x[:, None]).argmin(axis=1)
        j = (lower[0] + lower[1] * x[:, None]).argmax(axis=1)
        room = upper[0, rows, i] - lower[0, rows, j]
        slope = lower[1, rows, j] - upper[1, rows, i]
        is_crossing = (slope > 0.0) & (slope * x > room)
        if not is_crossing.any():
            break
        with np.errstate(divide="ignore", invalid="ignore"):
            nearer = np.where(is_crossing, room / slope, x)
        if (nearer >= x).all():
            break
        x = np.minimum(x, nearer)
    return x


def controllable(constraints: Stages, end: float) -> Array:
    """Return the largest x at each node from which x ≤ `end` can be reached at the end; shape (N + 1,)."""
    most: Array = np.append(constraints.highest, end)
    halves = 0.5 / constraints.lengths
    climb = constraints.lower[1] + halves[:, None]
    with np.errstate(divide="ignore"):
        gains = np.where(climb > 0.0, 1.0 / climb, np.inf)
    offsets = constraints.lower[0]
    for i in range(len(constraints.lengths) - 1, -1, -1):
        # No faster than the motion can brake to the largest x of the next node.
        most[i] = min(most[i], ((most[i + 1] * halves[i] - offsets[i]) * gains[i]).min())
        if constraints.least_shares[i] > 0.0:
            most[i] = min(most[i], most[i + 1] / constraints.least_shares[i])
    return most


def fastest(constraints: Stages, most: Array, start: float) -> Array:
    """Return x at each node, from at most `start`, for the largest u that keeps x within `most`; shape (N + 1,)."""
    x = min(start, most[0])
    found = [x]
    for twice, offsets, slopes, upper in zip(2.0 * constraints.lengths, *constraints.upper, most[1:], strict=True):
        u = (offsets + slopes * x).min()
        x = max(min(x + twice * u, upper), 0.0)
        found.append(x)
    return np.array(found)
