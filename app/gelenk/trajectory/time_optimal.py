"""Along a given path in the shortest time under limits of joint velocity and acceleration, by reachability [Pham2018].

With u = s̈ and x = ṡ², on a path q(s): q̇² = q'² x and q̈ = q' u + q'' x are linear in (u, x). The path is cut into
intervals, and in each u is constant. Limits hold for the polynomials that q̇² and q̈ then are, not of their values
at the nodes: they are kept everywhere. That costs second order in the length of an interval, and it holds where q' of a
joint changes its sign (zero-inertia points), where conditions at the nodes alone let the acceleration chatter: there,
where a path bends much for what a joint can accelerate, intervals have to be short to come near the optimum.

All is done twice: for the second time nodes are put where u switches, and within intervals that take long or bend much.
Along a straight line the result is then the trapezoid to rounding.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gelenk.model.arrays import Array, Flags
from gelenk.model.errors import InvalidField, TooLarge
from gelenk.trajectory.intervals import composed, cut, rows
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.reachability import controllable, fastest, stages

Rows: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""α and β of rows αu + βx ≤ 1 on the intervals between nodes from 0 to 1; shape (N + 1,) → (N, m) each."""

INTERVALS = 200
LARGEST_PATH = 100_000
"""Intervals times joints of a path at first; twice as many in the end."""
SMALLEST, LARGEST = 1e-9, 1e9
"""What a limit can be."""

MARGIN = 1e-9
"""The share of each limit that is left for rounding."""
_LEAST_INTERVALS = 4
"""In each piece of the path, so that there is room from corner to corner."""
_NO_LENGTH = 1e-13
_STILL = 1e-12
_JUMP, _EXACT = 1e-9, 1e-12
"""The jump of q, in fractions of the largest travel, that is no rounding any more; nor is one of less than so many rad
or m, to which joints follow a path at best."""
_CORNER = 1e-7
"""The jump of q', in fractions of the largest, that is no rounding any more."""
_CHANGE = 0.25
"""The change of q', in fractions of its size, above which an interval is cut."""
_MOST_PARTS = 8
_NEAR = 1e-3
"""How near to its stops a path is cut besides, in fractions of an interval: to see what u is there."""
_KEPT = 0.5
"""How much of ṡ², in fractions of what even braking to the next stop leaves, is left at least by an interval."""
_SWITCH = 0.02
"""The change of u, in fractions of the largest, that is a switch."""


@dataclass(frozen=True, slots=True)
class TimeOptimal:
    """The fastest motion along a path.

    Attributes:
        time_law: s(t), a parabola a piece; one coordinate.
        motion: q(s(t)), with the same breaks.
    """

    time_law: PiecewisePolynomial
    motion: PiecewisePolynomial


@dataclass(frozen=True, slots=True)
class _Task:
    """A path over 0 ≤ s ≤ 1 and the limits along it.

    Attributes:
        path: q(s).
        limits: Of velocity and acceleration, less the margin; shape (2, n).
        is_corner: At which breaks it has to stop; shape (M + 1,).
        start: The least and the largest ṡ² at its start.
        end: The same at its end.
        rows: Further limits; None for none.
    """

    path: PiecewisePolynomial
    limits: Array
    is_corner: Flags
    start: tuple[float, float]
    end: tuple[float, float]
    rows: Rows | None


