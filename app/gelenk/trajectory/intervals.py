"""A path cut into intervals: what limits say in each of them, and the path in time.

With u = s̈ and x = ṡ² at the start of an interval of length Δ, u constant, and τ = (s - s_i)/Δ:
q̇² = q'² (x + 2Δτu) and q̈ = q' u + q'' (x + 2Δτu) are polynomials in τ whose Bernstein coefficients are linear in
(u, x). A polynomial lies between its least and its largest Bernstein coefficient, so that limits these keep are kept in
all of the interval.
"""

from math import comb

import numpy as np

from gelenk.model.arrays import Array
from gelenk.trajectory.polynomial import PiecewisePolynomial


def cut(path: PiecewisePolynomial, nodes: Array) -> Array:
    """Coefficients of a path from each node to the next; shape (N, d + 1, n).

    Args:
        path: q(s), in M pieces.
        nodes: Among them all breaks of the path; shape (N + 1,).
    """
    i = np.clip(np.searchsorted(path.breaks, 0.5 * (nodes[:-1] + nodes[1:]), side="right") - 1, 0, None)
    offsets = (nodes[:-1] - path.breaks[i])[:, None]
    c = path.coefficients[i]
    # Horner's scheme, over and over, is Taylor's expansion about another point.
    size = c.shape[1]
    for k in range(size - 1):
        for m in range(size - 2, k - 1, -1):
            c[:, m] += offsets * c[:, m + 1]
    return c


def rows(pieces: Array, lengths: Array, limits: Array) -> tuple[Array, Array]:
    """What the limits say of u and x at the start of each interval: αu + βx ≤ 1; both of shape (N, m).

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
    """Bernstein coefficients on [0, 1] of polynomials, from those of the powers; shape (N, d + 1, n)."""
    degree = c.shape[1] - 1
    matrix = [[comb(j, k) / comb(degree, k) for k in range(degree + 1)] for j in range(degree + 1)]
    result: Array = np.array(matrix) @ c
    return result


def composed(pieces: Array, advance: Array) -> Array:
    """Coefficients of Σ c_k σᵏ with σ = a_1 t + a_2 t², by Horner's scheme.

    Args:
        pieces: c; shape (N, d + 1, n).
        advance: a_1 and a_2; shape (N, 2, 1).

    Returns:
        Shape (N, 2d + 1, n).
    """
    result = pieces[:, -1:]
    for k in range(pieces.shape[1] - 2, -1, -1):
        longer = np.zeros((len(pieces), result.shape[1] + 2, pieces.shape[2]))
        longer[:, 1:-1] = result * advance[:, :1]
        longer[:, 2:] += result * advance[:, 1:]
        longer[:, 0] += pieces[:, k]
        result = longer
    return result
