"""Compiled search for the zeros of a derivative, and for the largest value of many polynomials.

A polynomial lies between its least and its largest Bernstein coefficient. So only those whose coefficients exceed the
largest value found so far are examined closely.
"""

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined

_STEPS, _EXACT = 60, 1e-15
"""Most steps to a zero, and the last one's length."""
_SAME = 1e-12


@compiled
def stationary(c: Array) -> Array:
    """Find the zeros in [0, 1] of the derivative of polynomials, lowest power first; (M, d + 1, n) → (M, d - 1, n).

    The zeros of each derivative separate those of the one before it, so that between them each has one zero at most.
    Where there are fewer than d - 1, or the derivative does not change its sign, the rest is 0.
    """
    pieces, size, n = c.shape
    found, slope = np.zeros((pieces, max(size - 2, 0), n)), np.empty(max(size - 1, 1))
    for i in range(pieces):
        for j in range(n):
            for k in range(1, size):
                slope[k - 1] = k * c[i, k, j]
            _zeros(slope, found[i, :, j])
    return found


@compiled
def _zeros(c: Array, zeros: Array) -> None:
    """Write the zeros in (0, 1) of a polynomial of degree d at which its sign changes into the first of d places."""
    degree, count = len(c) - 1, 0
    edges = np.empty(degree + 2)
    for order in range(degree - 1, -1, -1):
        edges[0], edges[count + 1] = 0.0, 1.0
        for k in range(count):
            edges[k + 1] = zeros[k]
        last, count = count + 1, 0
        for k in range(last):
            low, high = edges[k], edges[k + 1]
            below, above = _derivative(c, order, low), _derivative(c, order, high)
            if below * above < 0.0:
                zeros[count] = _zero_between(c, order, low, high, below)
                count += 1
    zeros[count:] = 0.0


@inlined
def _derivative(c: Array, order: int, x: float) -> float:
    value = 0.0
    for k in range(len(c) - 1, order - 1, -1):
        factor = 1.0
        for i in range(order):
            factor *= k - i
        value = value * x + factor * c[k]
    return value


@inlined
def _zero_between(c: Array, order: int, low: float, high: float, below: float) -> float:
    """Return the one zero between two places of unlike sign by Newton's method, halving where that leads out."""
    x = 0.5 * (low + high)
    for _ in range(_STEPS):
        value, slope = _derivative(c, order, x), _derivative(c, order + 1, x)
        if value * below > 0.0:
            low = x
        else:
            high = x
        following = x - value / slope if slope != 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - x) <= _EXACT:
            return following
        x = following
    return x


@compiled
def largest(c: Array, durations: Array, order: int, limits: Array) -> tuple[float, int]:
    """Return the largest ratio of a derivative's magnitude to its limit, at least 0, and the coordinate's index.

    Args:
        c: Coefficients of polynomials in time; shape (M, d + 1, n).
        durations: Of the pieces; shape (M,).
        limits: Shape (M, n).
    """
    pieces, size, n = c.shape
    best, column, count = 0.0, 0, max(size - order, 1)
    rates, work = np.zeros((pieces, n, count)), np.empty(count)
    for i in range(pieces):
        for j in range(n):
            _store_ratios(c[i, :, j], durations[i], order, limits[i, j], rates[i, j])
            at_ends = max(abs(rates[i, j, 0]), abs(rates[i, j].sum()))
            best, column = (at_ends, j) if at_ends > best else (best, column)
    for i in range(pieces):
        for j in range(n):
            # The sum of magnitudes is a quick bound, larger than that of the hull.
            most = best * (1.0 + _SAME)
            if np.abs(rates[i, j]).sum() > most and _hull(rates[i, j], work) > most:
                value = _highest(rates[i, j])
                best, column = (value, j) if value > best else (best, column)
    return best, column


@inlined
def _store_ratios(c: Array, duration: float, order: int, limit: float, ratios: Array) -> None:
    """Write a derivative's coefficients, in fractions of a piece and of the limit."""
    power = 1.0 / limit
    for k in range(order, len(c)):
        factor = power
        for i in range(order):
            factor *= k - i
        ratios[k - order] = factor * c[k]
        power *= duration


@compiled
def _highest(c: Array) -> float:
    """Return the largest magnitude of a polynomial where it is stationary between 0 and 1, or at 0."""
    slope, zeros, highest = np.zeros(max(len(c) - 1, 1)), np.zeros(max(len(c) - 2, 0)), 0.0
    for k in range(1, len(c)):
        slope[k - 1] = k * c[k]
    _zeros(slope, zeros)
    for zero in zeros:
        highest = max(highest, abs(_derivative(c, 0, zero)))
    return highest


@inlined
def _hull(c: Array, work: Array) -> float:
    """Return the largest magnitude of the Bernstein coefficients."""
    degree, binomial, most = len(c) - 1, 1.0, 0.0
    for k in range(degree + 1):
        work[k] = c[k] / binomial
        binomial *= (degree - k) / (k + 1.0)
    for k in range(degree):
        for i in range(degree, k, -1):
            work[i] += work[i - 1]
    for value in work:
        most = max(most, abs(value))
    return most
