"""Peaks of a function between its samples, by repeated parabolic interpolation through three ever closer samples.

Three rounds find the peak of a smooth function to the last digits. At a kink, such as a singular value has at zero, the
parabola is of little use; the evenly spread places of each round then reduce the interval to less than a half.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined

Values: TypeAlias = Callable[[Array], Array]
"""C functions at P places each; shape (C, P) → (C, P)."""

EXACT = 1e-12
"""Relative accuracy of a peak."""
MOST = 16
"""Largest number of sample triples of one function that are refined."""
ROUNDS = 12
_BEYOND = 0.125
"""Share of an interval by which a parabola's vertex may lie outside the interval that contains the peak."""
_OFFSETS = (np.arange(5) + 0.5) / 5.0
"""Sampled places, in fractions of an interval."""
_BESIDE = 1.0 / 64.0
"""Distance of two further ones from the vertex of the parabola, likewise."""
_TRUST = 1e-3
"""Largest share of a parabola's error that the next round leaves, where it is right to second order."""


def highest(values_at: Values, places: Array, values: Array, exact: Array) -> tuple[Array, Array]:
    """Return the maximum of each function between the outer two of three places, and where it is; shape (C,) each.

    Args:
        places: Three places for each of the C functions, increasing; shape (C, 3).
        values: Values there; shape (C, 3).
        exact: How much higher a peak may be than the value found; shape (C,).
    """
    rows, start = np.arange(len(places)), values.argmax(axis=1)
    best, where = values[rows, start], places[rows, start]
    if len(rows):
        places, values = places.copy(), values.copy()
        for _ in range(ROUNDS):
            at = tried(places, values)
            found = np.ascontiguousarray(values_at(at))
            if narrowed(places, values, at, found, best, where, exact):
                break
    return best, where


@compiled
def tried(places: Array, values: Array) -> Array:
    """Return the places to try next between each three: the vertex of the parabola, beside it, and evenly spread."""
    found = np.empty((len(places), len(_OFFSETS) + 3))
    for c in range(len(places)):
        low, high = places[c, 0], places[c, 2]
        vertex = _vertex(places[c], values[c])[0]
        for k in range(3):
            found[c, k] = min(max(vertex + (k - 1.0) * _BESIDE * (high - low), low), high)
        for k in range(len(_OFFSETS)):
            found[c, 3 + k] = low + _OFFSETS[k] * (high - low)
    return found


@compiled
def narrowed(places: Array, values: Array, at: Array, found: Array, best: Array, where: Array, exact: Array) -> bool:
    """Replace each three places by the best that was tried and its neighbours; return whether all peaks are exact."""
    done, count = True, at.shape[1]
    x, f = np.empty(count + 3), np.empty(count + 3)
    for c in range(len(places)):
        expected = _vertex(places[c], values[c])[1]
        x[:count], x[count:], f[:count], f[count:] = at[c], places[c], found[c], values[c]
        order = np.argsort(x)
        peak = 0
        for k in range(len(order)):
            if f[order[k]] > f[order[peak]]:
                peak = k
        if f[order[peak]] > best[c]:
            best[c], where[c] = f[order[peak]], x[order[peak]]
        wrong = abs(best[c] - expected)
        first = min(max(peak - 1, 0), len(order) - 3)
        for k in range(3):
            places[c, k], values[c, k] = x[order[first + k]], f[order[first + k]]
        # Where the parabola was right, each round brings the points 32 times closer.
        if max(_vertex(places[c], values[c])[1] - best[c], _TRUST * wrong) > exact[c]:
            done = False
    return done


@inlined
def _vertex(x: Array, f: Array) -> tuple[float, float]:
    """Return the maximum of the parabola through three points between its outer two: place and value."""
    vertex, height, bend = _parabola(x[0], x[1], x[2], f[0], f[1], f[2])
    if bend < 0.0 and x[0] <= vertex <= x[2]:
        return vertex, height
    k = 0 if f[0] >= f[1] and f[0] >= f[2] else 1 if f[1] >= f[2] else 2
    return x[k], f[k]


