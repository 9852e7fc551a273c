"""Polynomial pieces as the audit evaluates them, and the extremes of their derivatives.

The audit uses nothing from the planners: it scales each piece to τ from 0 to 1, and never computes roots. A polynomial
of degree m that is sampled at the N + 1 extremes of a Chebyshev polynomial, N > m, is nowhere larger than its largest
sample over cos(m π / 2N) [Ehlich1964]. So the samples show which pieces could hold a peak, and golden sections find it.
"""

import math
from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_MIN_INTERVALS = 12
_PLACES = 16
"""Least number of steps by which the travel of a whole motion is measured."""
_ROUNDING = 1e-13
_SAME = 1e-12
"""Share by which a piece must be able to exceed the largest sample to be searched."""
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)
_SECTIONS = 36
"""Golden sections of an interval, to 3e-8 of it: a peak is flat, so that its value is then exact."""


class Pieces(NamedTuple):
    """A motion as separate pieces, each scaled to τ from 0 to 1.

    Attributes:
        starts, widths: Start time and duration of each piece; shape (M,), [s].
        scaled: c_k hᵏ, the coefficients in τ; shape (M, degree + 1, n).
    """

    starts: Array
    widths: Array
    scaled: Array

    def between(self, begin: float, end: float) -> "Pieces":
        """Return the pieces whose middle lies between two times, [s]."""
        middles = self.starts + 0.5 * self.widths
        some = slice(*np.searchsorted(middles, (begin, end)))
        return Pieces(self.starts[some], self.widths[some], self.scaled[some])

    def times(self, piece: Indices, tau: Array) -> Array:
        """Return the times at τ of some pieces, [s]."""
        return self.starts[piece] + tau * self.widths[piece]


def pieces_of(motion: PiecewisePolynomial) -> Pieces:
    """The pieces of a motion."""
    return _scaled(np.ascontiguousarray(motion.breaks), np.ascontiguousarray(motion.coefficients))


@compiled
def _scaled(breaks: Array, coefficients: Array) -> Pieces:
    starts, widths, scaled = breaks[:-1].copy(), np.diff(breaks), coefficients.copy()
    for piece in range(len(widths)):
        power = 1.0
        for k in range(scaled.shape[1]):
            for joint in range(scaled.shape[2]):
                scaled[piece, k, joint] *= power
            power *= widths[piece]
    return Pieces(starts, widths, scaled)


@inlined
def _factor(k: int, order: int) -> float:
    """Return k!/(k - order)!, the factor of τ^(k - order) in a derivative of τᵏ."""
    factor = 1.0
    for i in range(order):
        factor *= k - i
    return factor


@inlined
def _by_tau(pieces: Pieces, piece: int, joint: int, tau: float, order: int) -> float:
    """Evaluate a derivative by τ of a joint."""
    value = 0.0
    for k in range(pieces.scaled.shape[1] - 1, order - 1, -1):
        value = value * tau + _factor(k, order) * pieces.scaled[piece, k, joint]
    return value


@inlined
def value_at(pieces: Pieces, piece: int, joint: int, tau: float, order: int) -> float:
    """Evaluate a time derivative of a joint at τ of a piece."""
    value: float = _by_tau(pieces, piece, joint, tau, order) / pieces.widths[piece] ** order
    return value


@compiled
def values_at(pieces: Pieces, piece: Indices, tau: Array, order: int) -> Array:
    """Evaluate a time derivative at τ of the given pieces; shape (N,) each → (N, n)."""
    found = np.empty((len(piece), pieces.scaled.shape[2]))
    for i in range(len(piece)):
        for joint in range(found.shape[1]):
            found[i, joint] = value_at(pieces, piece[i], joint, tau[i], order)
    return found


@compiled
def positions_at(pieces: Pieces, times: Array) -> Array:
    """Evaluate positions at times of shape (N,), [s]; shape (N, n)."""
    found, last = np.empty((len(times), pieces.scaled.shape[2])), len(pieces.starts) - 1
    for i in range(len(times)):
        piece = min(max(np.searchsorted(pieces.starts, times[i], side="right") - 1, 0), last)
        tau = (times[i] - pieces.starts[piece]) / pieces.widths[piece]
        for joint in range(found.shape[1]):
            found[i, joint] = _by_tau(pieces, piece, joint, tau, 0)
    return found


@compiled
def rate_bounds(pieces: Pieces) -> tuple[float, float]:
    """Return bounds of all velocities and accelerations, by the sums of their polynomials' coefficients."""
    velocity, acceleration = 0.0, 0.0
    for piece in range(len(pieces.widths)):
        for joint in range(pieces.scaled.shape[2]):
            first, second = 0.0, 0.0
            for k in range(1, pieces.scaled.shape[1]):
                size = k * abs(pieces.scaled[piece, k, joint])
                first, second = first + size, second + (k - 1.0) * size
            velocity = max(velocity, first / pieces.widths[piece])
            acceleration = max(acceleration, second / pieces.widths[piece] ** 2)
    return velocity, acceleration


