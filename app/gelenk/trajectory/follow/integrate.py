"""Trace of the joint path from knot to knot, until its end or until it cannot go on."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.bounds import Crossing, limit_crossing, located, threshold_crossing
from gelenk.trajectory.follow.rate_field import Knot, RateField
from gelenk.trajectory.follow.step import Piece, attempt

Ending: TypeAlias = Literal["complete", "joint_limit", "threshold", "lost", "too_fast"]

MOST_KNOTS = 20_000
_FIRST_STEP = 0.25
"""First step, in fractions of a stretch."""
_FARTHEST = 0.5
"""Largest motion of a joint in one piece, [rad or m]."""
_SHORTEST = 1e-9
"""Piece length below which the path counts as lost, in fractions of the path or of 1 m or rad if that is less."""
_NOTHING = 1e-2
"""Share of that length below which rounding makes the rates meaningless."""
_CLEAR = 1e-2
"""σ above which a lost path is due to rounding."""
_FASTEST = 1e6
"""A joint's rate, in [rad or m] per length of the path, above which the path is given up."""
_CROWD, _CREEP = 200, 1e-5
"""So many pieces within this length (in fractions of the path or of 1 m or rad) make the path given up."""
_KNOTS_OF_END = 6
_NEAR_END = 1e-3
"""σ above which the end of a branch is too far away to be extrapolated."""
_SAME_GROWTH = 0.1
_GROWTH, _SHRINKAGE, _RESERVE = 3.0, 0.25, 0.85


@dataclass(slots=True)
class Trace:
    """The traced path, and how it ended; `best` is the largest σ so far.

    Attributes:
        start: First configuration; shape (n,), [rad or m].
        crossing: Up to where the path is good, and from where it is not; None if complete.
    """

    start: Array
    pieces: list[Piece]
    ending: Ending = "complete"
    crossing: Crossing | None = None
    best: float = 0.0

    @property
    def reached(self) -> float:
        """How far along the path the trace leads, [m or rad]."""
        return self.pieces[-1].b.s if self.pieces else 0.0

    @property
    def last(self) -> Array:
        """The last configuration; shape (n,), [rad or m]."""
        return self.pieces[-1].b.q if self.pieces else self.start


def traced(
    field: RateField, start: Array, since: float = 0.0, until_above: float = np.inf, most: int | None = None
) -> Trace:
    """Trace the path from a configuration at place `since`, [m or rad].

    Tracing stops where σ is above `until_above`. If that is finite, a path about to be lost is also given up once its
    end can be extrapolated (`_end_of_branch`), instead of being traced to the last nanometre. `InvalidField` if there
    are more than `most` pieces, by default `MOST_KNOTS`.
    """
    most = MOST_KNOTS if most is None else most
    trace, creep = Trace(start, []), _CREEP * min(field.path.extent, 1.0)
    for stretch in pairwise((0.0, *field.path.breaks, field.path.extent)):
        if stretch[1] <= since:
            continue
        begin = max(since, stretch[0])
        a = field.first_knot(begin, field.samples(np.array([begin]), *stretch), trace.last)
        if not trace.pieces:
            trace.best = a.sigma
        for piece in _pieces(field, a, stretch, trace):
            trace.pieces.append(piece)
            if len(trace.pieces) > most:
                reason = (
                    f"following the path this closely takes more than {counted(most, 'knot')}: allow a larger tolerance"
                )
                raise InvalidField("path_tolerance", reason)
            if len(trace.pieces) > _CROWD and piece.b.s - trace.pieces[-_CROWD].a.s < creep:
                trace.ending, trace.crossing = "too_fast", Crossing(piece.b.s, piece.b.s, "lost")
                return trace
            if piece.b.sigma >= until_above:
                return trace
            end = _end_of_branch(trace.pieces, field.path.extent) if until_above < np.inf else None
            if end is not None:
                trace.ending, trace.crossing = "lost", Crossing(piece.b.s, end, "lost")
                return trace
        if trace.ending != "complete":
            return trace
    return trace


