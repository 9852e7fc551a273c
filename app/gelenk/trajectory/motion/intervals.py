"""A path cut into intervals: the constraints that limits impose in each, and the path over time.

With u = s̈ and x = ṡ² at the start of an interval of length Δ, u constant, and τ = (s - s_i)/Δ:
q̇² = q'² (x + 2Δτu) and q̈ = q' u + q'' (x + 2Δτu) are polynomials in τ whose Bernstein coefficients are linear in
(u, x). A polynomial lies between its smallest and its largest Bernstein coefficient, so limits that these keep are kept
in the whole interval.
"""

from math import comb

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial


def cut(path: PiecewisePolynomial, nodes: Array) -> Array:
    """Return the coefficients of a path from each node to the next; shape (N, d + 1, n).

    Args:
        path: q(s), in M pieces.
        nodes: Nodes, including all breaks of the path; shape (N + 1,).
    """
    i = np.clip(np.searchsorted(path.breaks, 0.5 * (nodes[:-1] + nodes[1:]), side="right") - 1, 0, None)
    offsets = (nodes[:-1] - path.breaks[i])[:, None]
    c = path.coefficients[i]
    # Repeated Horner steps give the Taylor expansion about another point.
    size = c.shape[1]
    for k in range(size - 1):
        for m in range(size - 2, k - 1, -1):
            c[:, m] += offsets * c[:, m + 1]
    return c


def rows(pieces: Array, lengths: Array, limits: Array) -> tuple[Array, Array]:
    """Return α and β of the constraints αu + βx ≤ 1 that the limits impose on each interval; shape (N, m) each.

    Args:
        pieces: Coefficients of the path from each node on; shape (N, d + 1, n).
        lengths: Δ; shape (N,).
        limits: Of velocity and acceleration; shape (2, n).
    """
    size = pieces.shape[1] - 1
    k = np.arange(size)[:, None]
    length = lengths[:, None, None]
    # In powers of τ: q' = Σ slope_k τᵏ, Δ q'' = Σ k slope_k τᵏ⁻¹.
    slope = pieces[:, 1:] * (k + 1) * length**k
    bend = np.concatenate((slope[:, 1:] * k[1:] / length, np.zeros_like(slope[:, :1])), axis=1)
    square = np.zeros((len(pieces), 2 * size, pieces.shape[2]))
    for j in range(size):
        square[:, j : j + size] += slope[:, j : j + 1] * slope
    velocity, acceleration = limits
    forces = [bernstein(c) / acceleration for c in (slope * (2 * k + 1), bend)]
    shifted = np.roll(square, 1, axis=1) * 2.0 * length  # The last coefficient is zero.
    speeds = [bernstein(c) / velocity**2 for c in (shifted, square)]
    alpha, beta = (
        np.concatenate((force, -force, speed), axis=1).reshape(len(pieces), -1)
        for force, speed in zip(forces, speeds, strict=True)
    )
    return alpha, beta


def bernstein(c: Array) -> Array:
    """Convert power coefficients of polynomials to Bernstein coefficients on [0, 1]; shape (N, d + 1, n)."""
    degree = c.shape[1] - 1
    matrix = [[comb(j, k) / comb(degree, k) for k in range(degree + 1)] for j in range(degree + 1)]
    result: Array = np.array(matrix) @ c
    return result


def composed(pieces: Array, advance: Array) -> Array:
    """Return the coefficients of Σ c_k σᵏ with σ = a_1 t + a_2 t², by Horner's scheme.

    Args:
        pieces: c; shape (N, d + 1, n).
        advance: a_1 and a_2; shape (N, 2, 1).

    Returns:
        Coefficients; shape (N, 2d + 1, n).
    """
    result = pieces[:, -1:]
    for k in range(pieces.shape[1] - 2, -1, -1):
        longer = np.zeros((len(pieces), result.shape[1] + 2, pieces.shape[2]))
        longer[:, 1:-1] = result * advance[:, :1]
        longer[:, 2:] += result * advance[:, 1:]
        longer[:, 0] += pieces[:, k]
        result = longer
    return result