def time_optimal(
    path: PiecewisePolynomial,
    velocity: Array,
    acceleration: Array,
    *,
    start_velocity: float = 0.0,
    end_velocity: float = 0.0,
    intervals: int = INTERVALS,
    further: Rows | None = None,
) -> TimeOptimal:
    """The fastest motion along a path; the limits are kept everywhere.

    At a corner, where q' jumps, the motion stops. Where q'' jumps so may the acceleration.

    Args:
        path: q(s), without jumps.
        velocity: Limit of each joint; shape (n,), [rad/s or m/s].
        acceleration: Limit of each joint; shape (n,), [rad/s² or m/s²].
        start_velocity: ṡ ≥ 0 at the start of the path.
        end_velocity: ṡ ≥ 0 at its end.
        intervals: About how many, four in each piece of the path at least. More come nearer to the optimum: 200 are
            within 1.5 % of it along splines through up to 20 knots.
        further: What else u = s̈ and x = ṡ² at the start of each interval have to keep to, the path taken from 0 to 1;
            u = x = 0 has to.

    Returns:
        The motion, from time 0 on. Along a path of no length (≤ 1e-13) it is one piece whose two breaks are the same.

    Raises:
        InvalidField: A limit is no positive number, the path jumps or stands still, or a velocity at one of its ends
            cannot be had.
        TooLarge: The path has too many pieces.
    """
    _check_limits(velocity, acceleration)
    travels = _travels(path)
    if travels.max(initial=0.0) <= _NO_LENGTH:
        law = PiecewisePolynomial(np.zeros(2), path.breaks[None, -1:, None])
        return TimeOptimal(law, PiecewisePolynomial(np.zeros(2), path.at(path.breaks[-1:])[None]))
    task = _task(path, velocity, acceleration, (start_velocity, end_velocity), further)
    nodes = _nodes(task, travels, intervals // 2)
    x = _squared_speeds(task, nodes, path.duration)
    more = np.sort(np.concatenate((_switches(nodes, x), _between(task, nodes, _time_law(nodes, x), intervals))))
    nodes = np.union1d(nodes, more[np.diff(more, prepend=-1.0) > _STILL])
    law = _time_law(nodes, _squared_speeds(task, nodes, path.duration))
    motion = PiecewisePolynomial(law.breaks, composed(cut(task.path, nodes), law.coefficients[:, 1:]))
    c = law.coefficients * path.duration
    c[:, 0] += path.breaks[0]
    return TimeOptimal(PiecewisePolynomial(law.breaks, c), motion)


def _check_limits(velocity: Array, acceleration: Array) -> None:
    for name, values in (("velocity", velocity), ("acceleration", acceleration)):
        wrong = ~((values >= SMALLEST) & (values <= LARGEST))
        if wrong.any():
            reason = f"must be a number from {SMALLEST:g} to {LARGEST:g}"
            raise InvalidField(f"limits/joint_{name}/{int(np.argmax(wrong))}", reason)


def _travels(path: PiecewisePolynomial) -> Array:
    """About how far each joint goes in each piece, zero where it stands still; shape (M, n)."""
    powers = np.diff(path.breaks)[:, None] ** np.arange(1, path.coefficients.shape[1])
    with np.errstate(over="ignore", invalid="ignore"):
        travels: Array = np.abs(path.coefficients[:, 1:] * powers[:, :, None]).sum(axis=1)
    if not (np.abs(path.coefficients[:, 0]) <= LARGEST).all() or not (travels <= LARGEST).all():
        raise InvalidField("path", f"must be of numbers of magnitude ≤ {LARGEST:g}")
    return travels


def _task(
    path: PiecewisePolynomial, velocity: Array, acceleration: Array, ends: tuple[float, float], further: Rows | None
) -> _Task:
    length = path.duration
    powers = length ** np.arange(path.coefficients.shape[1])[:, None]
    unit = PiecewisePolynomial((path.breaks - path.breaks[0]) / length, path.coefficients * powers)
    travels = _travels(path).max(axis=1)
    if (travels <= _STILL * travels.max()).any():
        i = int(np.argmin(travels))
        raise InvalidField(
            "path", f"does not move from s = {path.breaks[i]:g} to {path.breaks[i + 1]:g}: leave that out"
        )
    jumps = np.abs(_at_ends(unit)[1][:-1] - _at_ends(unit)[0][1:]).max(axis=1, initial=0.0)
    if (jumps > max(_JUMP * travels.max(), _EXACT)).any():
        raise InvalidField("path", f"jumps at s = {path.breaks[1 + int(np.argmax(jumps))]:g}")
    before, after = _at_ends(unit.derivative())
    steepest = np.abs(np.concatenate((before, after))).max()
    is_corner = np.abs(after[:-1] - before[1:]).max(axis=1, initial=0.0) > _CORNER * steepest
    limits = np.stack((velocity, acceleration)) * (1.0 - MARGIN)
    start, end = (
        _speeds(field, speed, length, np.abs(slope), velocity, float(_STILL * steepest))
        for field, speed, slope in zip(("start_velocity", "end_velocity"), ends, (before[0], after[-1]), strict=True)
    )
    return _Task(unit, limits, np.concatenate(([False], is_corner, [False])), start, end, further)


def _at_ends(path: PiecewisePolynomial) -> tuple[Array, Array]:
    """Values at the start and at the end of each piece; both of shape (M, n)."""
    powers = np.diff(path.breaks)[:, None] ** np.arange(path.coefficients.shape[1])
    return path.coefficients[:, 0], np.einsum("mk,mkj->mj", powers, path.coefficients)


def _speeds(
    field: str, speed: float, length: float, slope: Array, velocity: Array, smallest: float
) -> tuple[float, float]:
    """The least and the largest ṡ² of the path of length 1 at an end."""
    with np.errstate(divide="ignore"):
        most = float((velocity / slope).min())
    if not 0.0 <= speed <= most * length * (1.0 + MARGIN):
        raise InvalidField(
            field, f"must be a number from 0 to {most * length:g}, where a joint's velocity is at its limit"
        )
    if speed == 0.0 and slope.max() <= smallest:
        return 0.0, np.inf  # Where the path itself stands still, so do the joints.
    squared = min(speed / length, most * (1.0 - 2.0 * MARGIN)) ** 2
    return squared, squared


def _nodes(task: _Task, travels: Array, intervals: int) -> Array:
    """Where the path is cut: evenly within a piece, more often in pieces that are long or take long, and near stops."""
    breaks = task.path.breaks
    times = (travels / task.limits[0]).max(axis=1)
    shares = 0.5 * (np.diff(breaks) + times / times.sum())
    counts = np.maximum(np.ceil(shares * intervals - _STILL), _LEAST_INTERVALS).astype(int)
    if counts.sum() * travels.shape[1] > LARGEST_PATH:
        raise TooLarge("intervals along a path times joints", int(counts.sum()) * travels.shape[1], LARGEST_PATH)
    spans = zip(breaks[:-1], breaks[1:], counts, strict=True)
    nodes = np.concatenate([*(np.linspace(a, b, count, endpoint=False) for a, b, count in spans), breaks[-1:]])
    steps = _NEAR * np.diff(breaks) / counts
    is_stop = task.is_corner | (np.abs(breaks - 0.5) == 0.5)
    near = np.concatenate(((breaks[:-1] + steps)[is_stop[:-1]], (breaks[1:] - steps)[is_stop[1:]]))
    return np.union1d(nodes, near)


def _squared_speeds(task: _Task, nodes: Array, length: float) -> Array:
    """The x = ṡ² at each node of the fastest motion; shape (N + 1,)."""
    lengths = np.diff(nodes)
    stops = np.append(task.path.breaks[task.is_corner], 1.0)
    next_stops = stops[np.searchsorted(stops, nodes[:-1], side="right")]
    kept = _KEPT * (next_stops - nodes[1:]) / (next_stops - nodes[:-1])
    alpha, beta = rows(cut(task.path, nodes), lengths, task.limits)
    if task.rows is not None:
        more = task.rows(nodes)
        alpha, beta = np.hstack((alpha, more[0])), np.hstack((beta, more[1]))
    course = stages(lengths, alpha, beta, kept)
    caps = np.where(np.isin(nodes, stops[:-1]), 0.0, np.inf)
    least, most = controllable(course, caps, task.end)
    if task.start[0] > most[0] * (1.0 + 4.0 * MARGIN):
        reason = f"must be at most {np.sqrt(most[0]) * length:g} along this path under these limits"
        raise InvalidField("start_velocity", reason)
    if task.start[1] < least[0] * (1.0 - 4.0 * MARGIN):
        raise InvalidField("end_velocity", "cannot be reached from the velocity at the start under these limits")
    return fastest(course, least, most, max(min(task.start[1], most[0]), least[0]))


def _switches(nodes: Array, x: Array) -> Array:
    """The place in an interval where u switches: where the lines of x(s) from both sides meet."""
    lengths = np.diff(nodes)
    u = 0.5 * np.diff(x) / lengths
    before, after, inner = u[:-2], u[2:], lengths[1:-1]
    is_jump = np.abs(before - after) > _SWITCH * np.abs(u).max()
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (0.5 * (x[2:-1] - x[1:-2]) / inner - after) / (before - after)
    is_inside = is_jump & (share > 0.01) & (share < 0.99)
    switches: Array = (nodes[1:-2] + share * inner)[is_inside]
    return switches


def _between(task: _Task, nodes: Array, law: PiecewisePolynomial, intervals: int) -> Array:
    """Where to cut intervals that take longer than others, or in which q' changes much; evenly in time."""
    lasting = np.diff(law.breaks)
    slopes = task.path.derivative().at(nodes) / task.limits[0]
    sizes = np.abs(slopes).max(axis=1)
    changes = np.abs(np.diff(slopes, axis=0)).max(axis=1) / np.maximum(sizes[1:], sizes[:-1])
    parts = np.fmax(lasting / law.duration * intervals - 0.5, changes / _CHANGE)
    most = max(1, min(_MOST_PARTS, 2 * LARGEST_PATH // slopes.size))
    counts = np.ceil(np.minimum(parts, most)).astype(int)
    times = [law.breaks[i] + lasting[i] * np.arange(1, counts[i]) / counts[i] for i in np.flatnonzero(counts > 1)]
    between: Array = law.at(np.concatenate([*times, np.empty(0)]))[:, 0]
    return between


def _time_law(nodes: Array, x: Array) -> PiecewisePolynomial:
    """s(t) with constant s̈ from node to node."""
    speeds, lengths = np.sqrt(x), np.diff(nodes)
    if not ((speeds[:-1] + speeds[1:] > 0.0) & np.isfinite(x[1:])).all():
        raise InvalidField("path", "its slopes are too many powers of ten apart")
    times = np.concatenate(([0.0], np.cumsum(2.0 * lengths / (speeds[:-1] + speeds[1:]))))
    coefficients = np.stack((nodes[:-1], speeds[:-1], 0.25 * np.diff(x) / lengths), axis=1)
    return PiecewisePolynomial(times, coefficients[:, :, None])
