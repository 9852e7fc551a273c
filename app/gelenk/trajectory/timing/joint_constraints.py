"""The joints' limits as constraints αu + βx ≤ 1 on u = s̈ and x = ṡ² on each interval of a path, for `reachability`.

With τ = (s - s_i)/Δ, q̇² = q'² (x + 2Δτu) and q̈ = q' u + q'' (x + 2Δτu) are polynomials in τ whose Bernstein
coefficients are linear in (u, x), and these bound it in the whole interval.
"""

from gelenk.kinematics.simd.lanes import Lanes, lanes, load, store
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import inlined, unmanaged


@unmanaged
def store_joint_rows(pieces: Array, size: int, length: Lanes, limits: Array, alpha: Array, beta: Array) -> None:
    """Store α and β of the constraints that limits of velocity and acceleration impose on eight intervals.

    Args:
        pieces: Coefficients of the path in the intervals, row k n + j for the power k of joint j; `size` powers.
        length: Δ.
        limits: Of velocity and acceleration; shape (2, n).
        alpha, beta: Work arrays; 4 (size - 1) rows for each joint are written.
    """
    d, n = size - 1, limits.shape[1]
    for j in range(n):
        first, velocity, acceleration, power = 4 * d * j, limits[0, j], limits[1, j], lanes(1.0)
        # In powers of τ: q' = Σ slope_k τᵏ, Δ q'' = Σ k slope_k τᵏ⁻¹; the rows of opposite sign hold the slopes first.
        for k in range(d):
            slope = ((k + 1.0) * load(pieces, (k + 1) * n + j)) * power
            store(alpha, first + d + k, slope)
            store(alpha, first + k, ((2.0 * k + 1.0) / acceleration) * slope)
            store(beta, first + k, lanes(0.0))
            if k:
                store(beta, first + k - 1, ((k / acceleration) * slope) / length)
            power = power * length
        _store_squares(alpha, beta, first + d, d, length, 1.0 / velocity**2)
        for rows in (alpha, beta):
            _to_bernstein(rows, first, d)
            _to_bernstein(rows, first + 2 * d, 2 * d)
            for k in range(d):
                store(rows, first + d + k, -load(rows, first + k))


@inlined
def _store_squares(alpha: Array, beta: Array, slopes: int, d: int, length: Lanes, factor: float) -> None:
    """Store the rows of the speed's square, after the d rows of α with the slopes, in powers of τ."""
    first = slopes + d
    store(alpha, first, lanes(0.0))
    for k in range(2 * d - 1):
        square = lanes(0.0)
        for m in range(max(0, k - d + 1), min(k + 1, d)):
            square = square + load(alpha, slopes + m) * load(alpha, slopes + k - m)
        store(beta, first + k, factor * square)
        store(alpha, first + k + 1, (2.0 * factor) * (length * square))
    store(beta, first + 2 * d - 1, lanes(0.0))


@inlined
def _to_bernstein(rows: Array, first: int, count: int) -> None:
    """Convert power coefficients of polynomials to Bernstein coefficients on [0, 1], in place."""
    d, binomial = count - 1, 1.0
    for k in range(count):
        store(rows, first + k, load(rows, first + k) / binomial)
        binomial *= (d - k) / (k + 1.0)
    for k in range(d):
        for i in range(first + d, first + k, -1):
            store(rows, i, load(rows, i) + load(rows, i - 1))
