"""Compiled arc length of a curve p(u), and its inverse."""

import math

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined

_NODES, _WEIGHTS = (part.tolist() for part in np.polynomial.legendre.leggauss(10))
_GAUSS = tuple(zip(_NODES, _WEIGHTS, strict=True))
_STEPS = 40
_ROUNDING = 4e-16
_SQUARED = 1e-11
"""Error of the arc length, as a fraction of the whole, from which one more Newton step leaves only rounding errors."""
_TINY = 1e-300


@compiled
def arc_lengths(breaks: Array, velocity: Array, begin: Array, finish: Array) -> Array:
    """Return the arc lengths between pairs of u close together, within a piece each; shape (N,), [m].

    The velocity dp/du is given by its breaks, (M + 1,), and coefficients, (M, d + 1, 3), lowest power first.
    """
    lengths = np.empty(len(begin))
    for i in range(len(begin)):
        piece = np.searchsorted(breaks[1:-1], 0.5 * (begin[i] + finish[i]), side="right")
        lengths[i] = _length(velocity[piece], begin[i] - breaks[piece], finish[i] - breaks[piece])
    return lengths


@inlined
def _length(velocity: Array, begin: float, finish: float) -> float:
    half, total = 0.5 * (finish - begin), 0.0
    for node, weight in _GAUSS:
        total += weight * _speed(velocity, begin + half + half * node)
    return half * total


@inlined
def _speed(velocity: Array, u: float) -> float:
    x, y, z = 0.0, 0.0, 0.0
    for k in range(len(velocity) - 1, -1, -1):
        x, y, z = x * u + velocity[k, 0], y * u + velocity[k, 1], z * u + velocity[k, 2]
    return math.sqrt(x * x + y * y + z * z)


@compiled
def parameters(breaks: Array, velocity: Array, edges: Array, lengths: Array, s: Array, guesses: Array) -> Array:
    """Return u(s) by Newton's method from guesses, kept within its panel; shape (N,).

    The panels have the given edges in u, and arc lengths up to them, (P + 1,); none crosses a break.
    """
    us, whole = np.empty(len(s)), lengths[-1]
    for i in range(len(s)):
        panel = min(max(np.searchsorted(lengths, s[i], side="right") - 1, 0), len(edges) - 2)
        low, high, wanted = edges[panel], edges[panel + 1], s[i] - lengths[panel]
        piece = np.searchsorted(breaks[1:-1], 0.5 * (low + high), side="right")
        since, first = breaks[piece], edges[panel] - breaks[piece]
        u = min(max(guesses[i], low), high)
        for _ in range(_STEPS):
            excess = _length(velocity[piece], first, u - since) - wanted
            if abs(excess) <= _ROUNDING * whole:
                break
            low, high = (u, high) if excess < 0.0 else (low, u)
            newton = u - excess / max(_speed(velocity[piece], u - since), _TINY)
            is_within = low <= newton <= high
            u = newton if is_within else 0.5 * (low + high)
            if is_within and abs(excess) <= _SQUARED * whole:
                break
        us[i] = u
    return us
