"""The joint path along a whole path at once, where nothing stands in its way.

Each stretch without a break is sampled in one go and followed by compiled elimination; then all its pieces together are
judged as `bounds` judges one. If anything is in doubt there is no trace here, and `integrate` goes from knot to knot.
"""

from itertools import pairwise

import numpy as np

from gelenk.ik.search.task import FULL_POSE
from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.bounds import CERTAIN, FINEST, SLACK
from gelenk.trajectory.follow.integrate import Trace
from gelenk.trajectory.follow.nearest import walked
from gelenk.trajectory.follow.rate_field import RateField, sampled, taken
from gelenk.trajectory.follow.step import HULL, INNER, Piece, pieces_between
from gelenk.trajectory.motion.polynomial import divided

_PIECES, _MOST_PIECES, _ROUNDS = 8, 100, 5
"""Pieces of each stretch without a break, at first and at most, and how often they are divided."""
_ON_PATH = 1e-9
"""Distance of the start from the path that counts as none, [rad or m]."""


def swept(field: RateField, start: Array) -> Trace | None:
    """Trace the path to its end from a configuration at its first pose, (n,); None if anything is in doubt."""
    if not len(field.task) == len(FULL_POSE) <= len(field.chain):
        return None
    trace = Trace(start, [])
    for stretch in pairwise((0.0, *field.path.breaks, field.path.extent)):
        pieces = _pieces(field, trace.last, stretch)
        if pieces is None:
            return None
        trace.pieces += pieces
    trace.best = max(float(piece.sigmas.max()) for piece in trace.pieces)
    return trace


def _pieces(field: RateField, start: Array, stretch: tuple[float, float]) -> list[Piece] | None:
    """Return the pieces of a stretch, divided where the errors between knots are too large."""
    breaks = np.linspace(*stretch, _PIECES + 1)
    for _ in range(_ROUNDS):
        inner = breaks[:-1, None] + np.diff(breaks)[:, None] * INNER
        at = field.samples(np.concatenate((breaks, inner.ravel())), *stretch)
        at_knots = taken(at, slice(0, len(breaks)))
        is_whole, rates = walked(field.chain.flat, breaks, *sampled(at_knots), np.ascontiguousarray(start))
        if not is_whole or np.abs(rates[0, 0] - start).max() > _ON_PATH:
            return None
        knots = field.knots(breaks, at_knots, rates)
        pieces = pieces_between(field, knots, taken(at, slice(len(breaks), None)))
        ratios = np.array([piece.ratio for piece in pieces])
        if (ratios <= 1.0).all():
            return pieces if _is_clear(field, pieces) else None
        # The error of the rates is of fifth order.
        parts = np.ceil(np.clip(1.1 * ratios**0.2, 1.0, _PIECES)).astype(np.int64)
        if not np.isfinite(ratios).all() or parts.sum() > _MOST_PIECES:
            return None
        breaks = divided(breaks, np.where(ratios > 1.0, parts, 1))
    return None


def _is_clear(field: RateField, pieces: list[Piece]) -> bool:
    """Return whether the joints stay within their limits, and σ above the threshold, also between samples."""
    hulls = HULL @ np.array([piece.data for piece in pieces])
    within = (hulls >= field.chain.lower - SLACK) & (hulls <= field.chain.upper + SLACK)
    sigmas = np.array([piece.sigmas for piece in pieces])
    steps = np.array([piece.width * max(piece.a.change, piece.b.change) for piece in pieces]) / (len(INNER) + 1)
    between = 0.5 * (sigmas[:, :-1] + sigmas[:, 1:] - CERTAIN * steps[:, None])
    is_regular = (sigmas >= field.threshold).all() and (between >= (1.0 - FINEST) * field.threshold).all()
    return bool((within.all() or not field.limited) and (is_regular or field.threshold <= 0.0))
