"""The exact joint path next to a guide: configurations on the path near it, with its motion along the self-motion."""

from itertools import pairwise

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.ahead import onto
from gelenk.trajectory.follow.bounds import Crossing
from gelenk.trajectory.follow.exact import exact_next_to, with_exact_knots
from gelenk.trajectory.follow.integrate import Trace, first_crossing
from gelenk.trajectory.follow.rate_field import SHARE, Knot, RateField
from gelenk.trajectory.follow.rows import row_derivatives, task_rows
from gelenk.trajectory.follow.step import INNER, Piece, piece_between
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import hermite_pieces

_STEPS = 5
"""Newton's steps from the guide onto the path."""
_ROUNDS = 6
"""How often pieces that leave the path are halved."""


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
    at, (q, first, second) = field.samples(places, *stretch), guide.rates_at(places)
    rates, found = exact_next_to(field, at, onto(field, at, q, _STEPS)[0], first, second)
    if not found.all():
        return None
    offset = float(np.abs(rates[0, 0] - start).max())
    rates[0, 0] = start
    positions = PiecewisePolynomial(places, hermite_pieces(rates[:, :-1], rates[:, 1:], np.diff(places)))
    allowed = SHARE * np.array(field.tolerances) + 10.0 * offset
    for _ in range(_ROUNDS):
        knots = _knots(field, positions, stretch)
        pieces = [
            piece_between(field, a, b, field.samples(a.s + (b.s - a.s) * INNER, *stretch)) for a, b in pairwise(knots)
        ]
        off = np.array([(piece.deviations > allowed).any() for piece in pieces])
        if not off.any():
            return pieces
        positions = with_exact_knots(field, positions, 1 + off)
    return None


def _knots(field: RateField, positions: PiecewisePolynomial, stretch: tuple[float, float]) -> list[Knot]:
    places = positions.breaks
    at, (q, dq, ddq) = field.samples(places, *stretch), positions.rates_at(places)
    rows = task_rows(field.chain, field.task, at, q)
    _, sigmas, right = np.linalg.svd(rows.jacobians, full_matrices=False)
    changes = np.sqrt(np.square(row_derivatives(field.chain, field.task, at, q, dq)[0]).sum(axis=(1, 2)))
    columns = zip(places.tolist(), q, dq, ddq, sigmas[:, -1].tolist(), right, changes.tolist(), strict=True)
    return [Knot(*column) for column in columns]
