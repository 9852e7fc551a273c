"""The extremes of a motion, exactly: the ends of its pieces, and the roots of the derivative between them.

Of a cubic that takes quadratics, which are solved in closed form; higher degrees take eigenvalues of a companion
matrix. A root that is a little off costs nothing: what counts is the value there, which is stationary.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.model.arrays import Array
from gelenk.trajectory.polynomial import PiecewisePolynomial

_ROUNDING = 1e-14
_SAME = 1e-12


@dataclass(frozen=True, slots=True)
class Peaks:
    """The value of each coordinate of a motion that is furthest from zero, and its time.

    Attributes:
        values: The values there, with their signs; shape (n,).
        times: When, [s]; of several times the first; shape (n,).
    """

    values: Array
    times: Array


def peaks(motion: PiecewisePolynomial, order: int) -> Peaks:
    """Largest magnitude of a derivative of a motion, with both ends of each piece.

    Args:
        motion: The motion.
        order: Of the derivative: 1 for velocity, 2 for acceleration, 3 for jerk.
    """
    times, values = candidates(motion.derivative(order))
    return _largest(times, values)


def _largest(times: Array, values: Array) -> Peaks:
    flat_times, flat = times.reshape(-1, times.shape[-1]), values.reshape(-1, values.shape[-1])
    sizes = np.abs(flat)
    late = np.where(sizes >= sizes.max(axis=0) * (1.0 - _SAME), flat_times, np.inf)
    first = late.argmin(axis=0)
    columns = np.arange(flat.shape[1])
    return Peaks(flat[first, columns], flat_times[first, columns])


def candidates(motion: PiecewisePolynomial) -> tuple[Array, Array]:
    """The times at which a motion can be extreme, and its values there; both of shape (M, k, n).

    Each piece has its two ends and the zeros of its derivative; what is no zero within the piece is one of its ends.
    """
    lengths = np.diff(motion.breaks)[:, None]
    c = motion.coefficients * (lengths ** np.arange(motion.coefficients.shape[1]))[:, :, None]
    inner = _stationary(c)
    ends = np.zeros((c.shape[0], 1, c.shape[2]))
    u = np.concatenate([ends, inner, ends + 1.0], axis=1)
    values = np.broadcast_to(c[:, -1:], u.shape)
    for k in range(c.shape[1] - 2, -1, -1):
        values = values * u + c[:, k : k + 1]
    # The end of a piece is the next one's start to the last digit, so that whoever looks there knows which one to ask.
    starts, stops = motion.breaks[:-1, None, None], motion.breaks[1:, None, None]
    return np.where(u == 1.0, stops, starts + u * lengths[:, :, None]), values


def _stationary(c: Array) -> Array:
    """Zeros in [0, 1] of the derivative of polynomials, lowest power first; (M, d + 1, n) → (M, d - 1, n)."""
    degree = c.shape[1] - 1
    if degree < 2:
        return np.empty((c.shape[0], 0, c.shape[2]))
    slope = c[:, 1:] * np.arange(1, degree + 1)[:, None]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        if degree == 2:
            roots = (-slope[:, 0] / slope[:, 1])[:, None]
        elif degree == 3:
            roots = _quadratic_roots(slope)
        else:
            roots = _roots(slope)
    found: Array = np.clip(np.nan_to_num(roots, nan=0.0, posinf=0.0, neginf=0.0), 0.0, 1.0)
    return found


def _quadratic_roots(c: Array) -> Array:
    """Both roots, without cancellation; the real part of complex ones; (M, 3, n) → (M, 2, n)."""
    half = -0.5 * c[:, 1]
    root = np.sqrt(np.maximum(half**2 - c[:, 0] * c[:, 2], 0.0))
    outer = half + np.copysign(root, half)
    return np.stack([outer / c[:, 2], c[:, 0] / outer], axis=1)


def _roots(c: Array) -> Array:
    """Real parts of all roots; (M, d + 1, n) → (M, d, n), filled up with 0 where the degree is lower."""
    pieces, size, joints = c.shape
    rows = np.moveaxis(c, 1, 2).reshape(-1, size)
    largest = np.abs(rows).max(axis=1, keepdims=True)
    is_used = np.abs(rows) > _ROUNDING * largest
    degrees = np.where(is_used.any(axis=1), size - 1 - np.argmax(is_used[:, ::-1], axis=1), 0)
    found = np.zeros((len(rows), size - 1))
    for degree in range(1, size):
        chosen = np.flatnonzero(degrees == degree)
        if len(chosen) > 0:
            companion = np.zeros((len(chosen), degree, degree))
            companion[:, np.arange(1, degree), np.arange(degree - 1)] = 1.0
            companion[:, :, -1] = -rows[chosen, :degree] / rows[chosen, degree, None]
            found[chosen, :degree] = np.linalg.eigvals(companion).real
    return np.moveaxis(found.reshape(pieces, joints, size - 1), 1, 2)
