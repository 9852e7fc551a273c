"""Compiled samples of curves by arc length, and of lines and curves in sequence: one call for many places."""

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled
from gelenk.trajectory.motion.evaluation import evaluated
from gelenk.trajectory.paths.arc_length import parameters
from gelenk.trajectory.paths.sampling import by_arc_length, by_vectors, turning_line

Samples: TypeAlias = tuple[Array, Array, Array, Array]
"""Positions, (N, 3), rotations, (N, 3, 3), ξ_s and dξ_s/ds, (N, 6) each."""

_UNIT = np.array([0.0, 1.0])


class Straight(NamedTuple):
    """A line on which the tip turns about one axis, of a length > 0, [m], from a place `begin` on.

    The rotation vector of the whole turn is in the frame `rotation`, that of the start.
    """

    start: Array
    end: Array
    rotation: Array
    vector: Array
    length: float
    begin: float


class Curve(NamedTuple):
    """A polynomial curve p(u) with a table of its arc length, and R_k Exp(θ(x)) along it, x from 0 to 1 over all of u.

    Attributes:
        breaks, position: Of p, [m]; shape (M + 1,), (M, d + 1, 3).
        edges, lengths, inverse: u and the arc length at the edges of panels, and polynomials close to u(s) between
            them; shape (P + 1,) twice, (P, 6, 1).
        starts, knots, vectors: R_k, and θ by x, [rad]; shape (K, 3, 3), (K + 1,), (K, e + 1, 3).
    """

    breaks: Array
    position: Array
    edges: Array
    lengths: Array
    inverse: Array
    starts: Array
    knots: Array
    vectors: Array


class Track(NamedTuple):
    """P lines and curves of one piece in sequence, padded to one shape.

    Attributes:
        ends: s at their ends; shape (P + 1,), [m].
        lengths, begins: Of a line, likewise of the whole one; 0 for a curve; shape (P,).
        positions: Start and end of a line, or the coefficients of p; shape (P, 6, 3).
        rotations, vectors: R_0, and the coefficients of θ; shape (P, 3, 3), (P, 6, 3).
        firsts: First edge of each one's table, and the end of the last; shape (P + 1,).
        edges, arcs, inverse: The tables one after the other; of the last, a table has one row less, and a row unused.
    """

    ends: Array
    lengths: Array
    begins: Array
    positions: Array
    rotations: Array
    vectors: Array
    firsts: Indices
    edges: Array
    arcs: Array
    inverse: Array


@compiled
def on_curve(curve: Curve, s: Array) -> Samples:
    """Sample a curve at arc lengths of shape (N,), [m]."""
    breaks, velocity = curve.breaks, np.empty((len(curve.position), curve.position.shape[1] - 1, 3))
    for k in range(velocity.shape[1]):
        velocity[:, k] = (k + 1.0) * curve.position[:, k + 1]
    guesses = evaluated(curve.lengths, curve.inverse, s, 0)[0, :, 0].copy()
    u = parameters(breaks, velocity, curve.edges, curve.lengths, s, guesses)
    rates, width = evaluated(breaks, curve.position, u, 2), breaks[-1] - breaks[0]
    x = np.minimum(np.maximum((u - breaks[0]) / width, 0.0), 1.0)
    rotations, turns, changes = by_vectors(curve.starts, curve.knots, curve.vectors, x)
    first, second = by_arc_length(rates[1], rates[2], turns, changes, width)
    return rates[0].copy(), rotations, first, second


@compiled
def along(track: Track, s: Array) -> Samples:
    """Sample a sequence at places of shape (N,), [m]; at a junction, the later part counts."""
    count, inner = len(s), track.ends[1:-1]
    positions, rotations, first, second = (
        np.empty((count, 3)), np.empty((count, 3, 3)), np.empty((count, 6)), np.empty((count, 6))
    )  # fmt: skip
    begin = 0
    while begin < count:
        part = np.searchsorted(inner, s[begin], side="right")
        end = begin + 1
        while end < count and np.searchsorted(inner, s[end], side="right") == part:
            end += 1
        at = _of_part(track, part, s[begin:end] - track.ends[part])
        positions[begin:end], rotations[begin:end], first[begin:end], second[begin:end] = at
        begin = end
    return positions, rotations, first, second


@compiled
def _of_part(track: Track, part: int, s: Array) -> Samples:
    if track.lengths[part] > 0.0:
        ends, turn, place = track.positions[part], track.vectors[part, 1], s + track.begins[part]
        return turning_line(ends[0], ends[1], track.rotations[part], turn, track.lengths[part], place)
    some, table = slice(part, part + 1), slice(track.firsts[part], track.firsts[part + 1])
    inverse = track.inverse[track.firsts[part] : track.firsts[part + 1] - 1]
    curve = Curve(
        _UNIT,
        track.positions[some],
        track.edges[table],
        track.arcs[table],
        inverse,
        track.rotations[some],
        _UNIT,
        track.vectors[some],
    )
    return on_curve(curve, s)


def track_of(parts: Sequence[Straight | Curve | None], ends: Array) -> Track | None:
    """Return lines and curves as one track; None if there are others, or curves of several pieces."""
    lengths, begins, firsts = np.zeros(len(parts)), np.zeros(len(parts)), [0]
    (positions, vectors), rotations = np.zeros((2, len(parts), 6, 3)), np.empty((len(parts), 3, 3))
    tables: list[Array] = []
    for k, part in enumerate(parts):
        if isinstance(part, Straight):
            lengths[k], begins[k], rotations[k] = part.length, part.begin, part.rotation
            positions[k, :2], vectors[k, 1] = (part.start, part.end), part.vector
        elif part is not None and _is_simple(part):
            positions[k, : part.position.shape[1]] = part.position[0]
            vectors[k, : part.vectors.shape[1]], rotations[k] = part.vectors[0], part.starts[0]
            inverse = np.concatenate((part.inverse[:, :, 0], np.zeros((1, 6))))
            tables.append(np.column_stack((part.edges, part.lengths, inverse)))
        else:
            return None
        firsts.append(sum(map(len, tables)))
    rows = np.concatenate((np.empty((0, 8)), *tables))
    edges, arcs = np.ascontiguousarray(rows[:, :2].T)
    inverse = np.ascontiguousarray(rows[:, 2:, None])
    return Track(ends, lengths, begins, positions, rotations, vectors, np.array(firsts), edges, arcs, inverse)


def _is_simple(curve: Curve) -> bool:
    """Return whether a curve has one piece over [0, 1] that a track has room for."""
    sizes = curve.position.shape[1], curve.vectors.shape[1]
    return np.array_equal(curve.breaks, _UNIT) and np.array_equal(curve.knots, _UNIT) and max(sizes) <= 6
