"""Nodes of a path, between which u = s̈ is constant, and the time law between them.

First they divide each piece evenly. Then some are added where u switches, and in intervals that take long or in which
q' changes much.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled, inlined

LARGEST_PATH = 100_000
"""Largest number of intervals times joints in the first run; the second run may double it."""
_STILL = 1e-12
"""Distance between nodes, in fractions of the path, below which they are the same."""
_LEAST_INTERVALS = 4
"""Least number of intervals per piece of the path."""
_NEAR = 1e-3
"""Distance of an extra node from each end, as a fraction of an interval, to resolve u there."""
_CHANGE = 0.25
"""Relative change of q' above which an interval is cut."""
_MOST_PARTS = 8
_SWITCH = 0.02
"""Change of u, as a fraction of the largest |u|, that counts as a switch."""


class UnitPath(NamedTuple):
    """A path of M pieces, scaled to 0 ≤ s ≤ 1, and how far it leads.

    Attributes:
        breaks, coefficients: Of the scaled path; shape (M + 1,), (M, d + 1, n).
        travels: How far each joint travels in each piece, at most, zero if it stands still; shape (M, n), [rad or m].
        largest: Largest magnitude of a travel or the start of a piece; infinite if one is not a number.
        rests: Whether q' = 0 at the start and at the end; shape (2,).
    """

    breaks: Array
    coefficients: Array
    travels: Array
    largest: float
    rests: Flags


@compiled
def measures(breaks: Array, coefficients: Array) -> UnitPath:
    """Scale a path and measure it."""
    count, size, n = coefficients.shape
    length = breaks[-1] - breaks[0]
    unit, travels, scaled = (breaks - breaks[0]) / length, np.zeros((count, n)), np.empty(coefficients.shape)
    slopes, largest = np.zeros((2, count, n)), 0.0
    for i in range(count):
        for j in range(n):
            for k in range(size):
                scaled[i, k, j] = coefficients[i, k, j] * length**k
                if k:
                    travels[i, j] += abs(coefficients[i, k, j]) * (breaks[i + 1] - breaks[i]) ** k
                    slopes[1, i, j] += k * scaled[i, k, j] * (unit[i + 1] - unit[i]) ** (k - 1)
            slopes[0, i, j] = scaled[i, 1, j] if size > 1 else 0.0
            for number in (abs(coefficients[i, 0, j]), travels[i, j]):
                largest = max(largest, number) if math.isfinite(number) else np.inf
    still = _STILL * np.abs(slopes).max() if slopes.size else 0.0
    ends = [not (np.abs(slope) > still).any() for slope in (slopes[0, 0], slopes[1, -1])]
    return UnitPath(unit, scaled, travels, largest, np.array(ends))


@compiled
def even_counts(breaks: Array, travels: Array, velocity: Array, intervals: int) -> Indices:
    """Return into how many intervals to divide each piece: more if it is long or takes long; shape (M,).

    Args:
        breaks: Of the path, from 0 to 1; shape (M + 1,).
        travels: How far each joint travels in each piece; shape (M, n), [rad or m].
        velocity: Limits; shape (n,), [rad/s or m/s].
        intervals: Approximate number of all intervals.
    """
    times = np.zeros(len(travels))
    for j in range(len(velocity)):
        times = np.maximum(times, travels[:, j] / velocity[j])
    shares = 0.5 * (np.diff(breaks) + times / times.sum())
    counts: Indices = np.maximum(np.ceil(shares * intervals - _STILL), _LEAST_INTERVALS).astype(np.int64)
    return counts


@compiled
def even_nodes(breaks: Array, counts: Indices) -> Array:
    """Divide each piece into equal intervals, and put one more node near each end of the path."""
    nodes, lengths, k = np.empty(counts.sum() + 3), np.diff(breaks), 1
    for piece in range(len(counts)):
        for part in range(counts[piece]):
            nodes[k] = breaks[piece] + part / counts[piece] * lengths[piece]
            k += 1
    nodes[0], nodes[1] = breaks[0], breaks[0] + _NEAR * lengths[0] / counts[0]
    nodes[-2], nodes[-1] = breaks[-1] - _NEAR * lengths[-1] / counts[-1], breaks[-1]
    return nodes


