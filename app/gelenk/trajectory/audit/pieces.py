"""Polynomial pieces as the audit evaluates them: with nothing from the planners, each scaled to τ from 0 to 1."""

from typing import NamedTuple

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_PLACES = 16
"""Least number of steps by which the travel of a whole motion is measured."""
_NO_TRAVEL = 1e-300


class Pieces(NamedTuple):
    """A motion as separate pieces, each scaled to τ from 0 to 1.

    Attributes:
        starts, widths: Start time and duration of each piece; shape (M,), [s].
        scaled: c_k hᵏ, the coefficients in τ; shape (M, degree + 1, n).
    """

    starts: Array
    widths: Array
    scaled: Array

    def between(self, begin: float, end: float) -> "Pieces":
        """Return the pieces whose middle lies between two times, [s]."""
        middles = self.starts + 0.5 * self.widths
        some = slice(*np.searchsorted(middles, (begin, end)))
        return Pieces(self.starts[some], self.widths[some], self.scaled[some])

    def times(self, piece: Indices, tau: Array) -> Array:
        """Return the times at τ of some pieces, [s]."""
        return self.starts[piece] + tau * self.widths[piece]


def pieces_of(motion: PiecewisePolynomial) -> Pieces:
    """The pieces of a motion."""
    return scaled_pieces(np.ascontiguousarray(motion.breaks), np.ascontiguousarray(motion.coefficients))


@compiled
def are_pieces(breaks: Array, coefficients: Array) -> bool:
    """Check whether all numbers are finite, and each piece takes time."""
    wrong, numbers = 0, coefficients.ravel()
    for i in range(len(numbers)):  # all of them: without leaving the loop, eight at a time
        wrong += not abs(numbers[i]) < np.inf
    for i in range(len(breaks) - 1):
        wrong += not breaks[i + 1] - breaks[i] > 0.0
    return wrong == 0 and bool(np.isfinite(breaks).all())


@compiled
def scaled_pieces(breaks: Array, coefficients: Array) -> Pieces:
    """Return the pieces of polynomials in time; shape (M + 1,) and (M, degree + 1, n)."""
    starts, widths, scaled = breaks[:-1].copy(), np.diff(breaks), coefficients.copy()
    for piece in range(len(widths)):
        power = 1.0
        for k in range(scaled.shape[1]):
            for joint in range(scaled.shape[2]):
                scaled[piece, k, joint] *= power
            power *= widths[piece]
    return Pieces(starts, widths, scaled)


@inlined
def factor_of(k: int, order: int) -> float:
    """Return k!/(k - order)!, the factor of τ^(k - order) in a derivative of τᵏ."""
    factor = 1.0
    for i in range(order):
        factor *= k - i
    return factor


@inlined
def by_tau(pieces: Pieces, piece: int, joint: int, tau: float, order: int) -> float:
    """Evaluate a derivative by τ of a joint."""
    value = 0.0
    for k in range(pieces.scaled.shape[1] - 1, order - 1, -1):
        value = value * tau + factor_of(k, order) * pieces.scaled[piece, k, joint]
    return value


@inlined
def value_at(pieces: Pieces, piece: int, joint: int, tau: float, order: int) -> float:
    """Evaluate a time derivative of a joint at τ of a piece."""
    value: float = by_tau(pieces, piece, joint, tau, order) / pieces.widths[piece] ** order
    return value


@compiled
def values_at(pieces: Pieces, piece: Indices, tau: Array, order: int) -> Array:
    """Evaluate a time derivative at τ of the given pieces; shape (N,) each → (N, n)."""
    found = np.empty((len(piece), pieces.scaled.shape[2]))
    for i in range(len(piece)):
        for joint in range(found.shape[1]):
            found[i, joint] = value_at(pieces, piece[i], joint, tau[i], order)
    return found


