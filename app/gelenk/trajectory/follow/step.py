"""One piece of the joint path, from knot to knot, and how accurate it is in between.

Between two exact knots q is the quintic with the same q, q' and q'' at both. A piece is accepted if its poses are on
the path within a share of the tolerance, and its rates agree with the field.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from math import comb, perm

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.follow.rate_field import SHARE, Knot, RateField, taken
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.paths import PathSamples

_QUINTIC = hermite_pieces(np.eye(6)[:3, None], np.eye(6)[3:, None], np.ones(1))[0]
"""Coefficients of the six quintics with one end condition 1 and the others 0, by powers of τ; shape (6, 6)."""
BERNSTEIN = np.array([[comb(i, k) / comb(5, k) for k in range(6)] for i in range(6)])
"""Bernstein coefficients from power coefficients: a quintic stays between the smallest and the largest of them."""
INNER = np.arange(1, 8) / 8.0
"""Places between 0 and 1 at which a piece is examined."""


def _basis(taus: Array, order: int = 0) -> Array:
    """Evaluate the six quintics, or a derivative of them; shape (N, 6)."""
    powers = np.arange(6)
    factors = np.array([perm(k, order) for k in range(6)], dtype=float)
    values: Array = (factors * taus[:, None] ** np.maximum(powers - order, 0)) @ _QUINTIC
    return values


_VALUES, _RATES = _basis(INNER), _basis(INNER, 1)
HULL, TO_POWERS = BERNSTEIN @ _QUINTIC, _QUINTIC
"""Matrices from a quintic's end conditions to its Bernstein and power coefficients."""

RATE_TOLERANCE = 1e-3
"""Largest error of q' between knots, in fractions of the largest q' there."""
_SETTLED = 1e-12
"""Change of the joints that counts as none, [rad or m]."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of the joint path between two knots.

    Attributes:
        data: q, hq', h²q'' at both; shape (6, n).
        sigmas: The smallest singular value at a, in between, and at b; shape (9,).
        deviations: Largest distance [m] and angle [rad] of the tip from the path.
        ratio: Largest ratio of an error to what is allowed.
    """

    a: Knot
    b: Knot
    data: Array
    sigmas: Array
    deviations: Array
    ratio: float

    @property
    def width(self) -> float:
        """Width h of the piece, [m or rad]."""
        return self.b.s - self.a.s

    def at(self, taus: Array) -> Array:
        """Return configurations at places from 0 to 1; shape (N, n)."""
        return rates_of(taus, 0, self.data)


def rates_of(taus: Array, order: int, data: Array) -> Array:
    """Return a derivative by τ of a quintic at places from 0 to 1; shape (N, n)."""
    return _basis(taus, order) @ data


def end_conditions(a: Knot, b: Knot) -> Array:
    """Return the end conditions of the quintic in τ between two knots; shape (6, n)."""
    h = b.s - a.s
    return np.array([a.q, h * a.dq, h * h * a.ddq, b.q, h * b.dq, h * h * b.ddq])


def attempt(field: RateField, a: Knot, s: float, stretch: tuple[float, float]) -> Piece | None:
    """Return the piece from a knot to a place in the same stretch, whatever its errors; None without an exact knot."""
    at = field.samples(np.append(a.s + (s - a.s) * INNER, s), *stretch)
    b = next_knot(field, a, s, taken(at, slice(-1, None)))
    return None if b is None else pieces_between(field, [a, b], taken(at, slice(0, -1)))[0]


def pieces_between(field: RateField, knots: list[Knot], at: PathSamples) -> list[Piece]:
    """Return the quintics between M + 1 knots with their errors at the inner samples `at`, seven for each of them."""
    data = np.array([end_conditions(a, b) for a, b in pairwise(knots)])
    qs, h = values_within(data), np.diff([knot.s for knot in knots])
    dqs, sigmas = field.velocities(at, qs)
    offsets = np.array([knot.offset for knot in knots[:-1]])
    tolerances = SHARE * np.array(field.tolerances)
    ratios, deviations = judged(data, h, np.ascontiguousarray(dqs), field.errors(at, qs), offsets, tolerances)
    rows = zip(pairwise(knots), data, sigmas.reshape(len(h), -1), deviations, ratios, strict=True)
    return [
        Piece(a, b, own, np.concatenate(([a.sigma], inner, [b.sigma])), deviation, float(ratio))
        for (a, b), own, inner, deviation, ratio in rows
    ]


