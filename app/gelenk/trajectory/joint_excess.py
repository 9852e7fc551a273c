"""Where a motion of joints leaves their limits: by its exact extremes, between which it is monotonic."""

from typing import NamedTuple

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.trajectory.extremes import candidates
from gelenk.trajectory.joint_waypoints import WITHIN
from gelenk.trajectory.polynomial import PiecewisePolynomial

_HALVINGS = 60


class LimitExcess(NamedTuple):
    """A joint that leaves its limits.

    Attributes:
        time: When it does, [s].
        joint: Which, from 0.
        value: How far it goes in that piece of the motion, [rad or m].
        bound: The limit that it passes.
    """

    time: float
    joint: int
    value: float
    bound: float


def first_limit_excess(chain: Chain, motion: PiecewisePolynomial) -> LimitExcess | None:
    """The first time that a joint goes beyond its limits by more than 1e-9; None where all stay within.

    Args:
        chain: What moves; n variables.
        motion: Their values in time, or along a path.
    """
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
    """Whether all is within by a rough bound: no piece goes further from its start than Σ |c_k| hᵏ."""
    c = motion.coefficients
    powers = np.diff(motion.breaks)[:, None] ** np.arange(1, c.shape[1])
    swings = np.einsum("mk,mkj->mj", powers, np.abs(c[:, 1:]))
    return bool((c[:, 0] + swings <= chain.upper).all() and (c[:, 0] - swings >= chain.lower).all())


def _first_above(
    motion: PiecewisePolynomial, piece: int, joint: int, sign: float, level: float, extremes: Array
) -> float:
    """When a piece first comes above a level that one of its extremes is above, [s]."""
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
