"""Smooth paths through orientations: a spline with continuous angular acceleration.

Between two knots R(x) = R_k Exp(θ(x)), where θ is a cubic. The angular velocities at the knots are chosen so that the
angular acceleration is continuous. This makes the spline C², like a cubic spline of positions; SciPy's `RotationSpline`
computes the same interpolation. Each end has the mean angular velocity of its interval.

In the moving frame ω = A(θ) θ̇ and ω̇ = A(θ) θ̈ + β(θ, θ̇), where A = I - k₁ [θ]× + k₂ [θ]×² is the right Jacobian of
SO(3) [Chirikjian2011].
"""

import math
from dataclasses import dataclass
from typing import TypeAlias, cast

import numpy as np

from gelenk.robot.arrays import Array, cross_matrices
from gelenk.robot.notations import rotations_from_vectors, vectors_from_rotations
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.orientation_paths import travelled

_Coefficients: TypeAlias = tuple[Array, Array, Array, Array]

_SERIES = 1.0
"""Angle below which the coefficients come from power series, because the closed forms lose digits there, [rad]."""
_TERMS = np.arange(10)
_FIRST = (-1.0) ** _TERMS / [float(math.factorial(2 * j + 2)) for j in range(10)]
_SECOND = (-1.0) ** _TERMS / [float(math.factorial(2 * j + 3)) for j in range(10)]
_SLOPES = [np.append(2.0 * _TERMS[1:] * row[1:], 0.0) for row in (_FIRST, _SECOND)]
_SERIES_ROWS = np.array([_FIRST, _SECOND, *_SLOPES])
_ITERATIONS = 60
_CONVERGED = 1e-13


@dataclass(frozen=True, slots=True)
class RotationVectorPath:
    """A path R(x) = R_k Exp(θ(x)): R_k, (M, 3, 3), and θ, [rad], a polynomial of x from 0 to 1, on M pieces."""

    starts: Array
    vectors: PiecewisePolynomial

    @property
    def angle(self) -> float:
        """See `OrientationPath`."""
        return travelled(self, max(64, 8 * len(self.starts)))

    def at(self, x: Array) -> tuple[Array, Array, Array]:
        """See `OrientationPath`."""
        piece = np.searchsorted(self.vectors.breaks[1:-1], x, side="right")
        thetas, rates, second = self.vectors.rates_at(x)
        rotations = self.starts[piece] @ rotations_from_vectors(thetas)
        omegas, alphas = angular_motion(thetas, rates, second)
        return rotations, _turned(rotations, omegas), _turned(rotations, alphas)


def rotation_spline(rotations: Array, knots: Array) -> RotationVectorPath:
    """Return the C² spline through orientations, (M + 1, 3, 3), at x = `knots`, (M + 1,), increasing from 0 to 1."""
    steps = vectors_from_rotations(np.ascontiguousarray(rotations[:-1].transpose(0, 2, 1) @ rotations[1:]))
    widths = np.diff(knots)[:, None]
    omegas = np.vstack((steps[:1] / widths[:1], steps / widths))
    inverses = cast(Array, np.linalg.inv(rate_matrices(steps)))
    if len(steps) > 1:
        _solve(steps, widths, inverses, omegas)
    begin, finish = omegas[:-1], _turned(inverses, omegas[1:])
    coefficients = np.stack(
        (
            np.zeros_like(steps),
            begin,
            (3.0 * steps / widths - 2.0 * begin - finish) / widths,
            (begin + finish - 2.0 * steps / widths) / widths**2,
        ),
        axis=1,
    )
    return RotationVectorPath(rotations[:-1], PiecewisePolynomial(np.asarray(knots, dtype=float), coefficients))


def _solve(steps: Array, widths: Array, inverses: Array, omegas: Array) -> None:
    """Fill in the angular velocities at the inner knots that make the angular acceleration continuous there.

    2 A_k ω_k / h_k + 4 (1/h_k + 1/h_{k+1}) ω_{k+1} + 2 A_{k+1}⁻¹ ω_{k+2} / h_{k+1}
      = 6 (r_k / h_k² + r_{k+1} / h_{k+1}²) - β(r_k, A_k⁻¹ ω_{k+1}),
    where β is quadratic in ω: the system is solved repeatedly until ω no longer changes. The angular velocity is
    continuous even without convergence.
    """
    lower = 2.0 * rate_matrices(steps)[1:-1] / widths[1:-1, None]
    upper = 2.0 * inverses[1:-1] / widths[1:-1, None]
    diagonal = 4.0 * (1.0 / widths[:-1] + 1.0 / widths[1:])
    fixed = 6.0 * (steps[:-1] / widths[:-1] ** 2 + steps[1:] / widths[1:] ** 2)
    fixed[0] -= 2.0 * (rate_matrices(steps[:1])[0] @ omegas[0]) / widths[0]
    fixed[-1] -= 2.0 * (inverses[-1] @ omegas[-1]) / widths[-1]
    factors, pivots = _eliminated(lower, diagonal, upper)
    coefficients = _coefficients(sizes(steps[:-1]))
    for _ in range(_ITERATIONS):
        rates = _turned(inverses[:-1], omegas[1:-1])
        found = _substituted(factors, pivots, upper, fixed - _quadratic_part(coefficients, steps[:-1], rates))
        change = np.abs(found - omegas[1:-1]).max()
        omegas[1:-1] = found
        if change <= _CONVERGED * max(1.0, float(np.abs(found).max())):
            return


