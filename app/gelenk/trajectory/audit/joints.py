"""The joints' extremes along polynomial pieces, and their jumps where pieces meet.

Each polynomial lies between its least and its largest Bernstein coefficient, of which the first and the last are its
ends; eight pieces are computed at a time. So few pieces could hold a peak beyond those at the ends. A polynomial of
degree m that is sampled at the N + 1 extremes of a Chebyshev polynomial, N > m, is nowhere larger than its largest
sample over cos(m π / 2N) [Ehlich1964]; where that leaves a peak possible, golden sections find it, never roots.
"""

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.kinematics.simd.lanes import LANES, Lanes, bits, lanes, load, max_lanes, min_lanes, store
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined, unmanaged
from gelenk.trajectory.audit.pieces import Pieces, by_tau, factor_of, value_at

_Range: TypeAlias = tuple[Lanes, Lanes, Lanes, Lanes]
_ORDERS, _EXTREMES = 4, 5
_START, _END, _LOW, _HIGH = range(4)
_MIN_INTERVALS = 12
_ROUNDING = 1e-13
_SAME = 1e-12
"""Share by which a piece must be able to exceed the largest end to be searched."""
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
_SECTIONS = 36
"""Golden sections of an interval, to 3e-8 of it: a peak is flat, so that its value is then exact."""


class JointFigures(NamedTuple):
    """What the joints do in a motion.

    Attributes:
        extremes, times: The opposite of the lowest position, the highest, and the largest magnitudes of three
            derivatives, and when, [s]; shape (5, n) each.
        jumps, jump_times: The largest jumps of position and three derivatives, and when, [s]; shape (4, n) each.
            Zero in a single piece.
    """

    extremes: Array
    times: Array
    jumps: Array
    jump_times: Array


@compiled
def joint_figures(pieces: Pieces) -> JointFigures:
    """Find the extremes and the jumps of each joint."""
    n, ranges = pieces.scaled.shape[2], _ranges(pieces)
    extremes, jumps = np.empty((2, _EXTREMES, n)), np.zeros((2, _ORDERS, n))
    found = JointFigures(extremes[0], extremes[1], jumps[0], jumps[1])
    for row in range(_EXTREMES):
        order, signs = max(row - 1, 0), (1.0 if row else -1.0, -1.0 if row != 1 else 1.0)
        nodes, factor = _nodes(max(pieces.scaled.shape[1] - 1 - order, 0))
        for joint in range(n):
            piece, tau = _largest(pieces, ranges[order, joint], order, joint, signs, nodes, factor)
            value = value_at(pieces, piece, joint, tau, order)
            found.extremes[row, joint] = -value if row == 0 else value
            found.times[row, joint] = pieces.starts[piece] + tau * pieces.widths[piece]
    for order in range(_ORDERS):
        for joint in range(n):
            _store_jump(pieces, ranges[order, joint], found, order, joint)
    return found


@inlined
def _store_jump(pieces: Pieces, of_pieces: Array, found: JointFigures, order: int, joint: int) -> None:
    largest, where = 0.0, min(1, len(pieces.starts) - 1)
    for piece in range(1, len(pieces.starts)):
        jump = abs(of_pieces[_END, piece - 1] - of_pieces[_START, piece])
        if jump > largest:
            largest, where = jump, piece
    found.jumps[order, joint], found.jump_times[order, joint] = largest, pieces.starts[where]


@compiled
def _ranges(pieces: Pieces) -> Array:
    """Return start, end, lower and upper bound of each derivative in each piece; shape (4, n, 4, ≥ M)."""
    count, size, n = pieces.scaled.shape
    blocks = (count + LANES - 1) // LANES
    ranges = np.empty((_ORDERS, n, 4, blocks * LANES))
    ranges[size:] = 0.0
    block, rows = np.empty((size * n + _ORDERS) * LANES), np.empty(size * LANES)
    factors = np.array([[_bernstein_factor(size, k, order) for k in range(size)] for order in range(_ORDERS)])
    rows_of_ranges = ranges.ravel()
    for b in range(blocks):
        for lane in range(LANES):
            _gather(pieces, min(b * LANES + lane, count - 1), lane, block)
        for order in range(min(_ORDERS, size)):
            for joint in range(n):
                found = _range(block, size, n, order, joint, factors[order], rows)
                for k in range(4):
                    store(rows_of_ranges, ((order * n + joint) * 4 + k) * blocks + b, found[k])
    return ranges