@compiled
def extremes(pieces: Pieces, order: int, absolute: bool = False) -> tuple[Array, Array]:
    """Find each joint's highest value of a derivative, or largest magnitude, and its time [s]; shape (n,) each."""
    n = pieces.scaled.shape[2]
    best, where, at = np.full(n, -np.inf), np.zeros(n, np.int64), np.zeros(n)
    bounds = _at_ends(pieces, order, absolute, best, where, at)
    if pieces.scaled.shape[1] > order + 2:  # At degree 0 or 1 the extremes are at the ends.
        _between_ends(pieces, order, absolute, bounds, best, where, at)
    values, times = np.empty(n), np.empty(n)
    for joint in range(n):
        values[joint] = value_at(pieces, where[joint], joint, at[joint], order)
        times[joint] = pieces.starts[where[joint]] + at[joint] * pieces.widths[where[joint]]
    return values, times


@compiled
def _at_ends(pieces: Pieces, order: int, absolute: bool, best: Array, where: Indices, at: Array) -> Array:
    """Find the extremes at the pieces' ends, and return a bound of the values within each piece, (M, n).

    Nowhere is τᵏ above the chord between its ends, nor further below it than min((k - 1)/4, 1).
    """
    count, size, n = pieces.scaled.shape
    bounds, factors = np.zeros((count, n)), np.array([_factor(k, order) for k in range(size)])
    for piece in range(count):
        scale = _reciprocal(pieces.widths[piece], order)
        for joint in range(n):
            start, end, rise, dip = 0.0, 0.0, 0.0, 0.0
            for k in range(order, size):
                c = scale * factors[k] * pieces.scaled[piece, k, joint]
                start = c if k == order else start
                end += c
                sag = min(max(0.25 * (k - order - 1), 0.0), 1.0) * c
                rise, dip = rise - min(sag, 0.0), dip + max(sag, 0.0)
            bounds[piece, joint] = max(start, end) + rise
            if absolute:
                bounds[piece, joint] = max(bounds[piece, joint], dip - min(start, end))
                start, end = abs(start), abs(end)
            if start > best[joint] + _ROUNDING * abs(best[joint]) or piece == 0:
                best[joint], where[joint], at[joint] = start, piece, 0.0
            if end > best[joint] + _ROUNDING * abs(best[joint]):
                best[joint], where[joint], at[joint] = end, piece, 1.0
    return bounds


@compiled
def _between_ends(
    pieces: Pieces, order: int, absolute: bool, bounds: Array, best: Array, where: Indices, at: Array
) -> None:
    """Sample the pieces whose bound is above the extreme so far, and search those whose samples leave it possible."""
    degree = pieces.scaled.shape[1] - 1 - order
    nodes, factor = _nodes(degree)
    samples = np.empty(len(nodes))
    for piece in range(len(bounds)):
        for joint in range(len(best)):
            least = best[joint] + _SAME * abs(best[joint])
            if bounds[piece, joint] <= least:
                continue
            _sample(pieces, piece, joint, order, nodes, samples)
            low, high = samples.min(), samples.max()
            middle = abs(0.5 * (low + high)) if absolute else 0.5 * (low + high)
            if middle + 0.5 * factor * (high - low) > least:
                tau, size = _highest(pieces, piece, joint, order, absolute, nodes, samples)
                if size > best[joint] + _ROUNDING * abs(best[joint]):
                    best[joint], where[joint], at[joint] = size, piece, tau


@inlined
def _reciprocal(width: float, order: int) -> float:
    """Return width^-order."""
    scale = 1.0
    for _ in range(order):
        scale /= width
    return scale


@compiled
def _nodes(degree: int) -> tuple[Array, float]:
    """Return where polynomials of a degree are sampled, and the factor of [Ehlich1964]."""
    count = max(_MIN_INTERVALS, 2 * degree + 2)
    return 0.5 - 0.5 * np.cos(np.arange(count + 1) * (math.pi / count)), 1.0 / math.cos(0.5 * math.pi * degree / count)


@inlined
def _sample(pieces: Pieces, piece: int, joint: int, order: int, nodes: Array, samples: Array) -> None:
    samples[:] = 0.0
    scale = _reciprocal(pieces.widths[piece], order)
    for k in range(pieces.scaled.shape[1] - 1, order - 1, -1):
        c = scale * _factor(k, order) * pieces.scaled[piece, k, joint]
        for i in range(len(nodes)):
            samples[i] = samples[i] * nodes[i] + c


