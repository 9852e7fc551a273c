"""Damped joint path near singularities: the tip leaves the path, and returns to it afterwards.

q' = Jᵀ(JJᵀ + λI)⁻¹(ξ + κe), with λ = σ₀²(1 - σ²/σ₀²)³ where σ is below σ₀, else 0: gains grow to little more than 1/σ₀,
and λ and its first two derivatives are continuous. The error e to the path is fed back, bounded, and less in
directions whose own σ is below σ₀, so that the tip returns. Joint rates stay below about 2 ‖ξ‖/σ₀, however near the
path passes. Beside a singularity this differential equation is stiff; an L-stable Rosenbrock method of third order
solves it [Sandu1997, RODAS3].
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array, Flags
from gelenk.trajectory.follow.bounds import Crossing, limit_crossing
from gelenk.trajectory.follow.integrate import MOST_KNOTS, Trace
from gelenk.trajectory.follow.rate_field import SHARE, Knot, RateField, beside, derivative_along
from gelenk.trajectory.follow.rows import task_rows
from gelenk.trajectory.follow.step import INNER, RATE_TOLERANCE, Piece, end_conditions, rates_of
from gelenk.trajectory.paths.paths import PathSamples

_GAIN = 50.0
"""κ times the length of the path."""
_STAGES = ((0.0, 0.5), (0.0, 1.5), (1.0, 0.0), (1.0, 0.0))
_FROM_STAGES = ((), (0.0,), (2.0, 0.0), (2.0, 0.0, 1.0))
_COUPLED = ((), (4.0,), (1.0, -1.0), (1.0, -1.0, -8.0 / 3.0))
_RESULT = np.array([2.0, 0.0, 1.0, 1.0])
_GAMMA = 0.5
_TOLERANCE = 1e-6
"""Allowed error of a step, [rad or m]."""
_NUDGE = 1e-6
"""Step of differences, [rad or m]."""
_FIRST_STEP, _SHORTEST = 1e-3, 1e-12
"""Steps in fractions of the path."""
_GROWTH, _SHRINKAGE = 3.0, 0.2
_SEARCH = 40


@dataclass(frozen=True, slots=True)
class Damped:
    """The damped field; the threshold of the exact one, which has no damping, is σ₀."""

    exact: RateField

    def velocities(self, at: PathSamples, qs: Array) -> tuple[Array, Array]:
        """See `RateField`."""
        rows = task_rows(self.exact.chain, self.exact.task, at, qs)
        left, sigmas, right = np.linalg.svd(rows.jacobians, full_matrices=False)
        near = np.clip(1.0 - np.square(sigmas / self.exact.threshold), 0.0, None) ** 3
        damping = self.exact.threshold**2 * near[:, -1:]
        squares = np.square(sigmas) + damping
        gains = np.where(squares > 0.0, sigmas / np.where(squares > 0.0, squares, 1.0), 0.0)
        back = _GAIN / self.exact.path.extent * rows.errors
        sizes, speeds = (np.linalg.norm(values, axis=1)[:, None] for values in (back, rows.rates))
        speeds = np.maximum(speeds, 1e-12)
        back /= np.sqrt(1.0 + np.square(sizes / speeds))
        wanted, returning = (np.einsum("bki,bk->bi", left, values) for values in (rows.rates, back))
        # Do not return fast in directions that the joints can hardly serve.
        dqs: Array = np.einsum("bi,bij->bj", gains * (wanted + (1.0 - near) * returning), right)
        return dqs, sigmas[:, -1]

    def knot(self, s: float, at: PathSamples, q: Array) -> Knot:
        """Return the point of the damped path at a configuration; `at` is one sample."""
        dqs, sigmas = self.velocities(at, q[None])
        sigma = float(sigmas[0])
        ddq = derivative_along(self.velocities, at, q, dqs[0], 0.1 * max(sigma, 0.1 * self.exact.threshold))
        return Knot(s, q, dqs[0], ddq, sigma, np.empty((0, len(q))), 0.0)


def damped(exact: RateField, start: Array, since: float) -> Trace:
    """Follow the damped path from place `since` to a joint limit or the end; `InvalidField` with too many knots."""
    field, trace = Damped(exact), Trace(start, [])
    for stretch in pairwise((0.0, *exact.path.breaks, exact.path.extent)):
        if stretch[1] <= since:
            continue
        begin = max(since, stretch[0])
        a = field.knot(begin, exact.samples(np.array([begin]), *stretch), trace.last)
        for piece in _pieces(field, a, stretch):
            if len(trace.pieces) >= MOST_KNOTS:
                reason = (
                    f"leaving the path and returning to it takes more than {MOST_KNOTS} knots: allow a larger tolerance"
                )
                raise InvalidField("path_tolerance", reason)
            crossing = limit_crossing(exact, piece)
            if crossing is not None:
                trace.ending, trace.crossing = "joint_limit", crossing
                cut_short(exact, trace, piece, (crossing.good - piece.a.s) / piece.width)
                return trace
            trace.pieces.append(piece)
    _leave_out_what_never_returns(exact, trace)
    return trace


def _leave_out_what_never_returns(exact: RateField, trace: Trace) -> None:
    ends = np.array([piece.b.q for piece in trace.pieces])
    errors = exact.errors(exact.path.at(np.array([piece.b.s for piece in trace.pieces])), ends)
    good: Flags = np.all(errors.T - np.array(exact.tolerances) <= 0.0, axis=1)
    if good[-1]:
        return
    last = int(np.flatnonzero(good)[-1]) + 1 if good.any() else 0
    piece, trace.pieces = trace.pieces[last], trace.pieces[:last]
    low, high = 0.0, 1.0
    for _ in range(_SEARCH):
        tau = 0.5 * (low + high)
        at = exact.path.at(np.array([piece.a.s + tau * piece.width]))
        error = exact.errors(at, piece.at(np.array([tau])))[:, 0]
        low, high = (tau, high) if (error <= exact.tolerances).all() else (low, tau)
    place = piece.a.s + low * piece.width
    trace.ending, trace.crossing = "lost", Crossing(place, place, "lost")
    cut_short(exact, trace, piece, low)


def cut_short(exact: RateField, trace: Trace, piece: Piece, tau: float) -> None:
    """Append the part of a piece up to place `tau`, from 0 to 1, unless it is empty."""
    s = piece.a.s + tau * piece.width
    if not s > piece.a.s:
        return
    place, width = np.array([tau]), piece.width
    q, dq, ddq = piece.at(place)[0], rates_of(place, 1, piece.data)[0] / width, rates_of(place, 2, piece.data)[0]
    at = exact.path.at(np.array([s]))
    sigma = float(exact.velocities(at, q[None])[1][0])
    b = Knot(s, q, dq, ddq / width**2, sigma, piece.b.span, 0.0)
    trace.pieces.append(_piece(Damped(exact), piece.a, b, (piece.a.s, s))[0])


def _pieces(field: Damped, a: Knot, stretch: tuple[float, float]) -> Iterator[Piece]:
    end, extent = stretch[1], field.exact.path.extent
    h = min(_FIRST_STEP * extent, end - a.s)
    allowed = SHARE * min(field.exact.tolerances)
    while a.s < end:
        s = end if end - a.s <= 1.1 * h else a.s + h
        h = s - a.s
        q, error = _rosenbrock(field, a, h, stretch)
        ratio = error / _TOLERANCE
        factor = 0.8 * max(ratio, 1e-6) ** (-1.0 / 3.0)
        if ratio <= 1.0 or h < _SHORTEST * extent:
            b = field.knot(s, field.exact.samples(np.array([s]), *stretch), q)
            piece, off = _piece(field, a, b, stretch)
            fastest = max(float(np.abs(a.dq).max()), float(np.abs(b.dq).max()), 1e-300)
            ratio = max(off / (RATE_TOLERANCE * fastest), 0.25 * off * h / allowed)
            factor = min(factor, 0.8 * max(ratio, 1e-6) ** -0.2)
            if ratio <= 1.0 or h < _SHORTEST * extent:
                yield piece
                a = b
        h *= min(_GROWTH, max(_SHRINKAGE, factor))


def _piece(field: Damped, a: Knot, b: Knot, stretch: tuple[float, float]) -> tuple[Piece, float]:
    exact, data, h = field.exact, end_conditions(a, b), b.s - a.s
    at, qs = exact.samples(a.s + h * INNER, *stretch), rates_of(INNER, 0, data)
    velocities, sigmas = field.velocities(at, qs)
    off = float(np.abs(rates_of(INNER, 1, data) / h - velocities).max())
    deviations = exact.errors(at, qs).max(axis=1)
    return Piece(a, b, data, np.concatenate(([a.sigma], sigmas, [b.sigma])), deviations, 0.0), off


def _rosenbrock(field: Damped, a: Knot, h: float, stretch: tuple[float, float]) -> tuple[Array, float]:
    """Take one step; return its end, shape (n,), and an estimate of its error."""
    n, at = len(a.q), field.exact.samples(np.array([a.s]), *stretch)
    by_q, by_s = _derivatives(field, at, a.q)
    matrix = np.eye(n) / (h * _GAMMA) - by_q
    steps = np.zeros((4, n))
    rate = a.dq
    for i, (place, weight) in enumerate(_STAGES):
        if i >= 2:
            moved = a.q + np.array(_FROM_STAGES[i]) @ steps[:i]
            later = field.exact.samples(np.array([a.s + place * h]), *stretch)
            rate = field.velocities(later, moved[None])[0][0]
        coupled = np.array(_COUPLED[i]) @ steps[:i] / h if i else 0.0
        steps[i] = np.linalg.solve(matrix, rate + coupled + weight * h * by_s)
    return a.q + _RESULT @ steps, float(np.abs(steps[3]).max())


def _derivatives(field: Damped, at: PathSamples, q: Array) -> tuple[Array, Array]:
    """Return ∂q'/∂q, shape (n, n), and ∂q'/∂s, shape (n,), by central differences."""
    n = len(q)
    step = _NUDGE / max(float(np.abs(at.first).max()), 1e-300)
    places = np.zeros(2 * n + 2)
    places[-2:] = -step, step
    qs = np.repeat(q[None], 2 * n + 2, axis=0)
    qs[:n] -= _NUDGE * np.eye(n)
    qs[n : 2 * n] += _NUDGE * np.eye(n)
    rates = field.velocities(beside(at, places), qs)[0]
    return (rates[n : 2 * n] - rates[:n]).T / (2.0 * _NUDGE), (rates[-1] - rates[-2]) / (2.0 * step)