@inlined
def _gather(pieces: Pieces, piece: int, lane: int, block: Array) -> None:
    """Write the coefficients of a piece into a lane, and below them the factors from derivatives by τ to those by t."""
    _, size, n = pieces.scaled.shape
    for k in range(size):
        for joint in range(n):
            block[(k * n + joint) * LANES + lane] = pieces.scaled[piece, k, joint]
    scale = 1.0
    for order in range(_ORDERS):
        block[(size * n + order) * LANES + lane] = scale
        scale /= pieces.widths[piece]


@inlined
def _bernstein_factor(size: int, k: int, order: int) -> float:
    """Return what c_k is multiplied with in a derivative, over the binomial coefficient of its power in there."""
    binomial = 1.0
    for i in range(k - order):
        binomial *= (size - 1.0 - order - i) / (i + 1.0)
    return factor_of(k, order) / binomial


@inlined
def _range(block: Array, size: int, n: int, order: int, joint: int, factors: Array, rows: Array) -> _Range:
    """Return start, end, and the least and largest Bernstein coefficient of a derivative in eight pieces."""
    d, scale = size - 1 - order, load(block, size * n + order)
    for k in range(d + 1):
        store(rows, k, factors[order + k] * load(block, (order + k) * n + joint))
    for k in range(d):
        for i in range(d, k, -1):
            store(rows, i, load(rows, i) + load(rows, i - 1))
    low = high = load(rows, 0)
    for k in range(1, d + 1):
        low, high = min_lanes(load(rows, k), low), max_lanes(load(rows, k), high)
    return scale * load(rows, 0), scale * load(rows, d), scale * low, scale * high


@inlined
def _size(value: float, signs: tuple[float, float]) -> float:
    """Return the larger of a value with one sign and with the other: its magnitude, if they differ."""
    return max(signs[0] * value, signs[1] * value)


@compiled
def _largest(
    pieces: Pieces,
    of_pieces: Array,
    order: int,
    joint: int,
    signs: tuple[float, float],
    nodes: Array,
    factor: float,
) -> tuple[int, float]:
    """Return the piece and τ at which a derivative of a joint is largest, with either sign, by what `_nodes` gives."""
    rows, blocks, eight = of_pieces.ravel(), of_pieces.shape[1] // LANES, np.empty(LANES)
    most = _most(rows, 2 * blocks, signs, eight)
    where, at, best = _largest_end(of_pieces, rows, most - _ROUNDING * abs(most), len(pieces.widths), signs)
    if pieces.scaled.shape[1] <= order + 2:
        return where, at  # At degree 0 or 1 the extremes are at the ends.
    samples, least = np.empty(len(nodes)), best + _SAME * abs(best)
    for b in range(blocks):
        if not _may_reach(rows, _LOW * blocks + b, _HIGH * blocks + b, signs, least):
            continue
        for piece in range(b * LANES, min((b + 1) * LANES, len(pieces.widths))):
            if max(_size(of_pieces[_LOW, piece], signs), _size(of_pieces[_HIGH, piece], signs)) <= least:
                continue
            _sample(pieces, piece, joint, order, nodes, samples)
            low, high = samples.min(), samples.max()
            if _size(0.5 * (low + high), signs) + 0.5 * factor * (high - low) > least:
                tau, size = _highest(pieces, piece, joint, order, signs, nodes, samples)
                if size > best + _ROUNDING * abs(best):
                    best, least, where, at = size, size + _SAME * abs(size), piece, tau
    return where, at


