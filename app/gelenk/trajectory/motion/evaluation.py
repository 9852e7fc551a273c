"""Compiled evaluation of piecewise polynomials."""

import numpy as np

from gelenk.kinematics.simd.lanes import LANES, lanes, load, store
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, unmanaged

_STEPS = 60
_SAME = 1e-13


@compiled
def evaluated(breaks: Array, coefficients: Array, times: Array, order: int) -> Array:
    """Evaluate values and derivatives up to `order`, 2 at most, by Horner's scheme; shape (order + 1, N, n)."""
    _, size, n = coefficients.shape
    found, inner, piece = np.empty((order + 1, len(times), n)), breaks[1:-1], 0
    for i in range(len(times)):
        # Most are in the same piece as the one before.
        if times[i] < breaks[piece] or (piece < len(inner) and times[i] >= breaks[piece + 1]):
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

    Eight pieces are computed at a time.

    Args:
        pieces: c; shape (N, D + 1, n).
        laws: a_0, which does not count, a_1, a_2, …; shape (N, d + 1).
    """
    count, size, n = pieces.shape
    powers, most = laws.shape[1], (size - 1) * (laws.shape[1] - 1) + 1
    a, c, work = np.empty(powers * LANES), np.empty(size * n * LANES), np.empty(most * n * LANES)
    found = np.empty((count, most, n))
    for first in range(0, count, LANES):
        for lane in range(LANES):
            i = min(first + lane, count - 1)
            for q in range(powers):
                a[q * LANES + lane] = laws[i, q]
            for k in range(size * n):
                c[k * LANES + lane] = pieces[i, k // n, k % n]
        _store_composed(a, powers - 1, c, size, n, work)
        for lane in range(min(LANES, count - first)):
            for k in range(most * n):
                found[first + lane, k // n, k % n] = work[k * LANES + lane]
    return found


@unmanaged
def _store_composed(a: Array, d: int, c: Array, size: int, n: int, work: Array) -> None:
    """Store the coefficients of eight pieces, row k n + j for the power k of coordinate j."""
    for j in range(n):
        store(work, j, load(c, (size - 1) * n + j))
        for k in range(size - 2, -1, -1):
            for power in range((size - 1 - k) * d, 0, -1):
                total = lanes(0.0)
                for q in range(max(1, power - (size - 2 - k) * d), min(d, power) + 1):
                    total = total + load(a, q) * load(work, (power - q) * n + j)
                store(work, power * n + j, total)
            store(work, j, load(c, k * n + j))


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


@compiled
def are_apart(times: Array, share: float, resolved: float) -> bool:
    """Check whether times increase by more than `share` of what they span, and `resolved` of the largest of them."""
    least = max(share * (times.max() - times.min()), resolved * np.abs(times).max())
    apart = True
    for i in range(len(times) - 1):
        apart &= times[i + 1] - times[i] > least
    return apart


@compiled
def clamped(
    times: Array, knots: Array, first: Array, last: Array, conditions: Array
) -> tuple[Array, Array, Array, Array, Array, Array]:
    """Return the clamped spline through knots, (N, n), with velocities (n,) at its ends, as `splines` explains it.

    That is the diagonals of A, and b, the velocities at all knots, (N, n), and the pieces' coefficients, (N - 1, 4, n).
    """
    h, steps = np.diff(times), knots[1:] - knots[:-1]
    inner, n = len(times) - 2, knots.shape[1]
    lower, diagonal, upper = h[1:].copy(), 2.0 * (h[:-1] + h[1:]), h[:-1].copy()
    b, velocities = np.empty((inner, n)), np.empty(knots.shape)
    velocities[0], velocities[-1] = first, last
    for k in range(inner):
        for j in range(n):
            b[k, j] = 3.0 * (h[k] * (steps[k + 1, j] / h[k + 1]) + h[k + 1] * (steps[k, j] / h[k]))
    if inner:
        b[0] -= lower[0] * first
        b[-1] -= upper[-1] * last
        lower[0] = upper[-1] = 0.0
        velocities[1:-1] = eliminated(lower, diagonal, upper, b)
    starts, ends = np.zeros((2, inner + 1, n)), np.empty((2, inner + 1, n))
    starts[1], ends[0], ends[1] = velocities[:-1], steps, velocities[1:]
    pieces = hermite(starts, ends, h, conditions)
    pieces[:, 0] = knots[:-1]
    return lower, diagonal, upper, b, velocities, pieces
