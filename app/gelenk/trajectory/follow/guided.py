"""The exact joint path next to a guide: configurations on the path near it, with its motion along the self-motion."""

from itertools import pairwise

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.ahead import onto
from gelenk.trajectory.follow.bounds import Crossing
from gelenk.trajectory.follow.exact import exact_next_to
from gelenk.trajectory.follow.integrate import Trace, first_crossing
from gelenk.trajectory.follow.rate_field import SHARE, Knot, RateField
from gelenk.trajectory.follow.step import INNER, Piece, pieces_between
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, divided

_STEPS = 5
"""Newton's steps from the guide onto the path."""
_ROUNDS = 6
"""How often pieces that leave the path are halved, as long as that halves what they are off."""


def guided(field: RateField, start: Array, guide: PiecewisePolynomial) -> Trace:
    """Trace the joint path along a guide, from a configuration at the path's first pose to the first violation."""
    trace = Trace(start, [])
    for stretch in pairwise((0.0, *field.path.breaks, field.path.extent)):
        pieces = _pieces(field, trace.last, guide, stretch)
        if pieces is None:
            trace.ending, trace.crossing = "lost", Crossing(trace.reached, trace.reached, "lost")
            return trace
        for piece in pieces:
            trace.best = max(trace.best, piece.a.sigma)
            crossing = first_crossing(field, piece, stretch, trace)
            if crossing is not None:
                trace.ending, trace.crossing = crossing.kind, crossing
                return trace
            trace.pieces.append(piece)
    return trace


def _pieces(
    field: RateField, start: Array, guide: PiecewisePolynomial, stretch: tuple[float, float]
) -> list[Piece] | None:
    """Return the pieces between two breaks of the path; None if none are close enough to it."""
    inner = guide.breaks[(guide.breaks > stretch[0]) & (guide.breaks < stretch[1])]
    places = np.concatenate((stretch[:1], inner, stretch[1:]))
    worst = np.inf
    for _ in range(_ROUNDS):
        knots = _knots(field, start, guide, places, stretch)
        if not knots:
            break
        inner = places[:-1, None] + np.diff(places)[:, None] * INNER
        pieces = pieces_between(field, knots, field.samples(inner.ravel(), *stretch))
        allowed = SHARE * np.array(field.tolerances) + 10.0 * knots[0].offset
        off = (np.array([piece.deviations for piece in pieces]) / allowed).max(axis=1)
        if off.max() <= 1.0:
            return pieces
        if off.max() > 0.5 * worst:
            break
        worst, places = off.max(), divided(places, 1 + (off > 1.0))
    return None


def _knots(
    field: RateField, start: Array, guide: PiecewisePolynomial, places: Array, stretch: tuple[float, float]
) -> list[Knot]:
    """Return exact knots next to a guide, from the start on; none if one of them is missing."""
    at, (q, first, second) = field.samples(places, *stretch), guide.rates_at(places)
    (q, dq, ddq), found = exact_next_to(field, at, onto(field, at, q, _STEPS)[0], first, second)
    if not found.all():
        return []
    offset, q[0] = float(np.abs(q[0] - start).max()), start
    return field.knots(places, at, np.array((q, dq, ddq)), offset)