@unmanaged
def _most(rows: Array, count: int, signs: tuple[float, float], eight: Array) -> float:
    """Return the largest size in the first rows of eight numbers."""
    best = lanes(-np.inf)
    for k in range(count):
        best = max_lanes(_sizes(load(rows, k), signs), best)
    store(eight, 0, best)
    most: float = eight[0]
    for lane in range(1, LANES):
        most = max(most, eight[lane])
    return most


@inlined
def _largest_end(
    of_pieces: Array, rows: Array, least: float, count: int, signs: tuple[float, float]
) -> tuple[int, float, float]:
    """Return the first piece and τ of an end whose size is at least this, and that size."""
    blocks = of_pieces.shape[1] // LANES
    for b in range(blocks):
        if _may_reach(rows, _START * blocks + b, _END * blocks + b, signs, least):
            for piece in range(b * LANES, min((b + 1) * LANES, count)):
                for side in (_START, _END):
                    size = _size(of_pieces[side, piece], signs)
                    if size >= least:
                        return piece, float(side), size
    return 0, 0.0, -np.inf


@inlined
def _may_reach(rows: Array, low: int, high: int, signs: tuple[float, float], least: float) -> bool:
    """Check whether one of eight pieces may hold a value of this size, by two rows of bounds."""
    found: bool = bits(max_lanes(_sizes(load(rows, low), signs), _sizes(load(rows, high), signs)) >= least) != 0
    return found


@inlined
def _sizes(values: Lanes, signs: tuple[float, float]) -> Lanes:
    return max_lanes(signs[0] * values, signs[1] * values)


@compiled
def _nodes(degree: int) -> tuple[Array, float]:
    """Return where polynomials of a degree are sampled, and the factor of [Ehlich1964]."""
    count = max(_MIN_INTERVALS, 2 * degree + 2)
    return 0.5 - 0.5 * np.cos(np.arange(count + 1) * (math.pi / count)), 1.0 / math.cos(0.5 * math.pi * degree / count)


@inlined
def _sample(pieces: Pieces, piece: int, joint: int, order: int, nodes: Array, samples: Array) -> None:
    samples[:] = 0.0
    scale = pieces.widths[piece] ** order
    for k in range(pieces.scaled.shape[1] - 1, order - 1, -1):
        c = factor_of(k, order) * pieces.scaled[piece, k, joint] / scale
        for i in range(len(nodes)):
            samples[i] = samples[i] * nodes[i] + c


@inlined
def _highest(
    pieces: Pieces, piece: int, joint: int, order: int, signs: tuple[float, float], nodes: Array, samples: Array
) -> tuple[float, float]:
    """Search around each local maximum of the samples; return τ and the value."""
    last, at, best = len(nodes) - 1, 0.0, -np.inf
    for k in range(len(nodes)):
        side = signs[0] if signs[0] * samples[k] > signs[1] * samples[k] else signs[1]
        before, here, after = samples[max(k - 1, 0)], samples[k], samples[min(k + 1, last)]
        if side * here >= side * before and side * here >= side * after:
            low, high = nodes[max(k - 1, 0)], nodes[min(k + 1, last)]
            tau = _section(pieces, piece, joint, order, side, low, high)
            size = side * value_at(pieces, piece, joint, tau, order)
            if size > best:
                at, best = tau, size
    return at, best


@inlined
def _section(pieces: Pieces, piece: int, joint: int, order: int, sign: float, low: float, high: float) -> float:
    """Return τ of the highest value of a unimodal function between two places, by golden sections."""
    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_a, at_b = (sign * by_tau(pieces, piece, joint, a, order), sign * by_tau(pieces, piece, joint, b, order))
    for _ in range(_SECTIONS):
        if at_a < at_b:
            low, a, at_a = a, b, at_b
            b = low + _GOLDEN * (high - low)
            at_b = sign * by_tau(pieces, piece, joint, b, order)
        else:
            high, b, at_b = b, a, at_a
            a = high - _GOLDEN * (high - low)
            at_a = sign * by_tau(pieces, piece, joint, a, order)
    return 0.5 * (low + high)