@compiled
def values_within(data: Array) -> Array:
    """Return the configurations at the inner samples of M quintics by their end conditions; shape (7M, n)."""
    qs = np.zeros((len(INNER) * len(data), data.shape[2]))
    for i in range(len(qs)):
        for m in range(6):
            for j in range(qs.shape[1]):
                qs[i, j] += _VALUES[i % len(INNER), m] * data[i // len(INNER), m, j]
    return qs


@compiled
def judged(
    data: Array, widths: Array, velocities: Array, errors: Array, offsets: Array, tolerances: Array
) -> tuple[Array, Array]:
    """Return the largest ratio of an error of each of M quintics to what is allowed, (M,), and deviations, (M, 2).

    Args:
        data: End conditions; shape (M, 6, n).
        widths: Shape (M,), [m or rad].
        velocities: The field's q' at the inner samples, seven for each quintic; shape (7M, n).
        errors: Distances [m] and angles [rad] of the tip there from the path; shape (2, 7M).
        offsets: Distance of the first knot of each from the path; shape (M,).
        tolerances: Allowed distance [m] and angle [rad]; shape (2,).
    """
    ratios, deviations, inner = np.empty(len(data)), np.zeros((len(data), 2)), len(INNER)
    for i in range(len(data)):
        fastest, missed = 1e-300, 0.0
        for k in range(inner * i, inner * i + inner):
            for j in range(data.shape[2]):
                rate = 0.0
                for m in range(6):
                    rate += _RATES[k - inner * i, m] * data[i, m, j]
                missed = _larger(missed, abs(rate / widths[i] - velocities[k, j]))
                fastest = max(fastest, abs(velocities[k, j]))
                fastest = max(fastest, max(abs(data[i, 1, j]), abs(data[i, 4, j])) / widths[i])
            for side in range(2):
                deviations[i, side] = _larger(deviations[i, side], errors[side, k])
        ratios[i] = missed / (RATE_TOLERANCE * fastest + 20.0 * offsets[i] / widths[i])
        for side in range(2):
            ratios[i] = _larger(ratios[i], deviations[i, side] / (tolerances[side] + 10.0 * offsets[i]))
    return ratios, deviations


@inlined
def _larger(one: float, other: float) -> float:
    """Return the larger number, NaN if one is."""
    return one if one >= other or math.isnan(one) else other


def next_knot(field: RateField, a: Knot, s: float, at: PathSamples) -> Knot | None:
    """Return the knot of the same branch at a place, `at` being the path's sample there; None if none is near.

    For a redundant arm the self-motion follows the field, by the formula of fourth order from q' and q'' at both ends;
    other arms have no choice.
    """
    h = s - a.s
    b = field.next_to(s, at, a.q + h * (a.dq + 0.5 * h * a.ddq))
    for _ in range(2 if field.is_redundant else 0):
        if b is None:
            return None
        wanted = a.q + 0.5 * h * (a.dq + b.dq) + h * h / 12.0 * (a.ddq - b.ddq) - b.q
        along = wanted - b.span.T @ (b.span @ wanted)
        if float(np.abs(along).max()) <= _SETTLED:
            break
        b = field.next_to(s, at, b.q + along)
    return b


def knot_within(field: RateField, piece: Piece, s: float, stretch: tuple[float, float]) -> Knot | None:
    """Return the exact knot at a place within a piece; None if there is none near the quintic."""
    at = field.samples(np.array([s]), *stretch)
    return field.next_to(s, at, piece.at(np.array([(s - piece.a.s) / piece.width]))[0])
