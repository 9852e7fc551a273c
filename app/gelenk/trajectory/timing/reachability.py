"""Reachability along a path: the speeds from which its end can be reached, and the fastest among them [Pham2018].

The path is cut into intervals of length Δ. In each of them u = s̈ is constant, so x = ṡ² goes from x_i to x_i + 2Δu.
The admissible points (u, x_i) of an interval form a convex polygon, given by rows αu + βx ≤ 1; it always contains rest,
u = x = 0. For a given x, the rows bound u from above and from below by lines in x. Where the lowest upper and the
highest lower one meet is the largest x; of all lines only those matter that bound u for a smaller x. Eight intervals
are examined at a time.
"""

from typing import NamedTuple

import numpy as np

from gelenk.kinematics.simd.lanes import LANES, Lanes, abs_lanes, bits, lanes, load, max_lanes, min_lanes, store, where
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined, unmanaged
from gelenk.trajectory.timing.joint_constraints import store_joint_rows

_NO_WEIGHT = 1e-12
"""α of a row, as a fraction of the largest in its interval, below which the row does not bound u."""
_UNBOUNDED = 1e30
_MOST_STEPS = 100
_ALL = (1 << LANES) - 1
"""A mask that is true in every lane."""


class Further(NamedTuple):
    """Further constraints on each interval, beside the joints'.

    Attributes:
        alpha, beta: Rows αu + βx ≤ 1; shape (N, m).
        squares: k² for k ≥ 1 times slower motion in the interval; shape (N,).
        least_shares: Smallest fraction of x, from 0 to 1, that must be left at the end of each interval; shape (N,).
            Without, where q' of a joint changes sign, the largest x may be one from which the motion can only stop.
    """

    alpha: Array
    beta: Array
    squares: Array
    least_shares: Array


class Stages(NamedTuple):
    """Constraints of a motion in each of N intervals.

    Attributes:
        lengths: Δ; shape (N,).
        lines: Offset and slope of the lines in x that bound u from above, and from below; shape (2, N, at most all, 2).
        counts: How many lines there are of each; shape (2, N).
        highest: Largest x at the start of each interval from which the motion can continue; shape (N,).
    """

    lengths: Array
    lines: Array
    counts: Indices
    highest: Array


class _Block(NamedTuple):
    """Work arrays for eight intervals, with a row of eight numbers for each value.

    Attributes:
        pieces: The path's coefficients, row k n + j for the power k of joint j.
        alpha, beta: α and β of each constraint, |αu + βx| ≤ 1 before αu + βx ≤ 1; then the offset of its line in x that
            bounds u from above, and the slope.
        below: The offset, with the same slope, of that which bounds u from below; like the other infinite for none.
        values: Δ, k², the slope of the line by which the least share bounds u, the largest x, and four lines.
    """

    pieces: Array
    alpha: Array
    beta: Array
    below: Array
    values: Array


_LENGTH, _SQUARE, _BRAKING, _HIGHEST, _LINES, _VALUES = 0, 1, 2, 3, 4, 12


