"""Angular velocity of R = Exp(θ) in the moving frame, and its derivative, for a time-varying rotation vector θ.

ω = A(θ) θ̇ and ω̇ = A(θ) θ̈ + β(θ, θ̇), where A = I - k₁ [θ]× + k₂ [θ]×² is the right Jacobian of SO(3) [Chirikjian2011].
"""

import math
from typing import TypeAlias

import numpy as np

from gelenk.robot.arrays import Array

_Coefficients: TypeAlias = tuple[Array, Array, Array, Array]

_SERIES = 1.0
"""Angle below which the coefficients come from power series, because the closed forms lose digits there, [rad]."""
_TERMS = np.arange(10)
_FIRST = (-1.0) ** _TERMS / [float(math.factorial(2 * j + 2)) for j in range(10)]
_SECOND = (-1.0) ** _TERMS / [float(math.factorial(2 * j + 3)) for j in range(10)]
_SLOPES = [np.append(2.0 * _TERMS[1:] * row[1:], 0.0) for row in (_FIRST, _SECOND)]
_SERIES_ROWS = np.array([_FIRST, _SECOND, *_SLOPES])


def skew(vectors: Array) -> Array:
    """Return [v]×, for which [v]× w = v × w; shape (N, 3) → (N, 3, 3)."""
    matrices = np.zeros((len(vectors), 3, 3))
    matrices[:, 2, 1], matrices[:, 0, 2], matrices[:, 1, 0] = vectors.T
    matrices[:, 1, 2], matrices[:, 2, 0], matrices[:, 0, 1] = -vectors.T
    return matrices


def rate_matrices(thetas: Array) -> Array:
    """Return A(θ), the right Jacobian of SO(3); shape (N, 3) → (N, 3, 3)."""
    k1, k2, _, _ = _coefficients(np.linalg.norm(thetas, axis=1))
    crosses = skew(thetas)
    matrices: Array = np.eye(3) - k1[:, None, None] * crosses + k2[:, None, None] * (crosses @ crosses)
    return matrices


def angular_motion(thetas: Array, rates: Array, second: Array) -> tuple[Array, Array]:
    """Return ω and ω̇ in the moving frame's axes from θ, θ̇, θ̈; shape (N, 3) each, [rad/s] and [rad/s²]."""
    coefficients = _coefficients(_sizes(thetas))
    k1, k2 = coefficients[:2]
    quadratic = _quadratic_part(coefficients, thetas, rates)
    return _applied(k1, k2, thetas, rates), _applied(k1, k2, thetas, second) + quadratic


def quadratic_part(thetas: Array, rates: Array) -> Array:
    """Return β(θ, θ̇), the angular acceleration for θ̈ = 0; shape (N, 3) each."""
    return _quadratic_part(_coefficients(_sizes(thetas)), thetas, rates)


def _quadratic_part(coefficients: _Coefficients, thetas: Array, rates: Array) -> Array:
    _, k2, slope1, slope2 = coefficients
    growth = np.einsum("ij,ij->i", thetas, rates)
    once = _crossed(thetas, rates)
    part: Array = (growth * slope2)[:, None] * _crossed(thetas, once) - (growth * slope1)[:, None] * once
    part += k2[:, None] * _crossed(rates, once)
    return part


def _applied(k1: Array, k2: Array, thetas: Array, vectors: Array) -> Array:
    """Multiply A(θ) by vectors; shape (N, 3)."""
    once = _crossed(thetas, vectors)
    products: Array = vectors - k1[:, None] * once + k2[:, None] * _crossed(thetas, once)
    return products


def _crossed(a: Array, b: Array) -> Array:
    """Return cross products a × b of shape (N, 3); for a few pairs several times faster than NumPy's."""
    (x, y, z), (u, v, w) = a.T, b.T
    products = np.empty_like(a)
    products[:, 0], products[:, 1], products[:, 2] = y * w - z * v, z * u - x * w, x * v - y * u
    return products


def _sizes(vectors: Array) -> Array:
    sizes: Array = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    return sizes


def _coefficients(n: Array) -> _Coefficients:
    """Return k₁ = (1 - cos n)/n², k₂ = (n - sin n)/n³, and k₁'/n, k₂'/n; shape (N,) each."""
    small = n < _SERIES
    if small.all():
        return _by_series(n * n)
    if not small.any():
        return _in_closed_form(n)
    by_series, closed = _by_series(np.where(small, n, 0.0) ** 2), _in_closed_form(np.where(small, 1.0, n))
    k1, k2, slope1, slope2 = (np.where(small, *both) for both in zip(by_series, closed, strict=True))
    return k1, k2, slope1, slope2


def _by_series(x: Array) -> _Coefficients:
    """Compute the coefficients from x = n² by their power series."""
    k1, k2, slope1, slope2 = _SERIES_ROWS[:, -1:] + 0.0 * x
    for j in range(len(_TERMS) - 2, -1, -1):
        a, b, c, d = _SERIES_ROWS[:, j]
        k1, k2, slope1, slope2 = k1 * x + a, k2 * x + b, slope1 * x + c, slope2 * x + d
    return k1, k2, slope1, slope2


def _in_closed_form(n: Array) -> _Coefficients:
    cosine, sine, square = np.cos(n), np.sin(n), n * n
    k1, k2 = (1.0 - cosine) / square, (n - sine) / (square * n)
    slope1 = (n * sine - 2.0 * (1.0 - cosine)) / (square * square)
    slope2 = (3.0 * sine - 2.0 * n - n * cosine) / (square * square * n)
    return k1, k2, slope1, slope2
