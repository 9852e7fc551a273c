"""The fastest motion along a path under limits of joint velocity and acceleration, by reachability [Pham2018].

With u = s̈ and x = ṡ², on a path q(s): q̇² = q'² x and q̈ = q' u + q'' x are linear in (u, x). The path is cut into
intervals with constant u, on which q̇² and q̈ are polynomials. The limits are imposed on these polynomials, not only on
their values at the nodes, so they are kept everywhere. The loss is of second order in the interval length. This also
works where q' of a joint changes sign (zero-inertia points) and conditions at the nodes alone would let the
acceleration chatter; if the path bends strongly there for a joint's acceleration limit, only short intervals come near
the optimum.

A second run adds nodes where u switches, and in intervals that take long or bend strongly. Along a straight line the
result is then the trapezoidal profile up to rounding.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gelenk.errors import InvalidField, TooLarge
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled
from gelenk.trajectory.laws.time_scaling import LARGEST, check_limits
from gelenk.trajectory.motion.evaluation import composed, evaluated, expanded
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.timing.nodes import (
    LARGEST_PATH,
    UnitPath,
    even_counts,
    even_nodes,
    finer_nodes,
    measures,
    time_law,
)
from gelenk.trajectory.timing.reachability import Further, controllable, fastest, stages

Rows: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Maps nodes from 0 to 1 to α and β of rows αu + βx ≤ 1 on the intervals between them; (N + 1,) → (N, m) each."""

Slower: TypeAlias = Callable[[Array], Array]
"""Maps nodes from 0 to 1 to factors k ≥ 1 of time on the intervals between them; (N + 1,) → (N,)."""

INTERVALS = 200
MARGIN = 1e-9
"""Fraction of each limit that is reserved for rounding errors."""
_NO_LENGTH = 1e-13
_STILL = 1e-12
_LEAST_SHARE = 0.5
"""Least ṡ² left after an interval, as a fraction of what uniform braking to the end leaves."""


@dataclass(frozen=True, slots=True)
class TimeOptimal:
    """The fastest motion along a path, q(s(t)), and s(t), one parabola per piece; both have the same breaks."""

    time_law: PiecewisePolynomial
    motion: PiecewisePolynomial


@dataclass(frozen=True, slots=True)
class _Task:
    """A path over 0 ≤ s ≤ 1 and the limits along it.

    Attributes:
        limits: Limits of velocity and acceleration, less the margin; shape (2, n).
        most_at_ends: Largest ṡ² at the start and the end: 0, or ∞ where q' = 0, so that the joints rest at any ṡ.
    """

    path: PiecewisePolynomial
    limits: Array
    most_at_ends: tuple[float, float]
    rows: Rows | None
    slower: Slower | None


