"""Refinement of a joint path until q'' is as accurate as q, so that peaks and durations are those of the exact path.

Quintics within a tolerance of the position are far less accurate in q'', and so in peaks of acceleration. Such pieces
get more knots, many at once: the exact path is a few Newton steps away from a quintic; for redundant arms the nearest
exact configuration is taken.
"""

import math
from typing import cast

import numpy as np

from gelenk.ik.search.task import FULL_POSE
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.trajectory.audit.result import PathError
from gelenk.trajectory.follow.bounds import SLACK
from gelenk.trajectory.follow.nearest import beside
from gelenk.trajectory.follow.rate_field import RateField, sampled
from gelenk.trajectory.follow.rows import row_derivatives, task_rows
from gelenk.trajectory.motion.composition import RATES_KNOWN
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, bernstein, cut, derivatives, divided
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.path_geometry import LimitedPath
from gelenk.trajectory.paths.paths import PathSamples
from gelenk.trajectory.timing.timing import Timed

TOLERANCE = 1e-6
"""Largest error of q'', in fractions of the largest q'' of its piece, or of q' over the length of the path."""
_PROBES = np.array([0.14, 0.5, 0.86])
"""Places in a piece where that error is largest: it varies as the second derivative of τ³(1 - τ)³."""
_ROUNDS, _MOST_PARTS = 4, 16
_SHORTEST = 1e-2
"""Least length of a new piece, in fractions of the path."""
_ROUNDING = 1e-13
"""Rounding of q, in fractions of 1 plus its magnitude, [rad or m]."""
_FIRST, _THIRD = 0.144, 16.0
"""Largest errors of q' and q''': these factors times that of q'', times or over the length of the piece."""
_UNSEEN = 1.5
"""Safety factor for errors larger than at the probes."""
_STEPS, _SETTLED, _RANK = 4, 1e-11, 1e-13


def refined(field: RateField, positions: PiecewisePolynomial) -> tuple[PiecewisePolynomial, Array]:
    """Add knots to a path q(s) of quintics where its q'' differs from the exact one.

    Pieces too near to singularities or joint limits stay unchanged. Returned are the path in M pieces, and the largest
    error of q'' for each piece and joint, ∞ where unknown; (M, n).
    """
    for left in reversed(range(_ROUNDS)):
        off, parts = _errors(field, positions)
        if left == 0 or (parts == 1).all():
            break
        positions = _with_exact_knots(field, positions, parts)
    return positions, off


def path_error(joints: PiecewisePolynomial, off: Array | None, timing: Timed, geometry: LimitedPath) -> PathError:
    """Bound how much a motion's ratios to limits differ from those of the exact path; None where unknown.

    `off` is the largest error of q'' in each of the M pieces of the joints' path; shape (M, n), None off the path.
    """
    if off is None:
        return PathError(None, None, None)
    breaks, law = timing.motion.breaks, timing.law
    times = (breaks[:-1] + np.array([[1e-6], [0.5], [1.0 - 1e-6]]) * np.diff(breaks)).ravel()
    phase = np.searchsorted(law.breaks[1:-1], times, side="right")
    s, v, a, j = np.abs(derivatives(law.coefficients[phase], (times - law.breaks[phase])[:, None]))[:, :, 0]
    every = np.arange(len(geometry.joints.breaks) - 1)
    own = np.searchsorted(joints.breaks, 0.5 * (geometry.joints.breaks[:-1] + geometry.joints.breaks[1:])) - 1
    shares = (_UNSEEN * off[own, None] / geometry.joint_bounds(every)).max(axis=2, initial=0.0)
    piece = geometry.piece_of(s)
    widths = np.diff(joints.breaks)[own][piece]
    first, third = _FIRST * widths, _THIRD / widths
    demands = (first * v, first * a + v**2, first * j + 3.0 * v * a + third * v**3)
    with np.errstate(invalid="ignore"):  # An unknown error times a rate of zero is NaN.
        found = [
            float(np.fmax.reduce(share[piece] * demand, initial=0.0)) + known
            for share, demand, known in zip(shares.T, demands, RATES_KNOWN, strict=True)
        ]
    return PathError(*(value if math.isfinite(value) else None for value in found))


