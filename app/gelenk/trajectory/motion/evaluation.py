"""Compiled evaluation of piecewise polynomials."""

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled

_STEPS = 60
_SAME = 1e-13


@compiled
def evaluated(breaks: Array, coefficients: Array, times: Array, order: int) -> Array:
    """Evaluate values and derivatives up to `order`, 2 at most, by Horner's scheme; shape (order + 1, N, n)."""
    _, size, n = coefficients.shape
    found, inner = np.empty((order + 1, len(times), n)), breaks[1:-1]
    for i in range(len(times)):
        piece = np.searchsorted(inner, times[i], side="right")
        local = times[i] - breaks[piece]
        for j in range(n):
            value, first, second = 0.0, 0.0, 0.0
            for k in range(size - 1, -1, -1):
                second = second * local + 2.0 * first
                first = first * local + value
                value = value * local + coefficients[piece, k, j]
            found[0, i, j] = value
            if order > 0:
                found[1, i, j] = first
            if order > 1:
                found[2, i, j] = second
    return found


@compiled
def expanded(breaks: Array, coefficients: Array, nodes: Array) -> Array:
    """Expand polynomials about nodes, (N + 1,), which include all their breaks; shape (N, d + 1, n)."""
    _, size, n = coefficients.shape
    found, inner = np.empty((len(nodes) - 1, size, n)), breaks[1:-1]
    for i in range(len(found)):
        piece = np.searchsorted(inner, 0.5 * (nodes[i] + nodes[i + 1]), side="right")
        offset = nodes[i] - breaks[piece]
        found[i] = coefficients[piece]
        # Repeated Horner steps give the Taylor expansion about another point.
        for k in range(size - 1):
            for m in range(size - 2, k - 1, -1):
                for j in range(n):
                    found[i, m, j] += offset * found[i, m + 1, j]
    return found


@compiled
def composed(pieces: Array, laws: Array) -> Array:
    """Return the coefficients of Σ c_k σᵏ with σ = a_1 t + a_2 t² + …, by Horner's scheme; shape (N, D d + 1, n).

    Args:
        pieces: c; shape (N, D + 1, n).
        laws: a_0, which does not count, a_1, a_2, …; shape (N, d + 1).
    """
    count, size, n = pieces.shape
    d = laws.shape[1] - 1
    found = np.zeros((count, (size - 1) * d + 1, n))
    for i in range(count):
        found[i, 0] = pieces[i, -1]
        for k in range(size - 2, -1, -1):
            for power in range((size - 1 - k) * d, 0, -1):
                found[i, power] = 0.0
                for q in range(max(1, power - (size - 2 - k) * d), min(d, power) + 1):
                    for j in range(n):
                        found[i, power, j] += laws[i, q] * found[i, power - q, j]
            found[i, 0] = pieces[i, k]
    return found


@compiled
def reached(breaks: Array, coefficients: Array, values: Array, places: Array) -> Array:
    """Return when a non-decreasing motion of one coordinate is at places between its ends; shape (N,), [s].

    `values` are those at the breaks. Newton's method, and bisection where that would leave the piece.
    """
    times = np.empty(len(places))
    for i in range(len(places)):
        piece = min(max(np.searchsorted(values, places[i], side="right") - 1, 0), len(values) - 2)
        low, high = 0.0, breaks[piece + 1] - breaks[piece]
        t = 0.5 * high
        for _ in range(_STEPS):
            value, slope = 0.0, 0.0
            for k in range(coefficients.shape[1] - 1, -1, -1):
                slope = slope * t + value
                value = value * t + coefficients[piece, k, 0]
            off = value - places[i]
            low, high = (t, high) if off <= 0.0 else (low, t)
            newton = t - off / slope if slope > 0.0 else high
            following = newton if low <= newton <= high else 0.5 * (low + high)
            if abs(following - t) <= _SAME * breaks[-1]:
                break
            t = following
        times[i] = breaks[piece] + t
    return times


@compiled
def hermite(starts: Array, ends: Array, durations: Array, conditions: Array) -> Array:
    """Return polynomials with given derivatives at both ends, (m, M, n) each; shape (M, 2m, n).

    The conditions, (m, m), lead from what the start leaves of the m at λ = 1 to the coefficients of λᵐ … λ²ᵐ⁻¹.
    """
    m, count, n = starts.shape
    found, left = np.zeros((count, 2 * m, n)), np.empty(m)
    for i in range(count):
        h = durations[i]
        for j in range(n):
            scale = 1.0
            for k in range(m):
                found[i, k, j] = starts[k, i, j] * scale
                scale *= h / (k + 1.0)
            left[0] = ends[0, i, j] - starts[0, i, j] - found[i, 1:m, j].sum()
            for d in range(1, m):
                left[d] = ends[d, i, j] * h**d
                for k in range(d, m):
                    factor = 1.0
                    for step in range(d):
                        factor *= k - step
                    left[d] -= factor * found[i, k, j]
            for k in range(m):
                for d in range(m):
                    found[i, m + k, j] += conditions[k, d] * left[d]
            for k in range(1, 2 * m):
                found[i, k, j] /= h**k
    return found


@compiled
def eliminated(lower: Array, diagonal: Array, upper: Array, b: Array) -> Array:
    """Solve a tridiagonal, diagonally dominant system by Gauss's elimination; x has the shape (N, n) of b."""
    pivots, x = diagonal.copy(), b.copy()
    for i in range(1, len(x)):
        factor = lower[i] / pivots[i - 1]
        pivots[i] -= factor * upper[i - 1]
        x[i] -= factor * x[i - 1]
    for i in range(len(x) - 1, -1, -1):
        if i + 1 < len(x):
            x[i] -= upper[i] * x[i + 1]
        x[i] /= pivots[i]
    return x