def time_optimal(
    path: PiecewisePolynomial,
    velocity: Array,
    acceleration: Array,
    *,
    intervals: int = INTERVALS,
    further: Rows | None = None,
    slower: Slower | None = None,
) -> TimeOptimal:
    """Plan the fastest motion along a path from rest to rest; the limits are kept everywhere.

    Where q'' jumps, the acceleration may jump too.

    Args:
        path: q(s), with continuous q'.
        velocity, acceleration: Limits of each joint; shape (n,), [rad/s or m/s], [rad/s² or m/s²].
        intervals: Approximate number of intervals, at least four per piece of the path. More come nearer to the
            optimum: 200 are within 1.5 % of it along splines through up to 20 knots.
        further: Further constraints on u = s̈ and x = ṡ² at the start of each interval, for the path scaled to
            0 ≤ s ≤ 1; u = x = 0 has to satisfy them.
        slower: Where to keep further below the limits, as if time ran faster there.

    Returns:
        The motion, starting at time 0; along a path of zero length (≤ 1e-13), one piece whose two breaks coincide.

    Raises:
        InvalidField: A limit is out of range, or the path stands still.
        TooLarge: The path has too many pieces.
    """
    check_limits((velocity, acceleration))
    size = measures(np.ascontiguousarray(path.breaks), np.ascontiguousarray(path.coefficients))
    if not size.largest <= LARGEST:
        raise InvalidField("path", f"must be of numbers of magnitude ≤ {LARGEST:g}")
    if size.travels.max(initial=0.0) <= _NO_LENGTH:
        ends = path.breaks[None, -1:, None], path.at(path.breaks[-1:])[None]
        return TimeOptimal(*(PiecewisePolynomial(np.zeros(2), end) for end in ends))
    task = _task(path, size, np.stack((velocity, acceleration)) * (1.0 - MARGIN), further, slower)
    counts = _counts(task, size.travels, intervals // 2)
    if further is None and slower is None:
        times, law, motion = _checked(*unlimited(size, counts, task.limits, intervals))
    else:
        nodes = even_nodes(task.path.breaks, counts)
        times, law, _ = _time_law(task, nodes)
        nodes = _finer(task.path.breaks, task.path.coefficients, nodes, times, law, task.limits[0], intervals)
        times, law, pieces = _time_law(task, nodes)
        motion = composed(pieces, law)
    law *= path.duration
    law[:, 0] += path.breaks[0]
    return TimeOptimal(PiecewisePolynomial(times, law[:, :, None]), PiecewisePolynomial(times, motion))


def _task(
    path: PiecewisePolynomial, size: UnitPath, limits: Array, further: Rows | None, slower: Slower | None
) -> _Task:
    if not moves_on(size):
        i = int(np.argmin(size.travels.max(axis=1)))
        raise InvalidField(
            "path", f"does not move from s = {path.breaks[i]:g} to {path.breaks[i + 1]:g}: leave that out"
        )
    return _Task(PiecewisePolynomial(size.breaks, size.coefficients), limits, _most_at_ends(size), further, slower)


@compiled
def is_usual(path: UnitPath) -> bool:
    """Check whether a path is of sensible size, and leads somewhere everywhere."""
    return path.largest <= LARGEST and path.travels.max() > _NO_LENGTH and moves_on(path)


@compiled
def moves_on(path: UnitPath) -> bool:
    """Check whether a path, of some length, stands still nowhere."""
    least, most = np.inf, 0.0
    for travels in path.travels:
        least, most = min(least, travels.max()), max(most, travels.max())
    return least > _STILL * most


@compiled
def _most_at_ends(path: UnitPath) -> tuple[float, float]:
    return np.inf if path.rests[0] else 0.0, np.inf if path.rests[1] else 0.0


def _counts(task: _Task, travels: Array, intervals: int) -> Indices:
    counts = even_counts(task.path.breaks, travels, task.limits[0], intervals)
    number = int(counts.sum()) * travels.shape[1]
    if number > LARGEST_PATH:
        raise TooLarge("intervals along a path times joints", number, LARGEST_PATH)
    return counts


def _time_law(task: _Task, nodes: Array) -> tuple[Array, Array, Array]:
    """Return what `time_law` does for the fastest motion between nodes, and the pieces of the path between them."""
    count = len(nodes) - 1
    alpha, beta = np.empty((2, count, 0)) if task.rows is None else task.rows(nodes)
    squares = np.ones(count) if task.slower is None else task.slower(nodes) ** 2
    path = task.path.breaks, task.path.coefficients
    return _checked(*_fastest(*path, nodes, task.limits, alpha, beta, squares, task.most_at_ends))


def _checked(times: Array, law: Array, pieces: Array) -> tuple[Array, Array, Array]:
    if not math.isfinite(times[-1]):
        raise InvalidField("path", "its slopes are too many powers of ten apart")
    return times, law, pieces


@compiled
def unlimited(path: UnitPath, counts: Indices, limits: Array, intervals: int) -> tuple[Array, Array, Array]:
    """Plan the fastest motion along a path without further constraints, under limits (2, n) less their margin.

    The first run divides each piece into `counts`. Returns the motion's breaks, the last of which is NaN if there is
    none, s(t) as `time_law` does, and its coefficients.
    """
    nodes = even_nodes(path.breaks, counts)
    for run in range(2):
        none, squares = np.empty((len(nodes) - 1, 0)), np.ones(len(nodes) - 1)
        ends = _most_at_ends(path)
        times, law, pieces = _fastest(path.breaks, path.coefficients, nodes, limits, none, none, squares, ends)
        if run or not math.isfinite(times[-1]):
            break
        nodes = _finer(path.breaks, path.coefficients, nodes, times, law, limits[0], intervals)
    return times, law, composed(pieces, law)


@compiled
def _fastest(
    breaks: Array,
    coefficients: Array,
    nodes: Array,
    limits: Array,
    alpha: Array,
    beta: Array,
    squares: Array,
    most_at_ends: tuple[float, float],
) -> tuple[Array, Array, Array]:
    pieces = expanded(breaks, coefficients, nodes)
    further = Further(alpha, beta, squares, _LEAST_SHARE * (1.0 - nodes[1:]) / (1.0 - nodes[:-1]))
    constraints = stages(pieces, np.diff(nodes), limits, further)
    start, end = most_at_ends
    times, law = time_law(nodes, fastest(constraints, controllable(constraints, end), start))
    return times, law, pieces


@compiled
def _finer(
    breaks: Array, coefficients: Array, nodes: Array, times: Array, law: Array, velocity: Array, intervals: int
) -> Array:
    slopes = evaluated(breaks, coefficients, nodes, 1)[1]
    found: Array = finer_nodes(nodes, times, law, slopes, velocity, intervals)
    return found
