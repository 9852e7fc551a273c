"""The joint path along a whole path at once, where nothing stands in its way.

Each stretch without a break is sampled in one go and followed by compiled elimination; then all its pieces together are
judged as `bounds` judges one. If anything is in doubt there is no trace here, and `integrate` goes from knot to knot.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from gelenk.ik.search.iteration import FULL
from gelenk.ik.search.task import FULL_POSE, task_errors
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.follow.bounds import CERTAIN, FINEST, SLACK
from gelenk.trajectory.follow.kernels.elimination import rates_at
from gelenk.trajectory.follow.kernels.walk import Walk, walked
from gelenk.trajectory.follow.rate_field import SHARE, RateField, sampled
from gelenk.trajectory.follow.step import HULL, INNER, judged, values_within
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, divided
from gelenk.trajectory.motion.time_laws import hermite_pieces

_PIECES, _MOST_PIECES, _ROUNDS = 8, 100, 5
"""Pieces of each stretch without a break, at first and at most, and how often they are divided."""
_ON_PATH = 1e-9
"""Distance of the start from the path that counts as none, [rad or m]."""


class _Bounds(NamedTuple):
    """What quintics must keep.

    Attributes:
        joints: Limits, (2, n), [rad or m].
        tolerances: Of the tip's distance [m] and angle [rad] from the path; shape (2,).
        threshold: Of the smallest singular value.
    """

    joints: Array
    tolerances: Array
    threshold: float


class _Stretch(NamedTuple):
    """Quintics along a part of the path without a break.

    Attributes:
        is_whole: Whether there is a knot at each place, far from singularities.
        is_clear: Whether, also between them, the joints keep their limits, and σ stays above the threshold.
        rates: q, q' and q'' at the knots; shape (3, M + 1, n).
        ratios: Of the largest error in each piece to what is allowed; shape (M,).
        deviations: Largest distance [m] and angle [rad] of the tip from the path in each; shape (M, 2).
    """

    is_whole: bool
    is_clear: bool
    rates: Array
    ratios: Array
    deviations: Array


def swept(field: RateField, start: Array) -> tuple[PiecewisePolynomial, Array] | None:
    """Follow the path to its end from a configuration at its first pose, (n,); None if anything is in doubt.

    Returned are quintics q(s), and the largest distance [m] and angle [rad] of the tip from the path, (2,).
    """
    if not len(field.task) == len(FULL_POSE) <= len(field.chain):
        return None
    chain, slack = field.chain, SLACK if field.limited else np.inf
    joints = np.stack((chain.lower - slack, chain.upper + slack))
    bounds = _Bounds(joints, SHARE * np.array(field.tolerances), field.threshold)
    breaks, rates, deviations = [np.zeros(1)], [np.array(start)[None, None]], []
    for ends in pairwise((0.0, *field.path.breaks, field.path.extent)):
        found = _along(field, rates[-1][0, -1], ends, bounds)
        if found is None:
            return None
        breaks.append(found[0][1:])
        rates.append(found[1].rates)
        deviations.append(found[1].deviations)
    starts = np.concatenate([one[:, :-1] for one in rates[1:]], axis=1)
    finishes = np.concatenate([one[:, 1:] for one in rates[1:]], axis=1)
    every = np.concatenate(breaks)
    positions = PiecewisePolynomial(every, hermite_pieces(starts, finishes, np.diff(every)))
    return positions, np.concatenate(deviations).max(axis=0)


def _along(
    field: RateField, start: Array, stretch: tuple[float, float], bounds: _Bounds
) -> tuple[Array, _Stretch] | None:
    """Follow a stretch by quintics, divided where the errors between knots are too large; return their ends too."""
    breaks, first = np.linspace(*stretch, _PIECES + 1), np.ascontiguousarray(start)
    for _ in range(_ROUNDS):
        inner = breaks[:-1, None] + np.diff(breaks)[:, None] * INNER
        at = field.samples(np.concatenate((breaks, inner.ravel())), *stretch)
        found = followed(field.chain.flat, breaks, *sampled(at), first, bounds)
        if not found.is_whole:
            return None
        if (found.ratios <= 1.0).all():
            return (breaks, found) if found.is_clear else None
        # The error of the rates is of fifth order.
        parts = np.ceil(np.clip(1.1 * found.ratios**0.2, 1.0, _PIECES)).astype(np.int64)
        if not np.isfinite(found.ratios).all() or parts.sum() > _MOST_PIECES:
            return None
        breaks = divided(breaks, np.where(found.ratios > 1.0, parts, 1))
    return None


@compiled
def followed(
    flat: FlatChain,
    breaks: Array,
    positions: Array,
    rotations: Array,
    twists: Array,
    bends: Array,
    start: Array,
    bounds: _Bounds,
) -> _Stretch:
    """Follow a path from a configuration by quintics, and judge them.

    Args:
        breaks: Places of their ends; shape (M + 1,), [m or rad].
        positions, rotations, twists, bends: The path at all of them, and then at seven places within each piece.
        start: At the first place; shape (n,), [rad or m].
    """
    count, n = len(breaks) - 1, len(start)
    walk = walked(flat, breaks, positions, rotations, twists, bends, start)
    ratios, deviations = np.full(count, np.inf), np.zeros((count, 2))
    if not walk.is_whole or np.abs(walk.rates[0, 0] - start).max() > _ON_PATH:
        return _Stretch(False, False, walk.rates, ratios, deviations)
    widths, data = np.diff(breaks), np.empty((count, 6, n))
    for i in range(count):
        for order in range(3):
            data[i, order] = widths[i] ** order * walk.rates[order, i]
            data[i, 3 + order] = widths[i] ** order * walk.rates[order, i + 1]
    qs = values_within(data)
    dqs, sigmas = rates_at(flat, twists[count + 1 :], qs)
    tips, turned = chain_poses(flat, qs)
    errors = task_errors(np.ones(6), FULL, 0, positions[count + 1 :], rotations[count + 1 :], tips, turned)
    ratios, deviations = judged(data, widths, dqs, errors, np.zeros(count), bounds.tolerances)
    is_clear = _is_within(data, bounds.joints) and _is_regular(walk, sigmas, widths, bounds.threshold)
    return _Stretch(True, is_clear, walk.rates, ratios, deviations)


@inlined
def _is_within(data: Array, joints: Array) -> bool:
    """Return whether the joints stay within their limits, also between samples."""
    for i in range(len(data)):
        for k in range(6):
            for j in range(data.shape[2]):
                value = 0.0
                for m in range(6):
                    value += HULL[k, m] * data[i, m, j]
                if not joints[0, j] <= value <= joints[1, j]:
                    return False
    return True


@compiled
def _is_regular(walk: Walk, inner: Array, widths: Array, threshold: float) -> bool:
    """Return whether σ stays above the threshold, also between samples; `inner` bounds it from below within pieces."""
    per_piece = len(INNER)
    for i in range(len(widths)):
        step = CERTAIN * widths[i] * max(walk.changes[i], walk.changes[i + 1]) / (per_piece + 1)
        before = walk.sigmas[i]
        for k in range(per_piece + 1):
            after = inner[per_piece * i + k] if k < per_piece else walk.sigmas[i + 1]
            is_above = before >= threshold and after >= threshold
            if threshold > 0.0 and not (is_above and 0.5 * (before + after - step) >= (1.0 - FINEST) * threshold):
                return False
            before = after
    return True
