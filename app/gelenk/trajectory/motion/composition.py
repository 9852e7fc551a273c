"""Joints along a path over time, q(s(t)), composed into one piecewise polynomial.

Up to degree 10 the composition is exact: a law of parabolas with q(s) of degree 5, or any law along a straight line in
joint space. Other compositions would have degree 15 to 35. There each piece is the septic with the position, velocity,
acceleration and jerk of q(s(t)) at both its ends, taken from its own side where they jump; pieces are divided until
the error in between is within a tolerance.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.trajectory.motion.evaluation import composed, reached
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, cut, derivatives, divided
from gelenk.trajectory.motion.time_laws import hermite_pieces

_EXACT_DEGREE = 10
"""Degree up to which q(s(t)) is composed exactly."""

_SHORTEST = 1e-5
"""Least time between two breaks of an approximation, in fractions of the whole: doubles give no jerk for less."""
_SAME = 1e-13
RATES_KNOWN = (1e-8, 1e-7, 1e-5)
"""Error of velocity, acceleration and jerk of an approximation, in fractions of the largest of each joint."""
_TOLERANCES = np.array([1e-9, *RATES_KNOWN])
"""Tolerated error of the position, [rad or m], followed by the three above."""
_PROBES = np.array([0.25, 0.5, 0.75])
_ROUNDS = 4
_MOST_PARTS = 8


@dataclass(frozen=True, slots=True)
class _Expansion:
    """q(s(t)) piece by piece, expanded about the start of each piece.

    Attributes:
        breaks: [s]; shape (M + 1,).
        law: s(t) minus its start value; shape (M, d + 1, 1).
        joints: q as a function of that s, minus its start value; shape (M, D + 1, n).
        starts: Start values of q; shape (M, n).
        places: Start values of s; shape (M,).
    """

    breaks: Array
    law: Array
    joints: Array
    starts: Array
    places: Array

    def at(self, local: Array) -> Array:
        """Return q minus its start value and three derivatives at local times, (M, 1); shape (4, M, n)."""
        s, *rates = derivatives(self.law, local)
        return _chained(derivatives(self.joints, s), rates)

    def at_edges(self, joints: PiecewisePolynomial) -> tuple[Array, Array]:
        """Return the same at the start and the end of each piece; shape (4, M, n) each.

        Joint knots that are too close together in time share a piece. The values at its edges are then those of the
        polynomials that belong there, so that nothing jumps.
        """
        widths = np.diff(self.breaks)[:, None]
        places = np.append(self.places, joints.breaks[-1])
        reach = _SAME * (joints.breaks[-1] - joints.breaks[0])
        middle = np.searchsorted(joints.breaks, 0.5 * (places[:-1] + places[1:]), side="right") - 1
        first = np.searchsorted(joints.breaks, places[:-1] + reach, side="right") - 1
        last = np.searchsorted(joints.breaks, places[1:] - reach) - 1
        edges = []
        for owners, s, local in ((first, places[:-1], 0.0 * widths), (last, places[1:], widths)):
            edge = self.at(local)
            rows = np.flatnonzero((owners != middle) & (owners >= 0) & (owners < len(joints.breaks) - 1))
            if len(rows):
                mine = owners[rows]
                along = derivatives(joints.coefficients[mine], (s[rows] - joints.breaks[mine])[:, None])
                edge[:, rows] = _chained(along, derivatives(self.law[rows], local[rows])[1:])
                edge[0, rows] -= self.starts[rows]
            edges.append(edge)
        return edges[0], edges[1]


def in_time(joints: PiecewisePolynomial, law: PiecewisePolynomial) -> PiecewisePolynomial:
    """Compose q(s(t)), where s(t) leads without going back from the first break of the joints to the last."""
    degree = (joints.coefficients.shape[1] - 1) * (law.coefficients.shape[1] - 1)
    if degree <= _EXACT_DEGREE:
        exact = _expanded(joints, law, _breaks(joints, law, _SAME))
        coefficients = composed(np.ascontiguousarray(exact.joints), exact.law[:, :, 0])
        coefficients[:, 0] = exact.starts
        return PiecewisePolynomial(exact.breaks, coefficients)
    breaks = _breaks(joints, law, _SHORTEST)
    for rounds_left in range(_ROUNDS, -1, -1):
        exact = _expanded(joints, law, breaks)
        # Without their start values, which would cost digits.
        coefficients = hermite_pieces(*exact.at_edges(joints), np.diff(breaks))
        parts = _parts(exact, coefficients)
        if rounds_left == 0 or (parts == 1).all():
            break
        breaks = divided(breaks, parts)
    coefficients[:, 0] += exact.starts
    return PiecewisePolynomial(breaks, coefficients)


def times_at(law: PiecewisePolynomial, s: Array) -> Array:
    """Return when a non-decreasing law reaches places between its ends; shape (N,), [s]."""
    breaks, places = np.ascontiguousarray(law.breaks), np.ascontiguousarray(s, dtype=float)
    found: Array = reached(breaks, np.ascontiguousarray(law.coefficients), law.at(breaks)[:, 0].copy(), places)
    return found


def _breaks(joints: PiecewisePolynomial, law: PiecewisePolynomial, least: float) -> Array:
    """Return the times of all breaks; those of the joints that nearly coincide with others are left out."""
    shortest = least * law.duration
    between = times_at(law, joints.breaks[1:-1]) if len(joints.breaks) > 2 else np.empty(0)
    distances = np.abs(between[:, None] - law.breaks).min(axis=1, initial=np.inf)
    between = between[(distances > shortest) & (np.diff(between, prepend=-np.inf) > shortest)]
    return np.union1d(law.breaks, between)


def _expanded(joints: PiecewisePolynomial, law: PiecewisePolynomial, breaks: Array) -> _Expansion:
    by_time = cut(law, breaks)
    by_s = cut(joints, np.append(by_time[:, 0, 0], joints.breaks[-1]))
    starts, places = by_s[:, 0].copy(), by_time[:, 0, 0].copy()
    by_time[:, 0], by_s[:, 0] = 0.0, 0.0
    return _Expansion(breaks, by_time, by_s, starts, places)


def _chained(along: Sequence[Array], rates: Sequence[Array]) -> Array:
    """Apply the chain rule: q and its s-derivatives with ṡ, s̈, s⃛ → q and its time derivatives; shape (4, M, n)."""
    q, first, second, third = along
    v, a, j = rates
    return np.stack((q, first * v, first * a + second * v**2, first * j + second * (3.0 * v * a) + third * v**3))


def _parts(exact: _Expansion, coefficients: Array) -> Indices:
    widths = np.diff(exact.breaks)[:, None]
    errors, sizes = np.zeros((4, len(widths))), np.zeros((4, 1, coefficients.shape[2]))
    for tau in _PROBES:
        true, found = exact.at(tau * widths), np.stack(derivatives(coefficients, tau * widths))
        sizes = np.maximum(sizes, np.abs(true).max(axis=1, keepdims=True, initial=0.0))
        scale = np.where(np.arange(4)[:, None, None] == 0, 1.0, np.maximum(sizes, np.finfo(float).tiny))
        errors = np.maximum(errors, np.abs((true - found) / scale).max(axis=2, initial=0.0))
    orders = 8.0 - np.arange(4.0)
    parts = np.ceil((errors / _TOLERANCES[:, None]) ** (1.0 / orders[:, None])).max(axis=0)
    most = np.maximum(1.0, widths[:, 0] / (_SHORTEST * (exact.breaks[-1] - exact.breaks[0])))
    result: Indices = np.clip(parts, 1.0, np.minimum(most, _MOST_PARTS)).astype(np.int64)
    return result
