"""The joints' limits as constraints αu + βx ≤ 1 on u = s̈ and x = ṡ² on each interval of a path, for `reachability`.

With τ = (s - s_i)/Δ, q̇² = q'² (x + 2Δτu) and q̈ = q' u + q'' (x + 2Δτu) are polynomials in τ whose Bernstein
coefficients are linear in (u, x), and these bound it in the whole interval.
"""

from gelenk.kinematics.simd.lanes import LANES, Lanes, abs_lanes, bits, lanes, load, max_lanes, min_lanes, store
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import inlined, unmanaged


@unmanaged
def store_joint_rows(
    pieces: Array, size: int, length: Lanes, limits: Array, alpha: Array, beta: Array, squares: int
) -> int:
    """Store α and β of the constraints that limits of velocity and acceleration impose on eight intervals.

    A joint that is slower everywhere than another one at both ends, in all eight, needs no limit of velocity.

    Args:
        pieces: Coefficients of the path in the intervals, row k n + j for the power k of joint j; `size` powers.
        length: Δ.
        limits: Of velocity and acceleration; shape (2, n).
        alpha, beta: Work arrays. `size` - 1 rows for each joint, |αu + βx| ≤ 1, are written at the start, and from row
            `squares` on twice as many, αu + βx ≤ 1, for each joint whose velocity counts; as many as the former at the
            end of α are used up.

    Returns:
        The row after the last.
    """
    d, n, per_length, fastest = size - 1, limits.shape[1], 1.0 / length, lanes(0.0)
    slopes = len(alpha) // LANES - d
    for j in range(n):
        _store_slopes(pieces, d, n, j, length, alpha, slopes)
        start, end, _ = _speeds(alpha, slopes, d, limits[0, j])
        fastest = max_lanes(min_lanes(start, end), fastest)
    for j in range(n):
        first, acceleration = d * j, limits[1, j]
        _store_slopes(pieces, d, n, j, length, alpha, slopes)
        # In powers of τ: q' = Σ slope_k τᵏ, Δ q'' = Σ k slope_k τᵏ⁻¹.
        for k in range(d):
            slope = load(alpha, slopes + k)
            store(alpha, first + k, ((2.0 * k + 1.0) / acceleration) * slope)
            store(beta, first + k, lanes(0.0))
            if k:
                store(beta, first + k - 1, ((k / acceleration) * slope) * per_length)
        for rows in (alpha, beta):
            _to_bernstein(rows, first, d)
        if bits(_speeds(alpha, slopes, d, limits[0, j])[2] >= fastest):
            _store_squares(alpha, beta, slopes, squares, d, length, 1.0 / limits[0, j] ** 2)
            for rows in (alpha, beta):
                _to_bernstein(rows, squares, 2 * d)
            squares += 2 * d
    return squares


@inlined
def _store_slopes(pieces: Array, d: int, n: int, j: int, length: Lanes, alpha: Array, slopes: int) -> None:
    """Store q' of a joint in powers of τ in d rows of α."""
    power = lanes(1.0)
    for k in range(d):
        store(alpha, slopes + k, ((k + 1.0) * load(pieces, (k + 1) * n + j)) * power)
        power = power * length


@inlined
def _speeds(alpha: Array, slopes: int, d: int, velocity: float) -> tuple[Lanes, Lanes, Lanes]:
    """Return |q'| of a joint over its limit: at the start, at the end, and more than anywhere."""
    start, end, most = load(alpha, slopes), lanes(0.0), lanes(0.0)
    for k in range(d):
        slope = load(alpha, slopes + k)
        end, most = end + slope, most + abs_lanes(slope)
    return abs_lanes(start) / velocity, abs_lanes(end) / velocity, most / velocity


@inlined
def _store_squares(alpha: Array, beta: Array, slopes: int, first: int, d: int, length: Lanes, factor: float) -> None:
    """Store the rows of the speed's square in powers of τ, from d rows of α with the slopes."""
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
        store(rows, first + k, (1.0 / binomial) * load(rows, first + k))
        binomial *= (d - k) / (k + 1.0)
    for k in range(d):
        for i in range(first + d, first + k, -1):
            store(rows, i, load(rows, i) + load(rows, i - 1))
