"""The joint path along a whole path at once, where nothing stands in its way.

The path is sampled in one go and followed by compiled elimination; then all pieces together are judged as `step` and
`bounds` judge one: by the errors between knots, the limits of the joints, and σ. If anything is in doubt there is no
answer here, and `integrate` goes from knot to knot.
"""

from itertools import pairwise

import numpy as np

from gelenk.ik.search.task import FULL_POSE
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.bounds import CERTAIN, FINEST, SLACK
from gelenk.trajectory.follow.nearest import field_rates, walked
from gelenk.trajectory.follow.rate_field import SHARE, RateField, sampled, taken
from gelenk.trajectory.follow.step import INNER, RATE_TOLERANCE
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, bernstein, divided
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.paths import PathSamples

_PIECES, _MOST_PIECES, _ROUNDS = 8, 100, 5
"""Pieces of each stretch without a break, at first and at most, and how often they are divided."""
_ON_PATH = 1e-9
"""Distance of the start from the path that counts as none, [rad or m]."""


def swept(field: RateField, start: Array) -> tuple[PiecewisePolynomial, Array] | None:
    """Return q(s) to the path's end and the largest deviations, [m] and [rad]; None if anything is in doubt."""
    if not len(field.task) == len(FULL_POSE) <= len(field.chain):
        return None
    parts, deviations = [], np.zeros(2)
    for stretch in pairwise((0.0, *field.path.breaks, field.path.extent)):
        found = _stretch(field, start, stretch)
        if found is None:
            return None
        parts.append(found[0])
        deviations = np.maximum(deviations, found[1])
        start = found[0].at(found[0].breaks[-1:])[0]
    breaks = np.concatenate([parts[0].breaks[:1], *(part.breaks[1:] for part in parts)])
    return PiecewisePolynomial(breaks, np.concatenate([part.coefficients for part in parts])), deviations


def _stretch(field: RateField, start: Array, stretch: tuple[float, float]) -> tuple[PiecewisePolynomial, Array] | None:
    """Follow a stretch, and divide its pieces where the errors between knots are too large."""
    breaks = np.linspace(*stretch, _PIECES + 1)
    for _ in range(_ROUNDS):
        at = field.samples(np.concatenate((breaks, _inner(breaks).ravel())), *stretch)
        knots, inner = taken(at, slice(0, len(breaks))), taken(at, slice(len(breaks), None))
        is_whole, rates, changes = walked(field.chain.flat, breaks, *sampled(knots), np.ascontiguousarray(start))
        if not is_whole or np.abs(rates[0, 0] - start).max() > _ON_PATH:
            return None
        joints = PiecewisePolynomial(breaks, hermite_pieces(rates[:, :-1], rates[:, 1:], np.diff(breaks)))
        ratios, deviations = _errors(field, joints, inner, np.abs(rates[1]).max(axis=1))
        if (ratios <= 1.0).all():
            is_good = _within_limits(field, joints) and _is_regular(
                field, joints, np.maximum(changes[:-1], changes[1:])
            )
            return (joints, deviations) if is_good else None
        # The error of the rates is of fifth order.
        parts = np.ceil(np.clip(1.1 * ratios**0.2, 1.0, _PIECES)).astype(np.int64)
        if not np.isfinite(ratios).all() or parts.sum() > _MOST_PIECES:
            return None
        breaks = divided(breaks, np.where(ratios > 1.0, parts, 1))
    return None


def _errors(field: RateField, joints: PiecewisePolynomial, at: PathSamples, fastest: Array) -> tuple[Array, Array]:
    """Return each piece's largest ratio of an error to what is allowed, and the largest distance and angle of all."""
    qs, rates = joints.rates_at(_inner(joints.breaks).ravel())[:2]
    exact, _ = field_rates(field.chain.flat, sampled(at)[2], qs)
    shape = (len(fastest) - 1, -1)
    largest = np.maximum(np.abs(exact).reshape(shape).max(axis=1), np.maximum(fastest[:-1], fastest[1:]))
    off = np.abs(rates - exact).reshape(shape).max(axis=1) / (RATE_TOLERANCE * largest)
    deviations = field.errors(at, qs)
    shares = (deviations / (SHARE * np.array(field.tolerances))[:, None]).max(axis=0).reshape(shape).max(axis=1)
    return np.maximum(off, shares), deviations.max(axis=1)


def _inner(breaks: Array) -> Array:
    """Return the places between knots at which pieces are examined; shape (M, 7)."""
    places: Array = breaks[:-1, None] + np.diff(breaks)[:, None] * INNER
    return places


def _within_limits(field: RateField, joints: PiecewisePolynomial) -> bool:
    if not field.limited:
        return True
    powers = np.diff(joints.breaks)[:, None, None] ** np.arange(joints.coefficients.shape[1])[:, None]
    hull = bernstein(joints.coefficients * powers)
    return bool((hull >= field.chain.lower - SLACK).all() and (hull <= field.chain.upper + SLACK).all())


def _is_regular(field: RateField, joints: PiecewisePolynomial, changes: Array) -> bool:
    """Return whether σ stays above the threshold, given the largest norm of dJ/ds in each piece."""
    if field.threshold <= 0.0:
        return True
    count, widths = len(changes), np.diff(joints.breaks)
    breaks = joints.breaks[:, None]
    places = np.concatenate((breaks[:-1], _inner(joints.breaks), breaks[1:]), axis=1)
    Js = chain_jacobians(field.chain.flat, joints.at(places.ravel()))[2]
    sigmas = np.linalg.svd(Js, compute_uv=False)[:, -1].reshape(count, -1)
    between = 0.5 * (sigmas[:, :-1] + sigmas[:, 1:] - CERTAIN * (changes * widths)[:, None] / (len(INNER) + 1))
    return bool((sigmas >= field.threshold).all() and (between >= (1.0 - FINEST) * field.threshold).all())
