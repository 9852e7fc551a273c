"""Independent check of what is claimed about a motion: its ends, its knots, its joins and its peaks.

Everything is recomputed from Bézier control points, whose differences are the derivatives at the ends of a piece and
whose repeated means (de Casteljau) are the values within. Nothing is shared with the code that evaluates, derives or
searches motions elsewhere.
"""

from dataclasses import dataclass
from math import comb, factorial
from typing import TYPE_CHECKING

import numpy as np

from gelenk.errors import certify
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result

if TYPE_CHECKING:  # The contract holds the certificate, and a client needs no compiler.
    from gelenk.trajectory.motion.extremes import Peaks
    from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

TOLERANCE = 1e-9
_LOST = 1e-4
"""Relative rounding that counts as none, 1e-13, over the tolerance."""
_PARTS = 16


@dataclass(frozen=True, slots=True)
class MotionClaims:
    """The claims about a motion that are checked.

    Attributes:
        times, points: Times and positions, start and end included; shapes (K,), [s], and (K, n), [rad or m].
        start_rates, end_rates: Velocity, acceleration, … at the ends, as far as they were given; shape (m, n).
        continuity: Order up to which derivatives are continuous at the joins.
        peaks: Peaks by the order of the derivative.
    """

    times: Array
    points: Array
    start_rates: Array
    end_rates: Array
    continuity: int
    peaks: dict[int, "Peaks"]


@dataclass(frozen=True, slots=True)
class MotionCertificate(Result):
    """The motion's numbers checked a second way: Bézier control points, their differences and repeated means.

    Each number is a difference as a fraction of the largest value of its kind; an answer with more than 1e-9 is not
    sent.

    Attributes:
        boundary_error: Of the derivatives at both ends, as far as they were given; no unit.
        knot_error: Of the positions at the knots, both ends included; no unit.
        continuity: Order of the highest derivative that is promised to be continuous; no unit.
        continuity_error: Largest jump at the joins, up to that order; no unit.
        peak_error: Of a peak from the value at its time, or of any value on a grid beyond a peak; no unit.
        samples: Times of that grid.
    """

    boundary_error: float
    knot_error: float
    continuity: int
    continuity_error: float
    peak_error: float
    samples: int


def certified(motion: "PiecewisePolynomial", promise: MotionClaims) -> MotionCertificate:
    """Compare a motion with the claims about it; raises CertificationFailed if an error exceeds rounding."""
    if motion.duration == 0.0:
        error = float(np.abs(motion.coefficients[0, 0] - promise.points).max(initial=0.0))
        size = max(1.0, float(np.abs(promise.points).max()))
        found = MotionCertificate(0.0, error / size, promise.continuity, 0.0, 0.0, 0)
    else:
        found = _compared(motion, promise)
    for quantity, error in (
        ("the derivatives at both ends", found.boundary_error),
        ("the positions at the knots", found.knot_error),
        ("the derivatives at the joins", found.continuity_error),
        ("the peaks", found.peak_error),
    ):
        certify(quantity, error, TOLERANCE)
    return found


def _compared(motion: "PiecewisePolynomial", promise: MotionClaims) -> MotionCertificate:
    starts, control, lengths = motion.coefficients[:, 0], _control_points(motion), np.diff(motion.breaks)
    orders = max(promise.continuity, len(promise.start_rates), len(promise.end_rates), *promise.peaks, 1)
    derived = [_derivative(control, lengths, order) for order in range(orders + 1)]
    derived[0] = derived[0] + starts[:, None]
    scales = [np.abs(values).max(axis=(0, 1)) + _noise(control, lengths, k) for k, values in enumerate(derived)]
    boundary = 0.0
    for end, rates in ((0, promise.start_rates), (-1, promise.end_rates)):
        for order, wanted in enumerate(rates, start=1):
            errors = derived[order][end, end] - wanted
            boundary = max(boundary, _relative(errors, np.maximum(scales[order][end], np.abs(wanted))))
    joins = 0.0
    for order in range(promise.continuity + 1):
        jumps = derived[order][1:, 0] - derived[order][:-1, -1]
        joins = max(joins, _relative(jumps, np.maximum(scales[order][1:], scales[order][:-1])))
    errors = _at(starts, control, motion.breaks, promise.times) - promise.points
    size = np.maximum(scales[0].max(axis=0), np.abs(promise.points).max(axis=0))
    peak_error = 0.0
    for order, peak in promise.peaks.items():
        peak_error = max(peak_error, _peak_error(derived[order], motion.breaks, peak, scales[order].max(axis=0)))
    knots, samples = _relative(errors, size), len(lengths) * (_PARTS + 1)
    return MotionCertificate(boundary, knots, promise.continuity, joins, peak_error, samples)


