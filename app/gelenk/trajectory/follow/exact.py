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
from gelenk.robot.compilation import compiled, inlined
from gelenk.trajectory.audit.result import PathError
from gelenk.trajectory.follow.bounds import SLACK
from gelenk.trajectory.follow.kernels.elimination import beside
from gelenk.trajectory.follow.rate_field import RateField, sampled
from gelenk.trajectory.follow.rows import row_derivatives, task_rows
from gelenk.trajectory.follow.step import BERNSTEIN
from gelenk.trajectory.motion.composition import RATES_KNOWN
from gelenk.trajectory.motion.evaluation import hermite
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, cut, divided
from gelenk.trajectory.motion.time_laws import END_CONDITIONS
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
_STEPS, _SETTLED, _RANK, _TINY = 4, 1e-11, 1e-13, 1e-300
_CONDITIONS = END_CONDITIONS[3]


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
    inner, law = geometry.joints.breaks, timing.law
    own = np.searchsorted(joints.breaks, 0.5 * (inner[:-1] + inner[1:])) - 1
    shares = (_UNSEEN * off[own, None] / geometry.joint_bounds(np.arange(len(own)))).max(axis=2, initial=0.0)
    widths, rates = np.diff(joints.breaks)[own], np.ascontiguousarray(law.coefficients)
    most = _excesses(timing.motion.breaks, law.breaks, rates[:, :, 0], inner, widths, shares)
    found = [value + known for value, known in zip(most.tolist(), RATES_KNOWN, strict=True)]
    return PathError(*(value if math.isfinite(value) else None for value in found))


@compiled
def _excesses(times: Array, breaks: Array, law: Array, places: Array, widths: Array, shares: Array) -> Array:
    """Return the largest error of velocity, acceleration and jerk, in fractions of the limits; shape (3,).

    Args:
        times: Breaks of the motion, at both sides and in the middle of which it is examined.
        breaks, law: Of s(t); shape (K + 1,), (K, d + 1).
        places: Of the joints' path; shape (M + 1,).
        widths, shares: Of the pieces before knots were added, and the errors of q'' there; shape (M,), (M, 3).
    """
    most = np.zeros(3)
    for i in range(len(times) - 1):
        for place in (1e-6, 0.5, 1.0 - 1e-6):
            time = times[i] + place * (times[i + 1] - times[i])
            phase = np.searchsorted(breaks[1:-1], time, side="right")
            s, v, a, j = _law_at(law[phase], time - breaks[phase])
            piece = np.searchsorted(places[1:-1], s, side="right")
            first, third = _FIRST * widths[piece], _THIRD / widths[piece]
            demands = (first * v, first * a + v**2, first * j + 3.0 * v * a + third * v**3)
            for order in range(3):
                # An unknown error times a rate of zero is NaN, and does not count.
                most[order] = max(most[order], shares[piece, order] * demands[order])
    return most


@inlined
def _law_at(c: Array, t: float) -> tuple[float, float, float, float]:
    """Return the magnitudes of a polynomial and of three derivatives."""
    s, v, a, j = 0.0, 0.0, 0.0, 0.0
    for k in range(len(c) - 1, -1, -1):
        s, v, a, j = s * t + c[k], v * t + s, a * t + 2.0 * v, j * t + 3.0 * a
    return abs(s), abs(v), abs(a), abs(j)


def _errors(field: RateField, positions: PiecewisePolynomial) -> tuple[Array, Indices]:
    """Return the largest error of q'' in each piece, (M, n), and the number of parts to divide it into, (M,)."""
    widths, extent = np.diff(positions.breaks), field.path.extent
    places = (positions.breaks[:-1, None] + _PROBES * widths[:, None]).ravel()
    rates = positions.rates_at(places)
    exact, near = exact_next_to(field, field.path.at(places), *rates)
    return _errors_of(np.array(rates), exact, near, widths, extent)


