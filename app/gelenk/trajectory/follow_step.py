"""One piece of the joints' way: from knot to knot, checked in between, and where in it something is violated first.

Between two exact knots q is the quintic with the same q, q' and q'' at both. A piece is accepted where its poses are on
the path within a share of the tolerance, and its rates those of the field.
"""

from dataclasses import dataclass
from math import comb, perm

import numpy as np

from gelenk.kinematics.kernels import chain_poses
from gelenk.model.arrays import Array
from gelenk.model.poses import Poses
from gelenk.trajectory.follow_course import Course, Knot, taken
from gelenk.trajectory.paths import PathSamples
from gelenk.trajectory.time_laws import hermite_pieces

_QUINTIC = hermite_pieces(np.eye(6)[:3, None], np.eye(6)[3:, None], np.ones(1))[0]
"""Coefficients of the six quintics of which one of the end conditions is 1, by powers of τ; shape (6, 6)."""
_BERNSTEIN = np.array([[comb(i, k) / comb(5, k) for k in range(6)] for i in range(6)])
"""Bernstein coefficients from powers: a quintic stays between the least and the largest of them."""
INNER = np.arange(1, 8) / 8.0
"""Places between 0 and 1 at which a piece is examined."""


def _basis(taus: Array, order: int = 0) -> Array:
    """Values of the six quintics, or their derivatives of some order; shape (N, 6)."""
    powers = np.arange(6)
    factors = np.array([perm(k, order) for k in range(6)], dtype=float)
    values: Array = (factors * taus[:, None] ** np.maximum(powers - order, 0)) @ _QUINTIC
    return values


_VALUES, _RATES = _basis(INNER), _basis(INNER, 1)
HULL, TO_POWERS = _BERNSTEIN @ _QUINTIC, _QUINTIC
"""Bernstein and power coefficients of a piece's quintic from its end conditions."""

RATE_TOLERANCE = 1e-3
"""Largest error of q' between knots, in fractions of the largest q' there."""
SHARE = 1.0 / 3.0
"""Of the tolerances that interpolation may use."""
_SETTLED = 1e-12
"""Change of the joints that is none, [rad or m]."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of the path between two knots.

    Attributes:
        a: Where it begins.
        b: Where it ends.
        data: q, hq', h²q'' at both; shape (6, n).
        sigmas: The smallest singular value at a, between, and at b; shape (9,).
        deviations: Largest distance [m] and angle [rad] of the tip from the path.
        ratio: Of the largest error to what is allowed.
    """

    a: Knot
    b: Knot
    data: Array
    sigmas: Array
    deviations: Array
    ratio: float

    @property
    def width(self) -> float:
        """Width of the piece, [m or rad]."""
        return self.b.s - self.a.s

    def at(self, taus: Array) -> Array:
        """Values at places from 0 to 1; shape (N, n)."""
        return rates_of(taus, 0, self.data)


def rates_of(taus: Array, order: int, data: Array) -> Array:
    """Derivatives by τ of some order of a quintic at places from 0 to 1; shape (N, n)."""
    result: Array = _basis(taus, order) @ data
    return result


def end_conditions(a: Knot, b: Knot) -> Array:
    """The conditions on a quintic in τ; shape (6, n)."""
    h = b.s - a.s
    return np.array([a.q, h * a.dq, h * h * a.ddq, b.q, h * b.dq, h * h * b.ddq])


def attempt(
    course: Course, tolerances: tuple[float, float], a: Knot, s: float, stretch: tuple[float, float]
) -> Piece | None:
    """The piece from a knot to a place, whatever its errors; None where no exact knot is near to what is expected.

    Args:
        course: What is followed.
        tolerances: Of position [m] and orientation [rad].
        a: Where the piece begins.
        s: Where it ends, [m or rad].
        stretch: The breaks of the path before and after.
    """
    at = course.samples(np.append(a.s + (s - a.s) * INNER, s), *stretch)
    b = next_knot(course, a, s, taken(at, slice(-1, None)))
    return None if b is None else piece_between(course, tolerances, a, b, taken(at, slice(0, -1)))


def piece_between(course: Course, tolerances: tuple[float, float], a: Knot, b: Knot, at: PathSamples) -> Piece:
    """The quintic from knot to knot, and how good it is in between, where the path is `at`."""
    h, data = b.s - a.s, end_conditions(a, b)
    qs = _VALUES @ data
    velocities, sigmas = course.velocities(at, qs)
    fastest = max(float(np.abs(velocities).max()), float(np.abs(data[[1, 4]]).max()) / h, 1e-300)
    rate_ratio = float(np.abs(_RATES @ data / h - velocities).max()) / (RATE_TOLERANCE * fastest + 20.0 * a.offset / h)
    errors = course.task.errors(at.poses, Poses(*chain_poses(course.chain.flat, qs)))
    deviations = errors.max(axis=1)
    ratio = max(rate_ratio, float((deviations / (SHARE * np.array(tolerances) + 10.0 * a.offset)).max()))
    return Piece(a, b, data, np.concatenate(([a.sigma], sigmas, [b.sigma])), deviations, ratio)


def next_knot(course: Course, a: Knot, s: float, at: PathSamples) -> Knot | None:
    """The knot of the same branch at a place, the path's sample being `at`; None where there is none near.

    Of joints to spare the self-motion is that of the field, by the formula of fourth order from q' and q'' at both
    ends; the others have no choice.
    """
    h = s - a.s
    b = course.next_to(s, at, a.q + h * (a.dq + 0.5 * h * a.ddq))
    for _ in range(2 if course.is_redundant else 0):
        if b is None:
            return None
        wanted = a.q + 0.5 * h * (a.dq + b.dq) + h * h / 12.0 * (a.ddq - b.ddq) - b.q
        along = wanted - b.span.T @ (b.span @ wanted)
        if float(np.abs(along).max()) <= _SETTLED:
            break
        b = course.next_to(s, at, b.q + along)
    return b


def knot_within(course: Course, piece: Piece, s: float, stretch: tuple[float, float]) -> Knot | None:
    """The exact knot at a place within a piece."""
    at = course.samples(np.array([s]), *stretch)
    return course.next_to(s, at, piece.at(np.array([(s - piece.a.s) / piece.width]))[0])