@inlined
def _parabola(x0: float, x1: float, x2: float, f0: float, f1: float, f2: float) -> tuple[float, float, float]:
    """Return the vertex, its value and the bend of the parabola through three points."""
    first, second = (f1 - f0) / (x1 - x0), (f2 - f1) / (x2 - x1)
    bend = (second - first) / (x2 - x0)
    vertex = 0.5 * (x0 + x1 - first / bend)
    return vertex, f0 + (vertex - x0) * (first + bend * (vertex - x1)), bend


@compiled
def triples(places: Array, values: Array, rows: Indices, columns: Indices) -> tuple[Array, Array, Array, Array]:
    """Return three places and values around samples of functions, (C, 3) each, and the best of each, (C,) twice."""
    near, found = np.empty((len(rows), 3)), np.empty((len(rows), 3))
    best, where = np.empty(len(rows)), np.empty(len(rows))
    for c in range(len(rows)):
        for k in range(3):
            near[c, k], found[c, k] = places[rows[c] - 1 + k], values[rows[c] - 1 + k, columns[c]]
        best[c], where[c] = found[c].max(), near[c, found[c].argmax()]
    return near, found, best, where


@compiled
def promising(places: Array, values: Array, rows: Indices, least: Array) -> tuple[Indices, Indices, Indices, Array]:
    """Find the samples near which a function may peak above its largest sample.

    The parabola through a sample and its two neighbours estimates the peak; its bend bounds the error. This also covers
    many equally high samples, as along a limit, where the samples alone do not show between which of them a peak lies.

    Args:
        places: Increasing around each of the rows; shape (N,).
        values: Of Q functions; shape (N, Q).
        rows: Samples whose neighbours belong to the same stretch of the functions; shape (K,).
        least: Height above the largest sample up to which peaks do not matter; shape (Q,).

    Returns:
        Rows and columns of the samples, at most `MOST` of each function, shape (C,); the row of each function's largest
        sample, and the accuracy that its peak needs, shape (Q,).
    """
    functions = values.shape[1]
    chosen, columns = np.empty(functions * MOST, np.int64), np.empty(functions * MOST, np.int64)
    tops, exact = np.empty(functions, np.int64), np.empty(functions)
    heights, first = np.empty(MOST), 0
    for q in range(functions):
        function = values[:, q]
        tops[q], count = function.argmax(), 0
        exact[q] = max(least[q], EXACT * max(abs(function[tops[q]]), abs(function.min())))
        for row in rows:
            height = _height(places, function, row, function[tops[q]] + exact[q])
            k = count if count < MOST else int(heights.argmin())
            if height > (-np.inf if k == count else heights[k]):
                chosen[first + k], columns[first + k], heights[k] = row, q, height
                count = max(count, k + 1)
        first += count
    return chosen[:first], columns[:first], tops, exact


@inlined
def _height(places: Array, values: Array, row: int, least: float) -> float:
    """Return the height of the parabola around a sample if a peak above `least` may be near it, else -∞."""
    x0, x1, x2 = places[row - 1], places[row], places[row + 1]
    f0, f1, f2 = values[row - 1], values[row], values[row + 1]
    width = x2 - x0
    # A quick bound first, from the bend alone.
    first, second = (f1 - f0) / (x1 - x0), (f2 - f1) / (x2 - x1)
    if not max(f0, f1, f2) + 0.5 * (first - second) * width > least:
        return -np.inf
    vertex, height, bend = _parabola(x0, x1, x2, f0, f1, f2)
    rises = bend < 0.0 and height - 0.25 * bend * width**2 > least
    if rises and x0 - _BEYOND * width < vertex < x2 + _BEYOND * width:
        return height
    return -np.inf