def _eliminated(lower: Array, diagonal: Array, upper: Array) -> tuple[Array, Array]:
    """Eliminate once for repeated use; return factors (M - 1, 3, 3) and inverse pivots (M, 3, 3).

    The matrix has off-diagonal blocks (M - 1, 3, 3), and on its diagonal numbers (M, 1) times the identity matrix.
    """
    factors, pivots = np.empty_like(lower), np.empty((len(diagonal), 3, 3))
    pivots[0] = np.eye(3) / diagonal[0]
    for i, block in enumerate(lower):
        factors[i] = block @ pivots[i]
        pivots[i + 1] = np.linalg.inv(diagonal[i + 1] * np.eye(3) - factors[i] @ upper[i])
    return factors, pivots


def _substituted(factors: Array, pivots: Array, upper: Array, right: Array) -> Array:
    solution = right.copy()
    for i, factor in enumerate(factors):
        solution[i + 1] -= factor @ solution[i]
    solution[-1] = pivots[-1] @ solution[-1]
    for i in range(len(right) - 2, -1, -1):
        solution[i] = pivots[i] @ (solution[i] - upper[i] @ solution[i + 1])
    return solution


def _turned(matrices: Array, vectors: Array) -> Array:
    return cast(Array, np.einsum("nij,nj->ni", matrices, vectors))


def rate_matrices(thetas: Array) -> Array:
    """Return A(θ), the right Jacobian of SO(3); shape (N, 3) → (N, 3, 3)."""
    k1, k2, _, _ = _coefficients(np.linalg.norm(thetas, axis=1))
    crosses = cross_matrices(thetas)
    return np.eye(3) - k1[:, None, None] * crosses + k2[:, None, None] * (crosses @ crosses)


def angular_motion(thetas: Array, rates: Array, second: Array) -> tuple[Array, Array]:
    """Return ω and ω̇ in the moving frame's axes from θ, θ̇, θ̈; shape (N, 3) each, [rad/s] and [rad/s²]."""
    coefficients = _coefficients(sizes(thetas))
    k1, k2 = coefficients[:2]
    quadratic = _quadratic_part(coefficients, thetas, rates)
    return _applied(k1, k2, thetas, rates), _applied(k1, k2, thetas, second) + quadratic


def vector_motion(rotations: Array, omegas: Array, alphas: Array) -> tuple[Array, Array, Array]:
    """Return θ, θ̇ and θ̈ of R = Exp(θ), ‖θ‖ ≤ π; the inverse of `angular_motion`.

    Shapes (N, 3, 3), and (N, 3) of the others, [rad], [rad/s] and [rad/s²].
    """
    thetas = vectors_from_rotations(rotations)
    inverses = cast(Array, np.linalg.inv(rate_matrices(thetas)))
    rates = _turned(inverses, omegas)
    quadratic = _quadratic_part(_coefficients(sizes(thetas)), thetas, rates)
    return thetas, rates, _turned(inverses, alphas - quadratic)


def _quadratic_part(coefficients: _Coefficients, thetas: Array, rates: Array) -> Array:
    """Return β(θ, θ̇), the angular acceleration for θ̈ = 0; shape (N, 3) each."""
    _, k2, slope1, slope2 = coefficients
    growth = np.einsum("ij,ij->i", thetas, rates)
    once = _crossed(thetas, rates)
    part: Array = (growth * slope2)[:, None] * _crossed(thetas, once) - (growth * slope1)[:, None] * once
    part += k2[:, None] * _crossed(rates, once)
    return part


def _applied(k1: Array, k2: Array, thetas: Array, vectors: Array) -> Array:
    """Multiply A(θ) by vectors; shape (N, 3)."""
    once = _crossed(thetas, vectors)
    return vectors - k1[:, None] * once + k2[:, None] * _crossed(thetas, once)


def _crossed(a: Array, b: Array) -> Array:
    """Return cross products a × b of shape (N, 3); for a few pairs several times faster than NumPy's."""
    (x, y, z), (u, v, w) = a.T, b.T
    products = np.empty_like(a)
    products[:, 0], products[:, 1], products[:, 2] = y * w - z * v, z * u - x * w, x * v - y * u
    return products


def sizes(vectors: Array) -> Array:
    """Return the lengths of vectors of shape (N, 3); shape (N,)."""
    return cast(Array, np.sqrt(np.einsum("ij,ij->i", vectors, vectors)))


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