@compiled
def _errors_of(rates: Array, exact: Array, near: Flags, widths: Array, extent: float) -> tuple[Array, Indices]:
    """Return what `_errors` does, from given and exact q, q' and q'' at the probes, (3, 3M, n), where found."""
    count, n, probes = len(widths), rates.shape[2], len(_PROBES)
    off, parts = np.zeros((count, n)), np.ones(count, np.int64)
    for i in range(count):
        most, slope, bend = 0.0, 0.0, 0.0
        for k in range(probes * i, probes * i + probes):
            for j in range(n):
                most, slope = max(most, abs(rates[0, k, j])), max(slope, abs(rates[1, k, j]))
                bend = max(bend, abs(rates[2, k, j]))
                off[i, j] = max(off[i, j], abs(exact[2, k, j] - rates[2, k, j]) if near[k] else np.inf)
        allowed = TOLERANCE * max(bend, slope / extent) + _ROUNDING * (1.0 + most) / widths[i] ** 2
        ratio = off[i].max() / max(allowed, _TINY)
        if 1.0 < ratio < np.inf:
            # The error is of fourth order in the piece's length.
            longest = min(max(widths[i] / (_SHORTEST * extent), 1.0), _MOST_PARTS)
            parts[i] = int(min(math.ceil(1.05 * ratio**0.25), longest))
    return off, parts


def _with_exact_knots(field: RateField, positions: PiecewisePolynomial, parts: Indices) -> PiecewisePolynomial:
    """Divide pieces at exact knots; a piece that would then leave the joint limits keeps its own quintic."""
    breaks, chain = divided(positions.breaks, parts), field.chain
    own = cut(positions, breaks)
    knots = np.stack((own[:, 0], own[:, 1], 2.0 * own[:, 2]))
    new = np.diff(np.repeat(np.arange(len(parts)), parts), prepend=-1) == 0
    knots[:, new] = exact_next_to(field, field.path.at(breaks[:-1][new]), *knots[:, new])[0]
    lower, upper = chain.lower - SLACK, chain.upper + SLACK
    return PiecewisePolynomial(breaks, _rebuilt(positions.coefficients, parts, breaks, own, knots, lower, upper))


@compiled
def _rebuilt(
    pieces: Array, parts: Indices, breaks: Array, own: Array, knots: Array, lower: Array, upper: Array
) -> Array:
    """Return the quintics between knots; of a piece that would leave the limits, what it was; shape (N, 6, n).

    Args:
        pieces: Those that are divided; shape (M, d + 1, n).
        parts: Into how many each is divided; shape (M,).
        breaks: Of the parts; shape (N + 1,).
        own: What the pieces are there; shape (N, d + 1, n).
        knots: q, q' and q'' at the start of each part; shape (3, N, n).
        lower, upper: Limits, with some slack; shape (n,), [rad or m].
    """
    _, size, n = own.shape
    ends, widths, first = np.empty(knots.shape), np.diff(breaks), 0
    for i in range(len(parts)):
        last = first + parts[i] - 1
        ends[:, first:last] = knots[:, first + 1 : last + 1]
        width = breaks[last + 1] - breaks[first]
        for j in range(n):
            value, slope, bend = 0.0, 0.0, 0.0
            for k in range(size - 1, -1, -1):
                bend = bend * width + 2.0 * slope
                slope = slope * width + value
                value = value * width + pieces[i, k, j]
            ends[0, last, j], ends[1, last, j], ends[2, last, j] = value, slope, bend
        first = last + 1
    found, first = hermite(knots, ends, widths, _CONDITIONS), 0
    for i in range(len(parts)):
        last = first + parts[i]
        if not _stays_within(found[first:last], widths[first:last], lower, upper):
            found[first:last] = own[first:last]
        first = last
    return found


@compiled
def _stays_within(pieces: Array, widths: Array, lower: Array, upper: Array) -> bool:
    """Return whether no Bernstein coefficient of quintics is beyond the limits; shapes (N, 6, n), (N,), (n,)."""
    for i in range(len(pieces)):
        for k in range(6):
            for j in range(len(lower)):
                value, power = 0.0, 1.0
                for m in range(k + 1):
                    value += BERNSTEIN[k, m] * power * pieces[i, m, j]
                    power *= widths[i]
                if value < lower[j] or value > upper[j]:
                    return False
    return True


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
