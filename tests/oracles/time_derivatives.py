"""Derivatives in time of what can only be evaluated: by Chebyshev's interpolation of many samples around t = 0.

With the samples spread over the time in which the motion turns by a few radians to each side, the polynomial of
degree 28 is the function to rounding, and its k-th derivative loses about k digits.
"""

import math
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev

Array: TypeAlias = npt.NDArray[np.float64]

DEGREE = 28


def derivatives_in_time(function: Callable[[Array], Array], reach: float, orders: int) -> Array:
    """A function of times, one result a row, and its derivatives at t = 0 up to the given order; (orders + 1, …).

    Args:
        function: Results at times of shape (T,), [s].
        reach: How far from 0 the samples go, [s].
        orders: Of the derivatives.
    """
    nodes = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
    values = function(reach * nodes)
    series = np.linalg.solve(chebyshev.chebvander(nodes, DEGREE), values.reshape(len(nodes), -1))
    found = [chebyshev.chebval(0.0, chebyshev.chebder(series, k)) / reach**k for k in range(orders + 1)]
    return np.array(found).reshape(orders + 1, *values.shape[1:])


def path(q: Array, rates: Array) -> Callable[[Array], Array]:
    """Configurations at times, from q and its derivatives of shape (K, n), those beyond being zero."""
    terms = np.array([q, *rates])

    def positions(times: Array) -> Array:
        return np.array([sum(term * t**k / math.factorial(k) for k, term in enumerate(terms)) for t in times])

    return positions


def reach_of(rates: Array) -> float:
    """The time in which all joints together move by about 1.5 radians or metres."""
    totals = np.abs(rates).sum(axis=1)
    return float(1.5 / max(total ** (1.0 / k) for k, total in enumerate(totals, start=1)))


def motion_of_poses(Ts: Array) -> Array:
    """(p⁽ᵏ⁾; ω⁽ᵏ⁻¹⁾) from a pose and its derivatives, (K + 1, 4, 4): [ω]× = Ṙ Rᵀ, differentiated; shape (K, 6)."""
    Rs = Ts[:, :3, :3]
    motion = []
    for k in range(1, len(Ts)):
        spin = sum(math.comb(k - 1, j) * Rs[j + 1] @ Rs[k - 1 - j].T for j in range(k))
        motion.append([*Ts[k, :3, 3], spin[2, 1], spin[0, 2], spin[1, 0]])
    return np.array(motion)