@compiled
def positions_at(pieces: Pieces, times: Array) -> Array:
    """Evaluate positions at times of shape (N,), [s]; shape (N, n)."""
    found, last, piece = np.empty((len(times), pieces.scaled.shape[2])), len(pieces.starts) - 1, 0
    for i in range(len(times)):
        # Most are in the same piece as the one before.
        if times[i] < pieces.starts[piece] or (piece < last and times[i] >= pieces.starts[piece + 1]):
            piece = min(max(np.searchsorted(pieces.starts, times[i], side="right") - 1, 0), last)
        tau = (times[i] - pieces.starts[piece]) / pieces.widths[piece]
        for joint in range(found.shape[1]):
            found[i, joint] = by_tau(pieces, piece, joint, tau, 0)
    return found


@compiled
def rate_bounds(pieces: Pieces) -> tuple[float, float]:
    """Return bounds of all velocities and accelerations, by the sums of their polynomials' coefficients."""
    velocity, acceleration = 0.0, 0.0
    for piece in range(len(pieces.widths)):
        for joint in range(pieces.scaled.shape[2]):
            first, second = 0.0, 0.0
            for k in range(1, pieces.scaled.shape[1]):
                size = k * abs(pieces.scaled[piece, k, joint])
                first, second = first + size, second + (k - 1.0) * size
            velocity = max(velocity, first / pieces.widths[piece])
            acceleration = max(acceleration, second / pieces.widths[piece] ** 2)
    return velocity, acceleration


@compiled
def even_positions(pieces: Pieces, count: int) -> Array:
    """Evaluate positions at evenly spread times, from the start to the end; shape (count, n)."""
    return positions_at(pieces, np.linspace(pieces.starts[0], pieces.starts[-1] + pieces.widths[-1], count))


@compiled
def joint_ends(pieces: Pieces) -> Array:
    """Evaluate position, velocity and acceleration at the start and the end; shape (2, 3, n)."""
    found, last = np.empty((2, 3, pieces.scaled.shape[2])), len(pieces.widths) - 1
    for order in range(3):
        for joint in range(found.shape[2]):
            found[0, order, joint] = value_at(pieces, 0, joint, 0.0, order)
            found[1, order, joint] = value_at(pieces, last, joint, 1.0, order)
    return found


@compiled
def travels(pieces: Pieces) -> Array:
    """Return how far all joints go together in each piece, at least, [rad or m]; shape (M,).

    In few pieces, places between count too.
    """
    steps, found = max(1, _PLACES // len(pieces.widths)), np.zeros(len(pieces.widths))
    for piece in range(len(found)):
        for joint in range(pieces.scaled.shape[2]):
            before = pieces.scaled[piece, 0, joint]
            for k in range(1, steps + 1):
                here = by_tau(pieces, piece, joint, k / steps, 0)
                found[piece], before = found[piece] + abs(here - before), here
    return found


@compiled
def enough(travel: Array, least: int, each: float, most: int) -> int:
    """Return how many samples show every wave: the more, the further all joints turn together, as `travels` says."""
    return int(min(least + each * travel.sum(), most))


@compiled
def spread_times(pieces: Pieces, travel: Array, count: int) -> Array:
    """Return `count` + 1 times from the start to the end, [s], spread over time and over the joints' travel alike."""
    shares, whole = np.empty(len(travel)), pieces.widths.sum()
    total = max(travel.sum(), _NO_TRAVEL)
    for piece in range(len(shares)):
        shares[piece] = 0.5 * (travel[piece] / total + pieces.widths[piece] / whole)
    times, step, piece, before = np.empty(count + 1), shares.sum() / count, 0, 0.0
    for k in range(count):
        while piece + 1 < len(shares) and before + shares[piece] <= k * step:
            before, piece = before + shares[piece], piece + 1
        tau = min((k * step - before) / shares[piece], 1.0)
        times[k] = pieces.starts[piece] + tau * pieces.widths[piece]
    times[count] = pieces.starts[-1] + pieces.widths[-1]
    return times