def _relative(errors: Array, scale: Array) -> float:
    scale = np.broadcast_to(scale, errors.shape)
    # Where nothing moves the scale is 0, and the error itself has to vanish.
    ratios = np.abs(errors) / np.where(scale > 0.0, scale, 1.0)
    return float(ratios.max(initial=0.0))


def _control_points(motion: "PiecewisePolynomial") -> Array:
    """Return the Bézier control points of each piece, relative to its start; shape (M, d + 1, n)."""
    size = motion.coefficients.shape[1]
    change = np.zeros((size, size))
    for i in range(size):
        for k in range(1, i + 1):
            change[i, k] = comb(i, k) / comb(size - 1, k)
    powers = np.diff(motion.breaks)[:, None] ** np.arange(size)
    points: Array = np.einsum("ik,mkn->min", change, motion.coefficients * powers[:, :, None])
    return points


def _derivative(control: Array, lengths: Array, order: int) -> Array:
    degree = control.shape[1] - 1
    if order > degree:
        return np.zeros((len(control), 1, control.shape[2]))
    factor = factorial(degree) / factorial(degree - order)
    found: Array = np.diff(control, order, axis=1) * factor / (lengths**order)[:, None, None]
    return found


def _noise(control: Array, lengths: Array, order: int) -> Array:
    """Bound the rounding, over the tolerance, of a derivative where large numbers cancel; shape (M, n)."""
    degree = control.shape[1] - 1
    factor = _LOST * (2.0**order) * factorial(degree) / factorial(max(degree - order, 0))
    found: Array = np.abs(control).max(axis=1) * factor / (lengths**order)[:, None]
    return found


def _casteljau(control: Array, u: Array) -> Array:
    """Evaluate at u in [0, 1] by repeated means; control (…, d + 1, n), u (…, 1, 1)."""
    while control.shape[-2] > 1:
        control = control[..., :-1, :] * (1.0 - u) + control[..., 1:, :] * u
    found: Array = control[..., 0, :]
    return found


def _at(starts: Array, control: Array, breaks: Array, times: Array) -> Array:
    i = np.clip(np.searchsorted(breaks, times, side="right") - 1, 0, len(breaks) - 2)
    u = (times - breaks[i]) / (breaks[i + 1] - breaks[i])
    return starts[i] + _casteljau(control[i], u[:, None, None])


def _peak_error(control: Array, breaks: Array, peak: "Peaks", scale: Array) -> float:
    """Return how far a value on a grid exceeds a peak, or the value at the peak's time differs from it."""
    u = np.linspace(0.0, 1.0, _PARTS + 1)[:, None, None, None]
    largest = np.abs(_casteljau(control, u)).reshape(-1, control.shape[2]).max(axis=0)
    beyond = np.maximum(largest - np.abs(peak.values), 0.0)
    # At a join the value may jump: the peak may be on either side.
    j = np.arange(len(peak.times))
    inner = np.searchsorted(breaks, peak.times, side="left")
    sides = []
    for i in (inner - 1, np.searchsorted(breaks, peak.times, side="right") - 1):
        piece = np.clip(i, 0, len(breaks) - 2)
        u = (peak.times - breaks[piece]) / (breaks[piece + 1] - breaks[piece])
        sides.append(np.abs(_casteljau(control[piece], u[:, None, None])[j, j] - peak.values))
    missed = np.minimum(*sides)
    return _relative(np.maximum(beyond, missed), scale)