@compiled
def stages(pieces: Array, lengths: Array, limits: Array, further: Further) -> Stages:
    """Build the constraints of intervals.

    Args:
        pieces: The path's polynomials from the start of each interval on; shape (N, d + 1, n).
        lengths: Δ > 0; shape (N,).
        limits: Of velocity and acceleration; shape (2, n).
    """
    count, size, n = pieces.shape
    pairs = (size - 1) * n
    most, squares = 3 * pairs + further.alpha.shape[1], pairs + further.alpha.shape[1]
    lines, counts = np.empty((2, count, most + 2, 2)), np.full((2, count), 2)
    found = Stages(lengths, lines, counts, np.empty(count))
    alpha, beta, values = np.empty((most + size) * LANES), np.empty(most * LANES), np.empty(_VALUES * LANES)
    block = _Block(np.empty(size * n * LANES), alpha, beta, np.empty(most * LANES), values)
    for first in range(0, count, LANES):
        for lane in range(LANES):
            _gather(block, pieces, lengths, further, min(first + lane, count - 1), lane)
        rows = store_joint_rows(block.pieces, size, load(values, _LENGTH), limits, alpha, beta, squares)
        _store_extremes(block, pairs, rows)
        for lane in range(min(LANES, count - first)):
            found.highest[first + lane] = values[_HIGHEST * LANES + lane]
            for k in range(8):
                lines[k // 4, first + lane, k % 4 // 2, k % 2] = values[(_LINES + k) * LANES + lane]
        _add_others(block, rows, first, found)
    return found


@inlined
def _gather(block: _Block, pieces: Array, lengths: Array, further: Further, i: int, lane: int) -> None:
    """Write what interval `i` is given into a lane."""
    _, size, n = pieces.shape
    pairs = (size - 1) * n
    for k in range(size):
        for j in range(n):
            block.pieces[(k * n + j) * LANES + lane] = pieces[i, k, j]
    for k in range(further.alpha.shape[1]):
        block.alpha[(pairs + k) * LANES + lane] = further.alpha[i, k]
        block.beta[(pairs + k) * LANES + lane] = further.beta[i, k]
    block.values[_LENGTH * LANES + lane] = lengths[i]
    block.values[_SQUARE * LANES + lane] = further.squares[i]
    # x_i + 2Δu ≥ share x_i.
    block.values[_BRAKING * LANES + lane] = -0.5 * (1.0 - further.least_shares[i]) / lengths[i]


@unmanaged
def _store_extremes(block: _Block, pairs: int, rows: int) -> None:
    """Find the largest x at which no upper line is below a lower one, by Newton's method from the right.

    The gap between the lowest upper and the highest lower line is concave in x and nonnegative at 0: every step ends
    to the right of the zero, and finitely many steps reach it. The innermost lines there and at 0 are stored.
    """
    x, first, first_slope = _store_lines(block, pairs, rows)
    for _ in range(_MOST_STEPS):
        upper, upper_slope, lower, lower_slope = _innermost(block, rows, x)
        room, slope = upper - lower, lower_slope - upper_slope
        is_smaller = (slope > 0.0) & (slope * x > room) & (room / slope < x)
        if not bits(is_smaller):
            break
        x = where(is_smaller, room / slope, x)
    store(block.values, _HIGHEST, x)
    _store_line(block, 0, first, first_slope)
    _store_line(block, 1, upper, upper_slope)
    _store_line(block, 2, lanes(0.0), load(block.values, _BRAKING))
    _store_line(block, 3, lower, lower_slope)


@inlined
def _store_line(block: _Block, k: int, offset: Lanes, slope: Lanes) -> None:
    store(block.values, _LINES + 2 * k, offset)
    store(block.values, _LINES + 2 * k + 1, slope)


@inlined
def _store_lines(block: _Block, pairs: int, rows: int) -> tuple[Lanes, Lanes, Lanes]:
    """Replace α and β by lines; return the largest x that rows without α allow, and the lowest upper line at x = 0."""
    slower, weight, highest = 1.0 / load(block.values, _SQUARE), lanes(0.0), lanes(_UNBOUNDED)
    first, first_slope = lanes(np.inf), lanes(0.0)
    for k in range(rows):
        weight = max_lanes(weight, abs_lanes(load(block.alpha, k)))
    for k in range(rows):
        a, b = load(block.alpha, k), load(block.beta, k)
        bounds = abs_lanes(a) > _NO_WEIGHT * weight
        if bits(bounds) != _ALL:
            most = abs_lanes(b) if k < pairs else b
            highest = where(bounds, highest, where(most > 0.0, min_lanes(slower / most, highest), highest))
        inverse = where(bounds, 1.0 / a, 0.0)
        offset, slope = slower * inverse, -b * inverse
        size = abs_lanes(offset)
        above = where(bounds & (offset > 0.0) if k >= pairs else bounds, size, np.inf)
        store(block.alpha, k, above)
        store(block.below, k, where(bounds & (offset < 0.0) if k >= pairs else bounds, -size, -np.inf))
        store(block.beta, k, slope)
        first, first_slope = where(above < first, above, first), where(above < first, slope, first_slope)
    return highest, first, first_slope


@inlined
def _innermost(block: _Block, rows: int, x: Lanes) -> tuple[Lanes, Lanes, Lanes, Lanes]:
    """Return the lowest upper and the highest lower line at x, each by offset and slope."""
    upper, upper_slope, lowest = lanes(np.inf), lanes(0.0), lanes(np.inf)
    lower, lower_slope = lanes(0.0), load(block.values, _BRAKING)
    highest = lower_slope * x
    for k in range(rows):
        offset, below, slope = load(block.alpha, k), load(block.below, k), load(block.beta, k)
        u, v = offset + slope * x, below + slope * x
        is_lower, is_higher = u < lowest, v > highest
        upper, upper_slope, lowest = (
            where(is_lower, offset, upper),
            where(is_lower, slope, upper_slope),
            where(is_lower, u, lowest),
        )
        lower, lower_slope, highest = (
            where(is_higher, below, lower),
            where(is_higher, slope, lower_slope),
            where(is_higher, v, highest),
        )
    return upper, upper_slope, lower, lower_slope


@compiled
def _add_others(block: _Block, rows: int, first: int, found: Stages) -> None:
    """Add the lines that are innermost somewhere between 0 and the largest x: beyond the two at its ends' crossing."""
    (x_upper, upper), (x_lower, lower) = _crossing(block, 0), _crossing(block, 2)
    most = min(LANES, len(found.lengths) - first)
    for k in range(rows):
        slope = load(block.beta, k)
        below = bits(load(block.alpha, k) + slope * x_upper < upper)
        above = bits(load(block.below, k) + slope * x_lower > lower)
        for lane in range(most if below | above else 0):
            place = k * LANES + lane
            if below >> lane & 1:
                _add(found, 0, first + lane, block.alpha[place], block.beta[place])
            if above >> lane & 1:
                _add(found, 1, first + lane, block.below[place], block.beta[place])


@inlined
def _add(found: Stages, side: int, i: int, offset: float, slope: float) -> None:
    line = found.counts[side, i]
    found.lines[side, i, line, 0], found.lines[side, i, line, 1] = offset, slope
    found.counts[side, i] += 1


@inlined
def _crossing(block: _Block, k: int) -> tuple[Lanes, Lanes]:
    """Return where the innermost line at 0 meets that at the largest x, and the u there; NaN if they are the same."""
    offset, slope = load(block.values, _LINES + 2 * k), load(block.values, _LINES + 2 * k + 1)
    x = (load(block.values, _LINES + 2 * k + 2) - offset) / (slope - load(block.values, _LINES + 2 * k + 3))
    return x, offset + slope * x


@compiled
def controllable(constraints: Stages, end: float) -> Array:
    """Return the largest x at each node from which x ≤ `end` can be reached at the end; shape (N + 1,)."""
    most = np.append(constraints.highest, end)
    for i in range(len(most) - 2, -1, -1):
        # No faster than the motion can brake to the largest x of the next node.
        half = 0.5 / constraints.lengths[i]
        for offset, slope in constraints.lines[1, i, : constraints.counts[1, i]]:
            if slope + half > 0.0:
                most[i] = min(most[i], (most[i + 1] * half - offset) / (slope + half))
    return most


@compiled
def fastest(constraints: Stages, most: Array, start: float) -> Array:
    """Return x at each node, from at most `start`, for the largest u that keeps x within `most`; shape (N + 1,)."""
    x = np.empty(len(most))
    x[0] = min(start, most[0])
    for i in range(len(most) - 1):
        u = np.inf
        for offset, slope in constraints.lines[0, i, : constraints.counts[0, i]]:
            u = min(u, offset + slope * x[i])
        x[i + 1] = max(min(x[i] + 2.0 * constraints.lengths[i] * u, most[i + 1]), 0.0)
    return x