@compiled
def finer_nodes(nodes: Array, times: Array, law: Array, slopes: Array, velocity: Array, intervals: int) -> Array:
    """Add nodes where u switches, and in intervals that take long or in which q' changes much, evenly spaced in time.

    Args:
        nodes: From 0 to 1; shape (N + 1,).
        times, law: Of `time_law`.
        slopes: q' at the nodes; shape (N + 1, n).
        velocity: Limits; shape (n,), [rad/s or m/s].
        intervals: Approximate number of all intervals.
    """
    most = max(1, min(_MOST_PARTS, 2 * LARGEST_PATH // slopes.size))
    more, k = np.empty(len(nodes) * most), 0
    change = _SWITCH * np.abs(law[:, 2]).max()
    for i in range(len(law)):
        place = _switch(nodes, law, i, change)
        if place > 0.0:
            more[k] = place
            k += 1
        lasting = times[i + 1] - times[i]
        parts = max(lasting / times[-1] * intervals - 0.5, _bend(slopes[i], slopes[i + 1], velocity) / _CHANGE)
        count = max(1, math.ceil(min(parts, most)))
        for part in range(1, count):
            t = part / count * lasting
            more[k] = law[i, 0] + t * (law[i, 1] + t * law[i, 2])
            k += 1
    return _merged(nodes, np.sort(more[:k]))


@inlined
def _switch(nodes: Array, law: Array, i: int, change: float) -> float:
    """Return the place in an interval at which u switches, where the parabolas from both sides meet; 0 for none."""
    if not 0 < i < len(law) - 1:
        return 0.0
    before, here, after, length = law[i - 1, 2], law[i, 2], law[i + 1, 2], nodes[i + 1] - nodes[i]
    share = (here - after) / (before - after)
    return nodes[i] + share * length if abs(before - after) > change and 0.01 < share < 0.99 else 0.0


@inlined
def _bend(before: Array, after: Array, velocity: Array) -> float:
    """Return by how much q' changes, relative to its size; 0 where it is zero."""
    change, size = 0.0, 0.0
    for j in range(len(before)):
        change = max(change, abs(after[j] - before[j]) / velocity[j])
        size = max(size, abs(before[j]) / velocity[j], abs(after[j]) / velocity[j])
    return change / size if size > 0.0 else 0.0


@compiled
def _merged(nodes: Array, more: Array) -> Array:
    """Insert further places, increasing, except those that are the same as the one before."""
    found, k, i = np.empty(len(nodes) + len(more)), 0, 0
    previous = -1.0
    for place in more:
        while i < len(nodes) and nodes[i] <= place:
            found[k] = nodes[i]
            i, k = i + 1, k + 1
        if place - previous > _STILL and (k == 0 or place > found[k - 1]):
            found[k] = place
            k += 1
        previous = place
    found[k : k + len(nodes) - i] = nodes[i:]
    return found[: k + len(nodes) - i]


@compiled
def time_law(nodes: Array, x: Array) -> tuple[Array, Array]:
    """Return the times of nodes, from 0 on, (N + 1,), and s, ṡ, s̈/2 after each of the first N, (N, 3).

    The last time is NaN if a speed is not finite, or two successive ones are zero.
    """
    times, law = np.zeros(len(nodes)), np.empty((len(nodes) - 1, 3))
    for i in range(len(law)):
        length, speed, speeds = nodes[i + 1] - nodes[i], math.sqrt(x[i]), math.sqrt(x[i]) + math.sqrt(x[i + 1])
        is_moving = speeds > 0.0 and math.isfinite(x[i + 1])
        times[i + 1] = times[i] + 2.0 * length / speeds if is_moving else np.nan
        law[i] = nodes[i], speed, 0.25 * (x[i + 1] - x[i]) / length
    return times, law