def _errors(field: RateField, positions: PiecewisePolynomial) -> tuple[Array, Indices]:
    """Return the largest error of q'' in each piece, (M, n), and the number of parts to divide it into, (M,)."""
    widths, extent = np.diff(positions.breaks), field.path.extent
    places = (positions.breaks[:-1, None] + _PROBES * widths[:, None]).ravel()
    rates = positions.rates_at(places)
    exact, near = exact_next_to(field, field.path.at(places), *rates)
    errors = np.where(near[:, None], np.abs(exact[2] - rates[2]), np.inf)
    q, first, second, off = (
        np.abs(values).reshape(len(widths), len(_PROBES), -1).max(axis=1) for values in (*rates, errors)
    )
    bend = np.maximum(second.max(axis=1), first.max(axis=1) / extent)
    allowed = TOLERANCE * bend + _ROUNDING * (1.0 + q.max(axis=1)) / widths**2
    ratios = off.max(axis=1) / np.maximum(allowed, np.finfo(float).tiny)
    # The error is of fourth order in the piece's length.
    wanted = np.where((ratios > 1.0) & np.isfinite(ratios), np.ceil(1.05 * ratios**0.25), 1.0)
    most = np.clip(widths / (_SHORTEST * extent), 1.0, _MOST_PARTS)
    return off, np.minimum(wanted, most).astype(np.int64)


def _with_exact_knots(field: RateField, positions: PiecewisePolynomial, parts: Indices) -> PiecewisePolynomial:
    """Divide pieces at exact knots; a piece that would then leave the joint limits keeps its own quintic."""
    piece, widths = np.repeat(np.arange(len(parts)), parts), np.diff(positions.breaks)
    breaks = divided(positions.breaks, parts)
    own = cut(positions, breaks)
    starts = np.stack((own[:, 0], own[:, 1], 2.0 * own[:, 2]))
    new = np.diff(piece, prepend=-1) == 0
    starts[:, new] = exact_next_to(field, field.path.at(breaks[:-1][new]), *starts[:, new])[0]
    ends = np.roll(starts, -1, axis=1)
    ends[:, np.append(~new[1:], True)] = np.stack(derivatives(positions.coefficients, widths[:, None], 2))
    lengths = np.diff(breaks)
    coefficients = hermite_pieces(starts, ends, lengths)
    hull = bernstein(coefficients * lengths[:, None, None] ** np.arange(coefficients.shape[1])[:, None])
    beyond = (hull < field.chain.lower - SLACK) | (hull > field.chain.upper + SLACK)
    is_beyond = np.zeros(len(parts), dtype=bool)
    is_beyond[piece[beyond.any(axis=(1, 2))]] = True
    unchanged = is_beyond[piece]
    coefficients[unchanged] = own[unchanged]
    return PiecewisePolynomial(breaks, coefficients)


def exact_next_to(field: RateField, at: PathSamples, q: Array, first: Array, second: Array) -> tuple[Array, Flags]:
    """Return q, q', q'' of the exact path next to given ones, (3, N, n), and whether found; if not, the given ones."""
    chain, task = field.chain, field.task
    if len(task) == len(FULL_POSE) <= len(chain):
        given = np.array((q, first, second))
        found, lasts = beside(chain.flat, *sampled(at), given, _STEPS)
        near = lasts <= _SETTLED * (1.0 + np.abs(q).max(axis=1))
        return np.where(near[:, None], found, given), near
    rows, exact = task_rows(chain, task, at, q), q
    inverses = _inverses(rows.jacobians)
    for _ in range(_STEPS):
        step = _times(inverses, rows.errors)
        exact = exact + step
        rows = task_rows(chain, task, at, exact)
    inverses = _inverses(rows.jacobians)
    rates = first + _times(inverses, rows.rates - _times(rows.jacobians, first))
    changes, bends = row_derivatives(chain, task, at, exact, rates)
    bend = second + _times(inverses, bends - _times(changes, rates) - _times(rows.jacobians, second))
    near = np.abs(step).max(axis=1) <= _SETTLED * (1.0 + np.abs(q).max(axis=1))
    return np.where(near[:, None], (exact, rates, bend), (q, first, second)), near


def _inverses(matrices: Array) -> Array:
    return cast(Array, np.linalg.pinv(matrices, rcond=_RANK))


def _times(matrices: Array, vectors: Array) -> Array:
    return (matrices @ vectors[:, :, None])[:, :, 0]
