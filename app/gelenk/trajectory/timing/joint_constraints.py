"""The joints' limits as constraints αu + βx ≤ 1 on u = s̈ and x = ṡ² on each interval of a path, for `reachability`.

With τ = (s - s_i)/Δ, q̇² = q'² (x + 2Δτu) and q̈ = q' u + q'' (x + 2Δτu) are polynomials in τ whose Bernstein
coefficients are linear in (u, x), and these bound it in the whole interval.
"""

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined


@compiled
def joint_rows(pieces: Array, lengths: Array, limits: Array) -> tuple[Array, Array]:
    """Return α and β of the constraints that limits of velocity and acceleration impose; shape (N, 4 d n) each.

    The path's pieces have the shape (N, d + 1, n), from each node on, the lengths Δ (N,), the limits (2, n).
    """
    count, size, n = pieces.shape
    d = size - 1
    alpha, beta = np.zeros((count, n, 4 * d)), np.zeros((count, n, 4 * d))
    for i in range(count):
        for j in range(n):
            _joint(pieces[i, :, j], lengths[i], limits[0, j], limits[1, j], alpha[i, j], beta[i, j])
    return alpha.reshape((count, -1)), beta.reshape((count, -1))


@inlined
def _joint(c: Array, length: float, velocity: float, acceleration: float, alpha: Array, beta: Array) -> None:
    """Write the rows of one joint: the acceleration's d, the same with the opposite sign, and the speed's 2d."""
    d, power = len(c) - 1, 1.0
    # In powers of τ: q' = Σ slope_k τᵏ, Δ q'' = Σ k slope_k τᵏ⁻¹; the rows of opposite sign hold the slopes meanwhile.
    for k in range(d):
        slope = c[k + 1] * (k + 1) * power
        alpha[d + k], alpha[k] = slope, slope * (2 * k + 1) / acceleration
        if k:
            beta[k - 1] = slope * k / (length * acceleration)
        power *= length
    for k in range(d):
        for m in range(d):
            beta[2 * d + k + m] += alpha[d + k] * alpha[d + m] / velocity**2
    for k in range(2 * d - 1):
        alpha[2 * d + k + 1] = 2.0 * length * beta[2 * d + k]
    for rows in (alpha, beta):
        _to_bernstein(rows[:d])
        _to_bernstein(rows[2 * d :])
        for k in range(d):
            rows[d + k] = -rows[k]


@inlined
def _to_bernstein(c: Array) -> None:
    """Convert power coefficients of a polynomial to Bernstein coefficients on [0, 1], in place."""
    d, binomial = len(c) - 1, 1.0
    for k in range(d + 1):
        c[k] /= binomial
        binomial *= (d - k) / (k + 1.0)
    for k in range(d):
        for j in range(d, k, -1):
            c[j] += c[j - 1]
