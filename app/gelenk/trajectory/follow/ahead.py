"""Guides for arms with spare joints: look ahead over the self-motion, from the start to the end of the path.

A front of configurations moves from rung to rung along the path. Each goes on by the shortest step, and sideways along
the self-motion, so that the front spreads over all that the start can reach. The cheapest way up this ladder, made
smooth, is a guide: joint limits and singularities far ahead decide how the spare joints move from the beginning.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from gelenk.ik.search.bounds import free_variables
from gelenk.ik.verdict.branches import thin_out
from gelenk.robot.arrays import Array, Flags
from gelenk.trajectory.follow.ladder import Metric, Rungs, way_up
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.follow.rows import CountedRows, task_rows
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.paths import PathSamples

_LEAST_RUNGS, _MOST_RUNGS, _APART = 48, 200, 0.03
"""Number of rungs, and their distance on a long path, [m or rad]."""
_SIDEWAYS = (0.01, 0.04, 0.1, 0.2, 0.4)
"""Steps along the self-motion from one rung to the next, [rad or m]."""
_DOUBLINGS = 4
"""So often steps between rungs double at first: the front is to spread over the self-motion of the start."""
_SPACING, _MOST = 0.1, 120
"""Distance of configurations on a rung in some joint, [rad or m], and their number."""
_FILLINGS, _CLOSELY = 4, 5
"""How often long steps of a way are halved, and Newton's steps onto the path then."""
_LONGEST = 0.6
"""Longest step of a joint between rungs, [rad or m]."""
_ONTO, _NEAR, _DAMPING = 2, 1e-3, 1e-9
"""Newton's steps onto the path, the largest error that they may leave [m or rad], and what keeps them finite."""
_CARES = ((0.1, 64), (0.1, 16), (0.03, 4), (0.0, 0))
"""Distance from joint limits [rad or m], and rounds of smoothing, of one guide after the other."""
_OPENING = 0.02
"""Growth of that distance from rung to rung, from that of the start, [rad or m]."""


def guides(field: RateField, start: Array) -> Iterator[PiecewisePolynomial]:
    """Yield smooth joint paths near exact ones from a configuration, (n,), to the end; none if no way is found."""
    extent = field.path.extent
    count = int(np.clip(np.ceil(extent / _APART), _LEAST_RUNGS, _MOST_RUNGS))
    steps = np.minimum(2.0 ** np.arange(-_DOUBLINGS, count), 1.0)
    places = extent * np.concatenate(([0.0], np.cumsum(steps) / steps.sum()))
    rungs = _rungs(field, places, start)
    if len(rungs) == len(places):
        yield from _ways(field, places, rungs)


def _ways(field: RateField, places: Array, rungs: list[Array]) -> Iterator[PiecewisePolynomial]:
    """Yield smooth ways up the ladder, those far from joint limits first."""
    qs, owners = np.concatenate(rungs), np.repeat(np.arange(len(rungs)), [len(rung) for rung in rungs])
    rooms = np.minimum(qs - field.chain.lower, field.chain.upper - qs)
    turning = _turning(field)
    metric = Metric(np.ones(len(turning)), np.full(len(turning), _LONGEST), turning)
    for care, rounds in _CARES:
        kept = (rooms >= np.minimum(care, rooms[0] + _OPENING * owners[:, None])).all(axis=1)
        firsts = np.searchsorted(owners[kept], np.arange(len(places) + 1))
        rows = way_up(Rungs(qs[kept], firsts), metric, np.zeros(firsts[1]))[0]
        if len(rows) == len(places):
            way = qs[kept][rows]
            way[:, turning] = np.unwrap(way[:, turning], axis=0)
            yield _smooth(_filled(field, np.column_stack((places, way))), rounds)


def onto(field: RateField, at: PathSamples, qs: Array, steps: int) -> tuple[Array, CountedRows]:
    """Take Newton's steps from configurations (N, n) onto poses of the path; also return the rows that count there."""
    rows = task_rows(field.chain, field.task, at, qs)
    for _ in range(steps):
        transposed = rows.jacobians.transpose(0, 2, 1)
        squares = rows.jacobians @ transposed + _DAMPING * np.eye(rows.errors.shape[1])
        qs = qs + (transposed @ np.linalg.solve(squares, rows.errors[:, :, None]))[:, :, 0]
        rows = task_rows(field.chain, field.task, at, qs)
    return qs, rows


