"""The fastest motion along a path, as one linear program: conditions at the nodes, the largest sum of ṡ².

Time-optimal speeds are the largest at every point of the path at once, so that they also have the largest sum.
"""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.optimize import linprog
from scipy.sparse import coo_array, vstack

Array = npt.NDArray[np.float64]


def duration(
    slope: Callable[[Array], Array], bend: Callable[[Array], Array], velocity: Array, acceleration: Array, count: int
) -> float:
    """How long the motion takes from rest to rest along 0 ≤ s ≤ 1, [s].

    Args:
        slope: q'(s); shape (N,) → (N, n).
        bend: q''(s).
        velocity: Limits; shape (n,).
        acceleration: Limits; shape (n,).
        count: Intervals.
    """
    s = np.linspace(0.0, 1.0, count + 1)
    first, second = slope(s), bend(s)
    # The variables are x_0 … x_count; s̈ between two nodes is half their difference by the length.
    rise = 0.5 * count * first
    i = np.arange(count)
    parts, bounds = [], []
    for j in range(len(velocity)):
        for node in (i, i + 1):
            values = (second[node, j], rise[node, j], -rise[node, j])
            columns = (node, i + 1, i)
            rows = coo_array(
                (np.concatenate(values), (np.tile(i, 3), np.concatenate(columns))), shape=(count, count + 1)
            )
            parts += [rows, -rows]
            bounds += [np.full(2 * count, acceleration[j])]
    with np.errstate(divide="ignore"):
        most = ((velocity / np.abs(first)) ** 2).min(axis=1)
    most[[0, -1]] = 0.0
    found = linprog(-np.ones(count + 1), vstack(parts).tocsr(), np.concatenate(bounds), bounds=[(0.0, x) for x in most])
    speeds = np.sqrt(np.maximum(found.x, 0.0))
    return float((2.0 / count / (speeds[1:] + speeds[:-1])).sum())
