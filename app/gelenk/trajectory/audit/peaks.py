"""Peaks of a function between its samples, by repeated parabolic interpolation through three ever closer samples.

Three rounds find the peak of a smooth function to the last digits. At a kink, such as a singular value has at zero, the
parabola is of little use; the evenly spread places of each round then reduce the interval to a quarter.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from gelenk.robot.arrays import Array, Flags, Indices

Values: TypeAlias = Callable[[Array], Array]
"""C functions at P places each; shape (C, P) → (C, P)."""

MOST = 16
"""Largest number of sample triples of one function that are refined."""
_ROUNDS = 8
_BEYOND = 0.125
"""Share of an interval by which a parabola's vertex may lie outside the interval that contains the peak."""
_OFFSETS = np.array([0.0, *((np.arange(8) + 0.5) / 8.0), 1.0])
"""Sampled places, in fractions of an interval; they omit the middle, where the parabola is often highest."""
_THREE = np.array([-1, 0, 1])
_TRUST = 1e-3
"""Largest share of a parabola's error that the next round leaves, where it is right to second order."""
_BESIDE = np.array([-1.0, 0.0, 1.0]) / 64.0


def highest(values_at: Values, places: Array, values: Array, exact: Array) -> tuple[Array, Array]:
    """Return the maximum of each function between the outer two of three places, and where it is; shape (C,) each.

    Args:
        places: Three places for each of the C functions, increasing; shape (C, 3).
        values: Values there; shape (C, 3).
        exact: How much higher a peak may be than the value found; shape (C,).
    """
    rows, start = np.arange(len(places)), values.argmax(axis=1)
    best, where = values[rows, start], places[rows, start]
    if not len(rows):
        return best, where
    vertices, expected = _vertices(places, values)
    for _ in range(_ROUNDS):
        low, width = places[:, :1], places[:, 2:] - places[:, :1]
        around = np.minimum(np.maximum(vertices[:, None] + _BESIDE * width, low), places[:, 2:])
        tried = np.sort(np.concatenate((low + _OFFSETS * width, around), axis=1), axis=1)
        found = values_at(tried)
        peak = found.argmax(axis=1)
        better = found[rows, peak] > best
        best, where = np.where(better, found[rows, peak], best), np.where(better, tried[rows, peak], where)
        wrong = np.abs(best - expected)
        near = (np.minimum(np.maximum(peak, 1), tried.shape[1] - 2)[:, None] + _THREE).ravel()
        each = np.repeat(rows, 3)
        places, values = tried[each, near].reshape(-1, 3), found[each, near].reshape(-1, 3)
        vertices, expected = _vertices(places, values)
        # Each round brings the points at least 4 times closer, and 32 times where the parabola was right.
        if not (np.maximum(expected - best, _TRUST * wrong) > exact).any():
            break
    return best, where


def _vertices(places: Array, values: Array) -> tuple[Array, Array]:
    """Return the maximum of each parabola between its outer two points: place and value; shape (C,) each."""
    vertices, heights, bends = _parabolas(places, values)
    low, high = places[:, 0], places[:, 2]
    inside = (bends < 0.0) & (vertices >= low) & (vertices <= high)
    rows, best = np.arange(len(places)), values.argmax(axis=1)
    return np.where(inside, vertices, places[rows, best]), np.where(inside, heights, values[rows, best])


def promising(places: Array, values: Array, rows: Indices, exact: Array) -> tuple[Indices, Indices]:
    """Return rows and columns, shape (C,) each, of samples near which a function may peak above its largest sample.

    The parabola through a sample and its two neighbours estimates the peak; its bend bounds the error. This also covers
    many equally high samples, as along a limit, where the samples alone do not show between which of them a peak lies.
    At most `MOST` are returned for each function.

    Args:
        places: Increasing around each of the rows; shape (N,).
        values: Of Q functions; shape (N, Q).
        rows: Samples whose neighbours belong to the same stretch of the functions; shape (K,).
        exact: Height above the largest sample up to which peaks are ignored; shape (Q,).
    """
    largest = values.max(axis=0) + exact
    chosen, columns = np.nonzero(_can_exceed(places, values, rows, largest))
    near = rows[chosen, None] + _THREE
    x, f = places[near], values[near, columns[:, None]]
    vertices, heights, bends = _parabolas(x, f)
    widths = x[:, 2] - x[:, 0]
    rises = (bends < 0.0) & (heights - 0.25 * bends * widths**2 > largest[columns])
    rises &= (vertices > x[:, 0] - _BEYOND * widths) & (vertices < x[:, 2] + _BEYOND * widths)
    chosen, columns, heights = chosen[rises], columns[rises], heights[rises]
    order = np.lexsort((-heights, columns))
    chosen, columns = chosen[order], columns[order]
    kept = np.arange(len(columns)) - np.searchsorted(columns, columns) < MOST
    return rows[chosen[kept]], columns[kept]


def _can_exceed(places: Array, values: Array, rows: Indices, least: Array) -> Flags:
    """Return which parabolas may exceed `least`, by a quick bound from their bends; shape (K, Q)."""
    widths = (places[rows + 1] - places[rows - 1])[:, None]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        slopes = np.diff(values, axis=0) / np.diff(places)[:, None]
        sags = 0.5 * (slopes[rows - 1] - slopes[rows]) * widths
        can: Flags = np.maximum(np.maximum(values[rows - 1], values[rows + 1]), values[rows]) + sags > least
    return can


def _parabolas(places: Array, values: Array) -> tuple[Array, Array, Array]:
    """Return the vertex, its value and the bend of the parabola through three points; shape (C,) each."""
    x0, x1, x2 = places.T
    f0, f1, f2 = values.T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        first, second = (f1 - f0) / (x1 - x0), (f2 - f1) / (x2 - x1)
        bends = (second - first) / (x2 - x0)
        vertices = 0.5 * (x0 + x1 - first / bends)
        return vertices, f0 + (vertices - x0) * (first + bends * (vertices - x1)), bends
