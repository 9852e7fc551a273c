"""Places for names in a picture: beside what they name, on no line, and not on each other."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array

_DIRECTIONS = np.array([[math.cos(turn), math.sin(turn)] for turn in np.arange(16) * (math.pi / 8.0)])
_DISTANCES = (2.0, 6.0, 11.0, 17.0, 24.0)
"""Gaps between a name and its point, [pt]."""
_CROSSED, _COVERED, _LATER, _FAR = 9.0, 400.0, 8.0, 1.0
"""Costs of a point of a line below a name, of a common area with another one relative to the name's, of a place that is
not the best one, and of a point of distance."""

_ROOM, _CELL = 2.0, 1.25
"""Room around a name, and side of the cells by which points of lines are counted, [pt]."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """A name to be placed: its size (2,), and the points beside which it may stand, best first, (m, 2); [pt]."""

    size: Array
    places: Array


def placed(names: Sequence[Wanted], obstacles: Array) -> tuple[list[Array], float]:
    """Return the centre of each name, (2,) each, and the cost of all; obstacles are points of lines, (k, 2), [pt]."""
    boxes: list[tuple[Array, Array]] = []
    crossed, total = _Crossed(obstacles), 0.0
    for name in names:
        half = 0.5 * name.size
        centers, costs = _candidates(name, half)
        costs = costs + _CROSSED * crossed.counts(centers, half + _ROOM)
        for other, other_half in boxes:
            common = np.clip(half + other_half + 1.0 - np.abs(centers - other), 0.0, 2.0 * half)
            costs = costs + _COVERED * common.prod(axis=1) / name.size.prod()
        best = int(np.argmin(costs))
        boxes.append((centers[best], half))
        total += float(costs[best])
    return [center for center, _ in boxes], total


class _Crossed:
    """Counts points in boxes by a table of sums over a grid of square cells."""

    def __init__(self, points: Array) -> None:
        self._low = points.min(axis=0) - _CELL
        cells = ((points - self._low) / _CELL).astype(int) + 1
        self._sums = np.zeros(cells.max(axis=0) + 1)
        np.add.at(self._sums, (cells[:, 0], cells[:, 1]), 1.0)
        self._sums = self._sums.cumsum(axis=0).cumsum(axis=1)

    def counts(self, centers: Array, half: Array) -> Array:
        """Return the number of points in each box, (k,)."""
        most = np.array(self._sums.shape) - 1
        (left, low), (right, high) = (
            np.clip(np.rint((centers + sign * half - self._low) / _CELL).astype(int), 0, most).T for sign in (-1, 1)
        )
        found: Array = self._sums[right, high] - self._sums[left, high] - self._sums[right, low] + self._sums[left, low]
        return found


def _candidates(name: Wanted, half: Array) -> tuple[Array, Array]:
    """Return centres around the places of a name, and what they cost; the box of a name just clears its point."""
    centers, costs = [], []
    for rank, place in enumerate(name.places):
        for distance in _DISTANCES:
            # A box touches a circle around the point in each direction.
            reach = distance + np.abs(_DIRECTIONS) @ half * 0.8
            centers.append(place + reach[:, None] * _DIRECTIONS)
            costs.append(np.full(len(_DIRECTIONS), _LATER * rank + _FAR * distance))
    return np.concatenate(centers), np.concatenate(costs)
