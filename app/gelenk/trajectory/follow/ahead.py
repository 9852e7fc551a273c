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
_SPACING, _MOST = 0.1, 120
"""Distance of configurations on a rung in some joint, [rad or m], and their number."""
_LONGEST = 0.6
"""Longest step of a joint between rungs, [rad or m]."""
_ONTO, _NEAR, _DAMPING = 2, 1e-3, 1e-9
"""Newton's steps onto the path, the largest error that they may leave [m or rad], and what keeps them finite."""
_CARES = ((0.1, 4), (0.03, 2), (0.01, 1), (0.0, 0))
"""Distance from joint limits [rad or m], and rounds of smoothing, of one guide after the other."""
_OPENING = 0.02
"""Growth of that distance from rung to rung, from that of the start, [rad or m]."""


def guides(field: RateField, start: Array) -> Iterator[PiecewisePolynomial]:
    """Yield smooth joint paths near exact ones from a configuration, (n,), to the end; none if no way is found."""
    extent = field.path.extent
    count = int(np.clip(np.ceil(extent / _APART), _LEAST_RUNGS, _MOST_RUNGS))
    # Where steps between rungs are long, the front may shrink to nothing: then once more with twice as many.
    for places in (np.linspace(0.0, extent, count + 1), np.linspace(0.0, extent, 2 * count + 1)):
        rungs = _rungs(field, places, start)
        if len(rungs) == len(places):
            yield from _ways(field, places, rungs)
            return


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
            yield _smooth(places, way, rounds)


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
    qs, directions, rungs = start[None], _directions(field, 0.0, start[None])[1], [start[None]]
    for s, following in pairwise(places):
        moved = _spread(field, qs, (following - s) * directions[:, 0], directions[:, 1:])
        at = field.path.at(np.full(len(moved), following))
        moved, rows = onto(field, at, moved, _ONTO)
        near = (np.abs(rows.errors) <= _NEAR).all(axis=1) & _within(field, moved)
        qs = moved[near]
        if len(qs):
            sigmas, directions = _directions(field, following, qs)
            clear = sigmas >= field.threshold
            qs, directions = qs[clear], directions[clear]
        if len(qs) == 0:
            break
        rungs.append(qs)
    return rungs


def _directions(field: RateField, s: float, qs: Array) -> tuple[Array, Array]:
    """Return σ at configurations on a rung, and the rates along the path with a basis of the self-motion."""
    rows = task_rows(field.chain, field.task, field.path.at(np.full(len(qs), s)), qs)
    m = rows.rates.shape[1]
    left, sigmas, right = np.linalg.svd(rows.jacobians)
    parts = (left.transpose(0, 2, 1) @ rows.rates[:, :, None])[:, :, 0] / np.maximum(sigmas, _DAMPING)
    rates = (parts[:, None] @ right[:, :m])[:, 0]
    return sigmas[:, -1], np.concatenate((rates[:, None], right[:, m:]), axis=1)


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


def _smooth(places: Array, way: Array, rounds: int) -> PiecewisePolynomial:
    """Return the uniform cubic B-spline of a way, smoothed between its ends before; it stays in the hull of the way."""
    for _ in range(rounds):
        way[1:-1] = 0.25 * way[:-2] + 0.5 * way[1:-1] + 0.25 * way[2:]
    h = places[1] - places[0]
    points = np.concatenate((2.0 * way[:1] - way[1:2], way, 2.0 * way[-1:] - way[-2:-1]))
    before, here, after = points[:-2], points[1:-1], points[2:]
    knots = np.array(
        [before + 4.0 * here + after, 3.0 * (after - before) / h, 6.0 * (before - 2.0 * here + after) / h**2]
    )
    knots /= 6.0
    return PiecewisePolynomial(places, hermite_pieces(knots[:, :-1], knots[:, 1:], np.diff(places)))
