"""Time laws between two points (cubic, quintic, septic), and the 4-3-4 law through a lift-off and a set-down point.

A law of degree 2m - 1 has m derivatives given at both ends, counting the position as one. In λ = t/T the course writes
the cubic as q = q0 + Δq (a λ³ + b λ² + c λ + d), which requires Δq ≠ 0. Here the general form is computed; `normalised`
converts it where possible.
"""

from math import comb, factorial
from typing import Final

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

END_CONDITIONS: Final = {
    2: np.array([[3.0, -1.0], [-2.0, 1.0]]),
    3: np.array([[10.0, -4.0, 0.5], [-15.0, 7.0, -1.0], [6.0, -3.0, 0.5]]),
    4: np.array(
        [
            [35.0, -15.0, 2.5, -1.0 / 6.0],
            [-84.0, 39.0, -7.0, 0.5],
            [70.0, -34.0, 6.5, -0.5],
            [-20.0, 10.0, -2.0, 1.0 / 6.0],
        ]
    ),
}
"""For each m, the matrix from the remainders of the m conditions at λ = 1 to the coefficients of λᵐ … λ²ᵐ⁻¹."""

_QUARTIC = np.array([[4.0, -1.0], [-3.0, 1.0]])
"""The same for λ³ and λ⁴ of a quartic, from the remainders of position and velocity at its end."""


def between(starts: Array, ends: Array, duration: float) -> PiecewisePolynomial:
    """Return the polynomial of lowest degree with given derivatives at both ends, starting at t = 0.

    Args:
        starts, ends: Position, velocity, … at t = 0 and T, two to four of them; shape (m, n), [rad or m per sᵏ].
        duration: T > 0, [s].
    """
    coefficients = hermite_pieces(starts[:, None], ends[:, None], np.array([duration]))
    return PiecewisePolynomial(np.array([0.0, duration]), coefficients)


def rest_to_rest(start: float, end: float, conditions: int) -> PiecewisePolynomial:
    """Return the polynomial of one coordinate that lasts 1 s, with `conditions` derivatives given at both ends."""
    rows = np.zeros((2, conditions, 1))
    rows[:, 0, 0] = start, end
    return between(rows[0], rows[1], 1.0)


def hermite_pieces(starts: Array, ends: Array, durations: Array) -> Array:
    """Return polynomials with given derivatives at both ends, by their coefficients; shape (M, 2m, n).

    They count the time from the start of each piece, the lowest power first.

    Args:
        starts, ends: Position, velocity, … at both ends of each piece, two to four of them; shape (m, M, n).
        durations: Shape (M,), [s].
    """
    from gelenk.trajectory.motion.evaluation import hermite  # noqa: PLC0415 - a client has no compiler

    first, last, lasting = (np.ascontiguousarray(rows, dtype=float) for rows in (starts, ends, durations))
    return hermite(first, last, lasting, END_CONDITIONS[len(starts)])


def _left_at_end(lower: list[Array], ends: list[Array], displacement: Array) -> Array:
    """Return the conditions at λ = 1 minus the contribution of the powers that the start determines; all in λ."""
    left = [displacement - sum(lower[1:])]
    for d in range(1, len(ends)):
        settled = sum(factorial(k) // factorial(k - d) * lower[k] for k in range(d, len(lower)))
        left.append(ends[d] - settled)
    return np.array(left)


def quartic_cubic_quartic(
    times: Array, knots: Array, start_rates: Array | None = None, end_rates: Array | None = None
) -> PiecewisePolynomial:
    """Return the 4-3-4 law: a quartic to lift off, a cubic to travel, a quartic to set down, C² throughout.

    Fourteen conditions determine fourteen coefficients. The cubic and the quartics each express the accelerations at
    the inner knots by the velocities there; equating them gives two linear equations for the two velocities.

    Args:
        times: Times of the knots, increasing, [s]; shape (4,).
        knots: Positions at start, lift-off, set-down and end; shape (4, n), [rad or m].
        start_rates, end_rates: Velocity and acceleration at both ends; shape (2, n); zero by default.
    """
    (h1, h2, h3), step = np.diff(times), np.diff(knots, axis=0)
    rest = np.zeros((2, knots.shape[1]))
    v0, a0 = rest if start_rates is None else start_rates
    v3, a3 = rest if end_rates is None else end_rates
    matrix = np.array([[6.0 / h1 + 4.0 / h2, 2.0 / h2], [2.0 / h2, 4.0 / h2 + 6.0 / h3]])
    travel = 6.0 * step[1] / h2**2
    b = np.array(
        [
            travel + 12.0 * step[0] / h1**2 - 6.0 * v0 / h1 - a0,
            travel + 12.0 * step[2] / h3**2 - 6.0 * v3 / h3 + a3,
        ]
    )
    v1, v2 = np.linalg.solve(matrix, b)
    lift = _quartic(np.array([knots[0], v0, a0]), np.array([knots[1], v1]), h1)
    # Backwards in time, setting down is lifting off with the velocities reversed.
    backwards = _quartic(np.array([knots[3], -v3, a3]), np.array([knots[2], -v2]), h3)
    cubic = hermite_pieces(np.array([[knots[1]], [v1]]), np.array([[knots[2]], [v2]]), np.array([h2]))[0]
    rows = np.array([lift, np.pad(cubic, ((0, 1), (0, 0))), _reversed_quartic(backwards, h3)])
    rows[2, :2] = knots[2], v2
    return PiecewisePolynomial(times, rows)


def _quartic(start: Array, end: Array, h: float) -> Array:
    """Return the quartic with given position, velocity and acceleration at its start, and the first two at its end."""
    lower = [start[k] * h**k / factorial(k) for k in range(3)]
    left = _left_at_end(lower, [end[0], end[1] * h], end[0] - start[0])
    scaled = np.concatenate([np.array(lower), _QUARTIC @ left])
    result: Array = scaled / h ** np.arange(5)[:, None]
    return result


def _reversed_quartic(c: Array, h: float) -> Array:
    shifted = [sum(comb(m, k) * h ** (m - k) * c[m] for m in range(k, 5)) for k in range(5)]
    result: Array = np.array(shifted) * (-1.0) ** np.arange(5)[:, None]
    return result


def normalised(motion: PiecewisePolynomial, displacements: Array) -> list[list[float] | None]:
    """Return the course's coefficients of q = q0 + Δq (… + a₁ λ + a₀) in λ = t/T, highest power first.

    The motion has a single piece, and Δq, [rad or m], the shape (n,). Returned is one list per coordinate; None where
    this form does not exist, because Δq is zero or too small.
    """
    scaled = motion.coefficients[0] * motion.duration ** np.arange(motion.coefficients.shape[1])[:, None]
    scaled[0] = 0.0
    found: list[list[float] | None] = []
    for column, displacement in zip(scaled.T, displacements, strict=True):
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            ratios = column[::-1] / displacement
        found.append(ratios.tolist() if displacement != 0.0 and np.isfinite(ratios).all() else None)
    return found