@inlined
def _highest(
    pieces: Pieces, piece: int, joint: int, order: int, absolute: bool, nodes: Array, samples: Array
) -> tuple[float, float]:
    """Search around each local maximum of the samples; return τ and the value."""
    last, at, best = len(nodes) - 1, 0.0, -np.inf
    for k in range(len(nodes)):
        sign = -1.0 if absolute and samples[k] < 0.0 else 1.0
        before, here, after = samples[max(k - 1, 0)], samples[k], samples[min(k + 1, last)]
        if sign * here >= sign * before and sign * here >= sign * after:
            low, high = nodes[max(k - 1, 0)], nodes[min(k + 1, last)]
            tau = _section(pieces, piece, joint, order, sign, low, high)
            size = sign * value_at(pieces, piece, joint, tau, order)
            if size > best:
                at, best = tau, size
    return at, best


@inlined
def _section(pieces: Pieces, piece: int, joint: int, order: int, sign: float, low: float, high: float) -> float:
    """Return τ of the highest value of a unimodal function between two places, by golden sections."""
    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_a, at_b = (sign * _by_tau(pieces, piece, joint, a, order), sign * _by_tau(pieces, piece, joint, b, order))
    for _ in range(_SECTIONS):
        if at_a < at_b:
            low, a, at_a = a, b, at_b
            b = low + _GOLDEN * (high - low)
            at_b = sign * _by_tau(pieces, piece, joint, b, order)
        else:
            high, b, at_b = b, a, at_a
            a = high - _GOLDEN * (high - low)
            at_a = sign * _by_tau(pieces, piece, joint, a, order)
    return 0.5 * (low + high)


@compiled
def largest_jumps(pieces: Pieces, order: int) -> tuple[Array, Array]:
    """Find the largest jump of a derivative of each joint where two pieces meet, and when; zero in a single piece."""
    size, n = pieces.scaled.shape[1:]
    jumps, times = np.zeros(n), np.full(n, pieces.starts[min(1, len(pieces.starts) - 1)])
    factors = np.array([_factor(k, order) for k in range(size)])
    for piece in range(1, len(pieces.starts)):
        before, after = _reciprocal(pieces.widths[piece - 1], order), _reciprocal(pieces.widths[piece], order)
        for joint in range(n):
            jump = 0.0
            for k in range(size - 1, order - 1, -1):
                jump += factors[k] * pieces.scaled[piece - 1, k, joint]
            jump *= before
            if order < size:
                jump -= after * factors[order] * pieces.scaled[piece, order, joint]
            if abs(jump) > jumps[joint]:
                jumps[joint], times[joint] = abs(jump), pieces.starts[piece]
    return jumps, times


@compiled
def joint_extremes(pieces: Pieces) -> tuple[Array, Array]:
    """Find the extremes of each joint and their times, [s]; shape (5, n) each.

    They are the opposite of the lowest position, the highest, and the largest magnitudes of three derivatives.
    """
    values, times = np.empty((5, pieces.scaled.shape[2])), np.empty((5, pieces.scaled.shape[2]))
    values[0], times[0] = extremes(Pieces(pieces.starts, pieces.widths, -pieces.scaled), 0, False)
    for order in range(4):
        values[order + 1], times[order + 1] = extremes(pieces, order, order > 0)
    return values, times


@compiled
def joint_jumps(pieces: Pieces) -> tuple[Array, Array]:
    """Find the largest jumps of position and three derivatives, and when, [s]; shape (4, n) each."""
    values, times = np.empty((4, pieces.scaled.shape[2])), np.empty((4, pieces.scaled.shape[2]))
    for order in range(4):
        values[order], times[order] = largest_jumps(pieces, order)
    return values, times


@compiled
def even_positions(pieces: Pieces, count: int) -> Array:
    """Evaluate positions at evenly spread times, from the start to the end; shape (count, n)."""
    return positions_at(pieces, np.linspace(pieces.starts[0], pieces.starts[-1] + pieces.widths[-1], count))


@compiled
def joint_ends(pieces: Pieces) -> Array:
    """Evaluate position, velocity and acceleration at the start and the end; shape (2, 3, n)."""
    found, last = np.empty((2, 3, pieces.scaled.shape[2])), len(pieces.widths) - 1
    for order in range(3):
        for joint in range(found.shape[2]):
            found[0, order, joint] = value_at(pieces, 0, joint, 0.0, order)
            found[1, order, joint] = value_at(pieces, last, joint, 1.0, order)
    return found


@compiled
def travel(pieces: Pieces) -> float:
    """Return how far all joints go together, at least, [rad or m]: from piece to piece, or places between in few."""
    steps, total = max(1, _PLACES // len(pieces.widths)), 0.0
    for piece in range(len(pieces.widths)):
        for joint in range(pieces.scaled.shape[2]):
            before = pieces.scaled[piece, 0, joint]
            for k in range(1, steps + 1):
                here = _by_tau(pieces, piece, joint, k / steps, 0)
                total, before = total + abs(here - before), here
    return total
