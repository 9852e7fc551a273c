"""Smooth paths through orientations: a spline with continuous angular acceleration.

Between two knots R(x) = R_k Exp(θ(x)), where θ is a cubic. The angular velocities at the knots are chosen so that the
angular acceleration is continuous. This makes the spline C², like a cubic spline of positions; SciPy's `RotationSpline`
computes the same interpolation. Each end has the mean angular velocity of its interval.

A(θ) and β are those of `rotation_rates`.
"""

from dataclasses import dataclass
from typing import cast

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled
from gelenk.robot.notations import vectors_from_rotations
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.orientation_paths import travelled
from gelenk.trajectory.paths.rotation_rates import quadratic_parts, rate_matrices
from gelenk.trajectory.paths.sampling import by_vectors

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
        vectors, starts = self.vectors, np.ascontiguousarray(self.starts)
        return by_vectors(starts, vectors.breaks, np.ascontiguousarray(vectors.coefficients), x)


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
    for _ in range(_ITERATIONS):
        rates = _turned(inverses[:-1], omegas[1:-1])
        found = _substituted(factors, pivots, upper, fixed - quadratic_parts(steps[:-1], rates))
        change = np.abs(found - omegas[1:-1]).max()
        omegas[1:-1] = found
        if change <= _CONVERGED * max(1.0, float(np.abs(found).max())):
            return


@compiled
def _eliminated(lower: Array, diagonal: Array, upper: Array) -> tuple[Array, Array]:
    """Eliminate once for repeated use; return factors (M - 1, 3, 3) and inverse pivots (M, 3, 3).

    The matrix has off-diagonal blocks (M - 1, 3, 3), and on its diagonal numbers (M, 1) times the identity matrix.
    """
    factors, pivots = np.empty_like(lower), np.empty((len(diagonal), 3, 3))
    pivots[0] = np.eye(3) / diagonal[0]
    for i in range(len(lower)):
        factors[i] = lower[i] @ pivots[i]
        pivots[i + 1] = np.linalg.inv(diagonal[i + 1] * np.eye(3) - factors[i] @ upper[i])
    return factors, pivots


@compiled
def _substituted(factors: Array, pivots: Array, upper: Array, right: Array) -> Array:
    solution = right.copy()
    for i in range(len(factors)):
        solution[i + 1] -= factors[i] @ solution[i]
    solution[-1] = pivots[-1] @ solution[-1]
    for i in range(len(right) - 2, -1, -1):
        solution[i] = pivots[i] @ (solution[i] - upper[i] @ solution[i + 1])
    return solution


def _turned(matrices: Array, vectors: Array) -> Array:
    return cast(Array, np.einsum("nij,nj->ni", matrices, vectors))


@compiled
def vector_motion(rotations: Array, omegas: Array, alphas: Array) -> tuple[Array, Array, Array]:
    """Return θ, θ̇ and θ̈ of R = Exp(θ), ‖θ‖ ≤ π; the inverse of `angular_motion`.

    Shapes (N, 3, 3), and (N, 3) of the others, [rad], [rad/s] and [rad/s²].
    """
    thetas = vectors_from_rotations(rotations)
    matrices, rates, bends = rate_matrices(thetas), np.empty(thetas.shape), np.empty(thetas.shape)
    for i in range(len(thetas)):
        rates[i] = np.linalg.solve(matrices[i], omegas[i])
    rest = alphas - quadratic_parts(thetas, rates)
    for i in range(len(thetas)):
        bends[i] = np.linalg.solve(matrices[i], rest[i])
    return thetas, rates, bends


def sizes(vectors: Array) -> Array:
    """Return the lengths of vectors of shape (N, 3); shape (N,)."""
    return cast(Array, np.sqrt(np.einsum("ij,ij->i", vectors, vectors)))
