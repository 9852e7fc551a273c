"""Compiled: angular velocity and acceleration of a turn that is given by its rotation vector θ, R = R_0 Exp(θ).

In the moving frame ω = A(θ) θ̇ and ω̇ = A(θ) θ̈ + β(θ, θ̇), where A = I - k₁ [θ]× + k₂ [θ]×² is the right Jacobian of
SO(3) [Chirikjian2011].
"""

import math
from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus, plus, row, scaled
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined

_SERIES = 1.0
"""Angle below which the coefficients come from power series, because the closed forms lose digits there, [rad]."""
_TERMS = range(10)
_FIRST = tuple((-1.0) ** j / math.factorial(2 * j + 2) for j in _TERMS)
_SECOND = tuple((-1.0) ** j / math.factorial(2 * j + 3) for j in _TERMS)

_Coefficients: TypeAlias = tuple[float, float, float, float]


@compiled
def rate_matrices(thetas: Array) -> Array:
    """Return A(θ), the right Jacobian of SO(3); shape (N, 3) → (N, 3, 3)."""
    matrices = np.empty((len(thetas), 3, 3))
    for i in range(len(thetas)):
        theta = row(thetas, i)
        k1, k2, _, _ = _coefficients(theta)
        for j, unit in enumerate(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))):
            column = _applied(theta, k1, k2, unit)
            for k in range(3):
                matrices[i, k, j] = column[k]
    return matrices


@compiled
def angular_motion(thetas: Array, rates: Array, second: Array) -> tuple[Array, Array]:
    """Return ω and ω̇ in the moving frame's axes from θ, θ̇, θ̈; shape (N, 3) each, [rad/s] and [rad/s²]."""
    omegas, alphas = np.empty(thetas.shape), np.empty(thetas.shape)
    for i in range(len(thetas)):
        theta, rate = row(thetas, i), row(rates, i)
        k1, k2, slope1, slope2 = _coefficients(theta)
        omega = _applied(theta, k1, k2, rate)
        quadratic = _quadratic(theta, k2, slope1, slope2, rate)
        alpha = plus(quadratic, 1.0, _applied(theta, k1, k2, row(second, i)))
        for k in range(3):
            omegas[i, k], alphas[i, k] = omega[k], alpha[k]
    return omegas, alphas


@compiled
def quadratic_parts(thetas: Array, rates: Array) -> Array:
    """Return β(θ, θ̇), the angular acceleration for θ̈ = 0; shape (N, 3) each."""
    parts = np.empty(thetas.shape)
    for i in range(len(thetas)):
        theta = row(thetas, i)
        _, k2, slope1, slope2 = _coefficients(theta)
        part = _quadratic(theta, k2, slope1, slope2, row(rates, i))
        for k in range(3):
            parts[i, k] = part[k]
    return parts


@inlined
def _applied(theta: Vector, k1: float, k2: float, vector: Vector) -> Vector:
    """Return A(θ) times a vector."""
    once = cross(theta, vector)
    return plus(plus(vector, -k1, once), k2, cross(theta, once))


@inlined
def _quadratic(theta: Vector, k2: float, slope1: float, slope2: float, rate: Vector) -> Vector:
    growth, once = dot(theta, rate), cross(theta, rate)
    part = minus(scaled(growth * slope2, cross(theta, once)), scaled(growth * slope1, once))
    return plus(part, k2, cross(rate, once))


@inlined
def _coefficients(theta: Vector) -> _Coefficients:
    """Return k₁ = (1 - cos n)/n², k₂ = (n - sin n)/n³, and k₁'/n, k₂'/n, with n = ‖θ‖."""
    square = dot(theta, theta)
    n = math.sqrt(square)
    if n < _SERIES:
        k1, k2, slope1, slope2 = 0.0, 0.0, 0.0, 0.0
        for j in range(len(_FIRST) - 1, -1, -1):
            # The slopes are twice the derivatives by n².
            slope1, slope2 = slope1 * square + 2.0 * k1, slope2 * square + 2.0 * k2
            k1, k2 = k1 * square + _FIRST[j], k2 * square + _SECOND[j]
        return k1, k2, slope1, slope2
    cosine, sine = math.cos(n), math.sin(n)
    k1, k2 = (1.0 - cosine) / square, (n - sine) / (square * n)
    slope1 = (n * sine - 2.0 * (1.0 - cosine)) / (square * square)
    slope2 = (3.0 * sine - 2.0 * n - n * cosine) / (square * square * n)
    return k1, k2, slope1, slope2