def _end_of_branch(pieces: list[Piece], extent: float) -> float | None:
    """Extrapolate the end of the branch; None if its last knots do not determine it.

    There σ falls as the square root of the remaining path, and the rates grow as 1/σ. So s is a smooth function of σ²:
    cubics through four knots each must agree on its value at zero within the length below which a path counts as lost.
    """
    if len(pieces) < _KNOTS_OF_END or pieces[-1].b.sigma > _NEAR_END:
        return None
    knots = [piece.b for piece in pieces[-_KNOTS_OF_END:]]
    squares = np.array([knot.sigma for knot in knots]) ** 2
    growths = np.array([float(np.abs(knot.dq).max()) for knot in knots]) * np.sqrt(squares)
    if not (np.diff(squares) < 0.0).all() or np.ptp(growths) > _SAME_GROWTH * growths.max():
        return None
    ends = np.array([knot.s for knot in knots])
    for k in range(1, 4):
        # Neville's scheme at σ² = 0.
        ends = (squares[:-k] * ends[1:] - squares[k:] * ends[:-1]) / (squares[:-k] - squares[k:])
    scale = min(extent, 1.0)
    is_ahead = knots[-1].s < ends[-1] <= extent
    return float(ends[-1]) + _SHORTEST * scale if is_ahead and np.ptp(ends) <= _SHORTEST * scale else None


def _pieces(field: RateField, a: Knot, stretch: tuple[float, float], trace: Trace) -> Iterator[Piece]:
    """Yield the pieces up to the end of a stretch; if it is not reached, set the reason in `trace`."""
    end, extent = stretch[1], field.path.extent
    shortest = _SHORTEST * min(extent, 1.0)
    h = min(_FIRST_STEP * (end - a.s), _farthest(a))
    while a.s < end:
        s = _next_place(a.s, h, end)
        piece = attempt(field, a, s, stretch)
        is_good = piece is not None and (piece.ratio <= 1.0 or end - a.s <= _NOTHING * shortest)
        if piece is None or not is_good:
            h = (s - a.s) * (_SHRINKAGE if piece is None else max(_SHRINKAGE, _factor(piece)))
            if h < shortest:
                if piece is not None and a.sigma > _CLEAR and len(field.chain) >= len(field.task):
                    raise InvalidField("path_tolerance", "is so small that rounding exceeds it: allow a larger one")
                trace.ending, trace.crossing = "lost", Crossing(a.s, s, "lost")
                return
            continue
        crossing = first_crossing(field, piece, stretch, trace)
        if crossing is not None:
            part, trace.crossing = located(field, piece, crossing, stretch)
            trace.ending = trace.crossing.kind
            if part is not None:
                yield part
            return
        yield piece
        a = piece.b
        if float(np.abs(a.dq).max()) * extent > _FASTEST:
            trace.ending, trace.crossing = "too_fast", Crossing(a.s, a.s, "lost")
            return
        h = min((s - piece.a.s) * min(_GROWTH, _factor(piece)), _farthest(a))


def _factor(piece: Piece) -> float:
    """Return the factor for the next step; the error of the rates is of fifth order."""
    return float(_RESERVE * max(piece.ratio, 1e-6) ** -0.2)


def _farthest(a: Knot) -> float:
    return _FARTHEST / max(float(np.abs(a.dq).max()), 1e-300)


def _next_place(s: float, h: float, end: float) -> float:
    """Return where the next piece ends, leaving no much shorter rest; a smaller h never gives a farther place."""
    left = end - s
    if left <= 1.1 * h:
        return end
    return s + (0.5 * left if left < 2.0 * h else h)


def first_crossing(field: RateField, piece: Piece, stretch: tuple[float, float], trace: Trace) -> Crossing | None:
    """Find the first violation in a piece, and update the trace's largest σ."""
    near, best = None, max(trace.best, float(piece.sigmas.max()))
    if field.threshold > 0.0:
        near, best = threshold_crossing(field, piece, trace.best, stretch)
    trace.best = best
    beyond = limit_crossing(field, piece) if field.limited else None
    if near is None or beyond is None:
        return near or beyond
    return near if near.good <= beyond.good else beyond