def _rungs(field: RateField, places: Array, start: Array) -> list[Array]:
    """Return what can be reached at each place, shape (N, n) each, as far as anything can."""
    ways = ways_on(task_rows(field.chain, field.task, field.path.at(places[:1]), start[None]))[0]
    rungs = [start[None]]
    for s, following in pairwise(places):
        moved = _spread(field, rungs[-1], (following - s) * ways[:, 0], ways[:, 1:])
        moved, rows = onto(field, field.path.at(np.full(len(moved), following)), moved, _ONTO)
        ways, sigmas = ways_on(rows)
        good = (np.abs(rows.errors) <= _NEAR).all(axis=1) & _within(field, moved) & (sigmas >= field.threshold)
        if not good.any():
            break
        ways = ways[good]
        rungs.append(moved[good])
    return rungs


def ways_on(rows: CountedRows) -> tuple[Array, Array]:
    """Return the ways on from configurations, (N, 1 + k, n), and their σ, at most a tenth too small.

    Powers of (JJᵀ)⁻¹ make 1/σ² stand out in their trace; I - Jᵀ(JJᵀ)⁻¹J projects onto the self-motion.
    """
    J, transposed = rows.jacobians, rows.jacobians.transpose(0, 2, 1)
    m, n = J.shape[1:]
    inverses = np.linalg.inv(J @ transposed + _DAMPING * np.eye(m))
    ways = [(transposed @ (inverses @ rows.rates[:, :, None]))[:, :, 0]]
    spare = np.eye(n) - transposed @ (inverses @ J)
    for _ in range(n - m):
        pivots, every = np.diagonal(spare, axis1=1, axis2=2).argmax(axis=1), np.arange(len(J))
        ways.append(spare[every, pivots] / np.sqrt(spare[every, pivots, pivots])[:, None])
        spare = spare - ways[-1][:, :, None] * ways[-1][:, None]
    for _ in range(3):
        inverses = inverses @ inverses
    return np.stack(ways, axis=1), np.trace(inverses, axis1=1, axis2=2) ** (-1.0 / 16.0)


def _spread(field: RateField, qs: Array, steps: Array, spare: Array) -> Array:
    """Return next configurations, straight on before sideways, thinned out."""
    ahead, sideways = qs + steps, np.concatenate([sign * spare for sign in (1.0, -1.0)], axis=1)
    moved = [ahead, *((ahead[:, None] + size * sideways).reshape(-1, qs.shape[1]) for size in _SIDEWAYS)]
    together = np.concatenate(moved)
    together = np.ascontiguousarray(together[_within(field, together)])
    return together[thin_out(together, _turning(field), _SPACING, _MOST)]


def _turning(field: RateField) -> Flags:
    """Flag the joints that turn without end; shape (n,)."""
    endless: Flags = free_variables(field.chain) & ~np.isfinite(field.chain.upper - field.chain.lower)
    return endless


def _within(field: RateField, qs: Array) -> Flags:
    inside: Flags = np.all((qs >= field.chain.lower) & (qs <= field.chain.upper), axis=1)
    return inside


def _filled(field: RateField, way: Array) -> Array:
    """Put exact configurations in the middle of long steps of a way, its places first; shape (N, 1 + n)."""
    for _ in range(_FILLINGS):
        long = np.flatnonzero((np.abs(np.diff(way[:, 1:], axis=0)) > _SPACING).any(axis=1))
        middles = 0.5 * (way[long] + way[long + 1])
        middles[:, 1:] = onto(field, field.path.at(middles[:, 0]), middles[:, 1:], _CLOSELY)[0]
        way = np.insert(way, long + 1, middles, axis=0)
    return way


def _smooth(way: Array, rounds: int) -> PiecewisePolynomial:
    """Return the uniform cubic B-spline of a way, smoothed between its ends before; it stays in the hull of the way."""
    share = ((way[1:-1, 0] - way[:-2, 0]) / (way[2:, 0] - way[:-2, 0]))[:, None]
    for _ in range(rounds):
        way[1:-1, 1:] = 0.5 * (way[1:-1, 1:] + (1.0 - share) * way[:-2, 1:] + share * way[2:, 1:])
    points = np.concatenate((2.0 * way[:1] - way[1:2], way, 2.0 * way[-1:] - way[-2:-1]))
    before, here, after = points[:-2], points[1:-1], points[2:]
    values, rates, bends = (before + 4.0 * here + after) / 6.0, 0.5 * (after - before), before - 2.0 * here + after
    values[[0, -1]] = way[[0, -1]]  # equal but for rounding, which would leave a piece of no length
    # Places too are a spline of the index: derivatives by the index become those by the place.
    first = rates[:, 1:] / rates[:, :1]
    second = (bends[:, 1:] - bends[:, :1] * first) / rates[:, :1] ** 2
    knots = np.array([values[:, 1:], first, second])
    return PiecewisePolynomial(values[:, 0], hermite_pieces(knots[:, :-1], knots[:, 1:], np.diff(values[:, 0])))
