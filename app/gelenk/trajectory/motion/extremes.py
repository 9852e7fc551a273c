"""Exact extremes of a motion: values at the ends of its pieces, and at the roots of the derivative between them.

The derivative of a cubic is a quadratic, solved in closed form; higher degrees need eigenvalues of a companion matrix.
A slightly inexact root does no harm, because the value is stationary there.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_ROUNDING = 1e-14
_SAME = 1e-12


@dataclass(frozen=True, slots=True)
class Peaks:
    """The value of each coordinate furthest from zero, with its sign, and its first time [s]; shape (n,) each."""

    values: Array
    times: Array


def peaks(motion: PiecewisePolynomial, order: int) -> Peaks:
    """Find the largest magnitude of a derivative, also at both ends of each piece; order 1 is the velocity."""
    flat_times, flat = (found.reshape(-1, found.shape[-1]) for found in candidates(motion.derivative(order)))
    sizes = np.abs(flat)
    late = np.where(sizes >= sizes.max(axis=0) * (1.0 - _SAME), flat_times, np.inf)
    first = late.argmin(axis=0)
    columns = np.arange(flat.shape[1])
    return Peaks(flat[first, columns], flat_times[first, columns])


def peaks_by_order(motion: PiecewisePolynomial, highest: int = 3) -> dict[int, Peaks]:
    """Return the peaks of the derivatives from velocity up to an order, by their orders."""
    return {order: peaks(motion, order) for order in range(1, highest + 1)}


def candidates(motion: PiecewisePolynomial) -> tuple[Array, Array]:
    """Return the times at which a motion can be extreme, and its values there; shape (M, k, n) each.

    These are both ends of each piece and the zeros of its derivative; zeros outside the piece are moved to its ends.
    """
    lengths = np.diff(motion.breaks)[:, None]
    c = motion.coefficients * (lengths ** np.arange(motion.coefficients.shape[1]))[:, :, None]
    inner = _stationary(c)
    ends = np.zeros((c.shape[0], 1, c.shape[2]))
    u = np.concatenate([ends, inner, ends + 1.0], axis=1)
    values = np.broadcast_to(c[:, -1:], u.shape)
    for k in range(c.shape[1] - 2, -1, -1):
        values = values * u + c[:, k : k + 1]
    # The end of a piece is exactly the next one's start, so that a lookup at that time finds the break.
    starts, stops = motion.breaks[:-1, None, None], motion.breaks[1:, None, None]
    return np.where(u == 1.0, stops, starts + u * lengths[:, :, None]), values


def _stationary(c: Array) -> Array:
    """Find the zeros in [0, 1] of the derivative of polynomials, lowest power first; (M, d + 1, n) → (M, d - 1, n)."""
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
    """Return both roots, without cancellation; the real part of complex ones; (M, 3, n) → (M, 2, n)."""
    half = -0.5 * c[:, 1]
    root = np.sqrt(np.maximum(half**2 - c[:, 0] * c[:, 2], 0.0))
    outer = half + np.copysign(root, half)
    return np.stack([outer / c[:, 2], c[:, 0] / outer], axis=1)


def _roots(c: Array) -> Array:
    """Return the real parts of all roots; (M, d + 1, n) → (M, d, n), padded with 0 where the degree is lower."""
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
