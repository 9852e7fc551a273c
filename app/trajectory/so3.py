"""Rotation vectors that change: R = Exp(θ), the angular velocity in the moving frame, and its derivative.

ω = A(θ) θ̇ and ω̇ = A(θ) θ̈ + β(θ, θ̇), where A = I - k₁ [θ]× + k₂ [θ]×² is the right Jacobian of SO(3) [Chirikjian2011].
"""

import math

import numpy as np

from app.model.arrays import Array

_SERIES = 1.0
"""Angle below which the coefficients come from their power series: their closed forms lose digits there, [rad]."""
_TERMS = np.arange(10)
_FIRST = (-1.0) ** _TERMS / [float(math.factorial(2 * j + 2)) for j in range(10)]
_SECOND = (-1.0) ** _TERMS / [float(math.factorial(2 * j + 3)) for j in range(10)]


def skew(vectors: Array) -> Array:
    """[v]×, so that [v]× w = v × w; shape (N, 3) → (N, 3, 3)."""
    matrices = np.zeros((len(vectors), 3, 3))
    matrices[:, 2, 1], matrices[:, 0, 2], matrices[:, 1, 0] = vectors.T
    matrices[:, 1, 2], matrices[:, 2, 0], matrices[:, 0, 1] = -vectors.T
    return matrices


def rate_matrices(thetas: Array) -> Array:
    """A(θ); shape (N, 3) → (N, 3, 3)."""
    k1, k2, _, _ = _coefficients(np.linalg.norm(thetas, axis=1))
    crosses = skew(thetas)
    matrices: Array = np.eye(3) - k1[:, None, None] * crosses + k2[:, None, None] * (crosses @ crosses)
    return matrices


def angular_velocities(thetas: Array, rates: Array) -> Array:
    """ω of the moving frame, in its own axes; shape (N, 3) each, [rad] and [rad/s] → [rad/s]."""
    k1, k2, _, _ = _coefficients(np.linalg.norm(thetas, axis=1))
    once = np.cross(thetas, rates)
    velocities: Array = rates - k1[:, None] * once + k2[:, None] * np.cross(thetas, once)
    return velocities


def angular_accelerations(thetas: Array, rates: Array, second: Array) -> Array:
    """ω̇ in the moving frame's axes from θ, θ̇, θ̈; shape (N, 3) each, [rad/s²]."""
    accelerations: Array = angular_velocities(thetas, second) + quadratic_part(thetas, rates)
    return accelerations


def quadratic_part(thetas: Array, rates: Array) -> Array:
    """β(θ, θ̇): what the angular acceleration is without θ̈; shape (N, 3) each."""
    _, k2, slope1, slope2 = _coefficients(np.linalg.norm(thetas, axis=1))
    growth = np.einsum("ij,ij->i", thetas, rates)
    once = np.cross(thetas, rates)
    part: Array = (growth * slope2)[:, None] * np.cross(thetas, once) - (growth * slope1)[:, None] * once
    part += k2[:, None] * np.cross(rates, once)
    return part


def _coefficients(n: Array) -> tuple[Array, Array, Array, Array]:
    """k₁ = (1 - cos n)/n², k₂ = (n - sin n)/n³, and k₁'/n, k₂'/n; shape (N,) each."""
    small = n < _SERIES
    x = np.where(small, n, 0.0) ** 2
    powers = x[:, None] ** _TERMS
    m = np.where(small, 1.0, n)
    cosine, sine = np.cos(m), np.sin(m)
    k1 = np.where(small, powers @ _FIRST, (1.0 - cosine) / m**2)
    k2 = np.where(small, powers @ _SECOND, (m - sine) / m**3)
    slopes = 2.0 * _TERMS[1:]
    slope1 = np.where(small, powers[:, :-1] @ (slopes * _FIRST[1:]), (m * sine - 2.0 * (1.0 - cosine)) / m**4)
    slope2 = np.where(small, powers[:, :-1] @ (slopes * _SECOND[1:]), (3.0 * sine - 2.0 * m - m * cosine) / m**5)
    return k1, k2, slope1, slope2
