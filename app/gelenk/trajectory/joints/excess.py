"""Where a motion leaves the joint limits, found from its exact extremes, between which it is monotonic."""

from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import compiled
from gelenk.trajectory.joints.waypoints import WITHIN
from gelenk.trajectory.motion.extremes import candidates
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_HALVINGS = 60


class LimitExcess(NamedTuple):
    """A joint that leaves its limits.

    Attributes:
        time: When it leaves them, [s].
        joint: Index of the joint, from 0.
        value: Its extreme value in that piece of the motion, [rad or m].
        bound: The limit that it exceeds, [rad or m].
    """

    time: float
    joint: int
    value: float
    bound: float


def first_limit_excess(chain: Chain, motion: PiecewisePolynomial) -> LimitExcess | None:
    """Find the first time, or place on a path, at which a joint is more than 1e-9 beyond its limits, if any."""
    if _is_surely_within(chain, motion):
        return None
    times, values = candidates(motion)
    found = []
    for bounds, sign in ((chain.upper, 1.0), (chain.lower, -1.0)):
        furthest = (sign * values).max(axis=1)
        levels = sign * bounds + WITHIN
        for j in np.flatnonzero((furthest > levels).any(axis=0)):
            i = int(np.argmax(furthest[:, j] > levels[j]))
            time = _first_above(motion, i, int(j), sign, float(levels[j]), times[i, :, j])
            found.append(LimitExcess(time, int(j), float(sign * furthest[i, j]), float(bounds[j])))
    return min(found, default=None)


def _is_surely_within(chain: Chain, motion: PiecewisePolynomial) -> bool:
    """Check by a rough bound that all is within: no piece goes further from its start than Σ |c_k| hᵏ."""
    found: bool = swings_within(
        np.diff(motion.breaks), np.ascontiguousarray(motion.coefficients), chain.lower, chain.upper
    )
    return found


@compiled
def swings_within(widths: Array, c: Array, lower: Array, upper: Array) -> bool:
    """Check by a rough bound that all is within: no piece goes further from its start than Σ |c_k| hᵏ."""
    for i in range(len(c)):
        for j in range(len(lower)):
            swing = 0.0
            for k in range(c.shape[1] - 1, 0, -1):
                swing = (swing + abs(c[i, k, j])) * widths[i]
            if not (c[i, 0, j] + swing <= upper[j] and c[i, 0, j] - swing >= lower[j]):
                return False
    return True


def _first_above(
    motion: PiecewisePolynomial, piece: int, joint: int, sign: float, level: float, extremes: Array
) -> float:
    start = motion.breaks[piece]
    c = motion.coefficients[piece, ::-1, joint]
    times = np.sort(extremes) - start
    k = int(np.argmax(sign * np.polyval(c, times) > level))
    if k == 0:
        return float(start)
    low, high = float(times[k - 1]), float(times[k])
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if sign * float(np.polyval(c, middle)) > level else (middle, high)
    return float(start) + high
