"""The joint path along a whole path at once, where nothing stands in its way.

Each stretch without a break is sampled in one go and followed by compiled elimination; then all its pieces together are
judged as `bounds` judges one. If anything is in doubt there is no trace here, and `integrate` goes from knot to knot.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gelenk.ik.search.task import FULL_POSE
from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.bounds import CERTAIN, FINEST, SLACK
from gelenk.trajectory.follow.nearest import Walk, rates_at, walked
from gelenk.trajectory.follow.rate_field import RateField, sampled, taken
from gelenk.trajectory.follow.step import HULL, INNER, judged, values_within
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, divided
from gelenk.trajectory.motion.time_laws import hermite_pieces

_PIECES, _MOST_PIECES, _ROUNDS = 8, 100, 5
"""Pieces of each stretch without a break, at first and at most, and how often they are divided."""
_ON_PATH = 1e-9
"""Distance of the start from the path that counts as none, [rad or m]."""


@dataclass(frozen=True, slots=True)
class _Stretch:
    """Quintics along a part of the path without a break.

    Attributes:
        breaks: Places of their ends; shape (M + 1,), [m or rad].
        rates: q, q' and q'' there; shape (3, M + 1, n).
        deviations: Largest distance [m] and angle [rad] of the tip from the path in each; shape (M, 2).
    """

    breaks: Array
    rates: Array
    deviations: Array


def swept(field: RateField, start: Array) -> tuple[PiecewisePolynomial, Array] | None:
    """Follow the path to its end from a configuration at its first pose, (n,); None if anything is in doubt.

    Returned are quintics q(s), and the largest distance [m] and angle [rad] of the tip from the path, (2,).
    """
    if not len(field.task) == len(FULL_POSE) <= len(field.chain):
        return None
    found: list[_Stretch] = []
    for ends in pairwise((0.0, *field.path.breaks, field.path.extent)):
        stretch = _along(field, found[-1].rates[0, -1] if found else start, ends)
        if stretch is None:
            return None
        found.append(stretch)
    breaks = np.concatenate((found[0].breaks[:1], *(one.breaks[1:] for one in found)))
    starts = np.concatenate([one.rates[:, :-1] for one in found], axis=1)
    ends_ = np.concatenate([one.rates[:, 1:] for one in found], axis=1)
    positions = PiecewisePolynomial(breaks, hermite_pieces(starts, ends_, np.diff(breaks)))
    return positions, np.concatenate([one.deviations for one in found]).max(axis=0)


def _along(field: RateField, start: Array, stretch: tuple[float, float]) -> _Stretch | None:
    """Follow a stretch by quintics, divided where the errors between knots are too large."""
    breaks = np.linspace(*stretch, _PIECES + 1)
    for _ in range(_ROUNDS):
        h = np.diff(breaks)
        at = field.samples(np.concatenate((breaks, (breaks[:-1, None] + h[:, None] * INNER).ravel())), *stretch)
        at_knots, within = taken(at, slice(0, len(breaks))), taken(at, slice(len(breaks), None))
        walk = walked(field.chain.flat, breaks, *sampled(at_knots), np.ascontiguousarray(start))
        if not walk.is_whole or np.abs(walk.rates[0, 0] - start).max() > _ON_PATH:
            return None
        powers = h[:, None] ** np.arange(3)[:, None, None]
        data = np.concatenate((powers * walk.rates[:, :-1], powers * walk.rates[:, 1:])).transpose(1, 0, 2)
        qs = values_within(data)
        dqs, sigmas = rates_at(field.chain.flat, np.ascontiguousarray(within.first), qs)
        ratios, deviations = judged(field, within, (data, h), (qs, dqs), np.zeros(len(h)))
        if (ratios <= 1.0).all():
            is_clear = _is_within(field, data) and _is_regular(field, walk, sigmas.reshape(len(h), -1), h)
            return _Stretch(breaks, walk.rates, deviations) if is_clear else None
        # The error of the rates is of fifth order.
        parts = np.ceil(np.clip(1.1 * ratios**0.2, 1.0, _PIECES)).astype(np.int64)
        if not np.isfinite(ratios).all() or parts.sum() > _MOST_PIECES:
            return None
        breaks = divided(breaks, np.where(ratios > 1.0, parts, 1))
    return None


def _is_within(field: RateField, data: Array) -> bool:
    """Return whether the joints stay within their limits, also between samples."""
    hulls = HULL @ data
    within = (hulls >= field.chain.lower - SLACK) & (hulls <= field.chain.upper + SLACK)
    return bool(within.all() or not field.limited)


def _is_regular(field: RateField, walk: Walk, inner: Array, widths: Array) -> bool:
    """Return whether σ stays above the threshold, also between samples; `inner` bounds it from below within pieces."""
    sigmas = np.column_stack((walk.sigmas[:-1], inner, walk.sigmas[1:]))
    steps = widths * np.maximum(walk.changes[:-1], walk.changes[1:]) / (len(INNER) + 1)
    between = 0.5 * (sigmas[:, :-1] + sigmas[:, 1:] - CERTAIN * steps[:, None])
    is_regular = (sigmas >= field.threshold).all() and (between >= (1.0 - FINEST) * field.threshold).all()
    return bool(is_regular or field.threshold <= 0.0)
