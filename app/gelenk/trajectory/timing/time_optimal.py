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

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gelenk.errors import InvalidField, TooLarge
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import LARGEST, check_limits
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, composed, cut, divided
from gelenk.trajectory.timing.joint_constraints import joint_rows
from gelenk.trajectory.timing.reachability import controllable, fastest, stages

Rows: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""Maps nodes from 0 to 1 to α and β of rows αu + βx ≤ 1 on the intervals between them; (N + 1,) → (N, m) each."""

Slower: TypeAlias = Callable[[Array], Array]
"""Maps nodes from 0 to 1 to factors k ≥ 1 of time on the intervals between them; (N + 1,) → (N,)."""

INTERVALS = 200
LARGEST_PATH = 100_000
"""Largest number of intervals times joints in the first run; the second run may double it."""
MARGIN = 1e-9
"""Fraction of each limit that is reserved for rounding errors."""
_LEAST_INTERVALS = 4
"""Least number of intervals per piece of the path."""
_NO_LENGTH = 1e-13
_STILL = 1e-12
_CHANGE = 0.25
"""Relative change of q' above which an interval is cut."""
_MOST_PARTS = 8
_NEAR = 1e-3
"""Distance of an extra node from each end, as a fraction of an interval, to resolve u there."""
_LEAST_SHARE = 0.5
"""Least ṡ² left after an interval, as a fraction of what uniform braking to the end leaves."""
_SWITCH = 0.02
"""Change of u, as a fraction of the largest |u|, that counts as a switch."""


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
    travels = _travels(path)
    if travels.max(initial=0.0) <= _NO_LENGTH:
        law = PiecewisePolynomial(np.zeros(2), path.breaks[None, -1:, None])
        return TimeOptimal(law, PiecewisePolynomial(np.zeros(2), path.at(path.breaks[-1:])[None]))
    task = _task(path, travels.max(axis=1), np.stack((velocity, acceleration)) * (1.0 - MARGIN), further, slower)
    nodes = _nodes(task, travels, intervals // 2)
    x = _squared_speeds(task, nodes)
    more = np.sort(np.concatenate((_switches(nodes, x), _between(task, nodes, _time_law(nodes, x), intervals))))
    nodes = np.union1d(nodes, more[np.diff(more, prepend=-1.0) > _STILL])
    law = _time_law(nodes, _squared_speeds(task, nodes))
    motion = PiecewisePolynomial(law.breaks, composed(cut(task.path, nodes), law.coefficients[:, 1:]))
    c = law.coefficients * path.duration
    c[:, 0] += path.breaks[0]
    return TimeOptimal(PiecewisePolynomial(law.breaks, c), motion)


def _travels(path: PiecewisePolynomial) -> Array:
    """Estimate how far each joint travels in each piece, zero if it stands still; shape (M, n)."""
    powers = np.diff(path.breaks)[:, None] ** np.arange(1, path.coefficients.shape[1])
    with np.errstate(over="ignore", invalid="ignore"):
        travels: Array = np.abs(path.coefficients[:, 1:] * powers[:, :, None]).sum(axis=1)
    if not (np.abs(path.coefficients[:, 0]) <= LARGEST).all() or not (travels <= LARGEST).all():
        raise InvalidField("path", f"must be of numbers of magnitude ≤ {LARGEST:g}")
    return travels


def _task(
    path: PiecewisePolynomial, travels: Array, limits: Array, further: Rows | None, slower: Slower | None
) -> _Task:
    length = path.duration
    powers = length ** np.arange(path.coefficients.shape[1])[:, None]
    unit = PiecewisePolynomial((path.breaks - path.breaks[0]) / length, path.coefficients * powers)
    if (travels <= _STILL * travels.max()).any():
        i = int(np.argmin(travels))
        raise InvalidField(
            "path", f"does not move from s = {path.breaks[i]:g} to {path.breaks[i + 1]:g}: leave that out"
        )
    slopes = unit.derivative()
    powers = np.diff(slopes.breaks)[:, None] ** np.arange(slopes.coefficients.shape[1])
    before, after = slopes.coefficients[:, 0], np.einsum("mk,mkj->mj", powers, slopes.coefficients)
    still = _STILL * np.abs(np.concatenate((before, after))).max()
    start, end = (np.inf if np.abs(slope).max() <= still else 0.0 for slope in (before[0], after[-1]))
    return _Task(unit, limits, (start, end), further, slower)


def _nodes(task: _Task, travels: Array, intervals: int) -> Array:
    """Choose nodes: evenly spaced within a piece, more in pieces that are long or take long, and one near each end."""
    breaks = task.path.breaks
    times = (travels / task.limits[0]).max(axis=1)
    shares = 0.5 * (np.diff(breaks) + times / times.sum())
    counts = np.maximum(np.ceil(shares * intervals - _STILL), _LEAST_INTERVALS).astype(int)
    if counts.sum() * travels.shape[1] > LARGEST_PATH:
        raise TooLarge("intervals along a path times joints", int(counts.sum()) * travels.shape[1], LARGEST_PATH)
    nodes, steps = divided(breaks, counts), _NEAR * np.diff(breaks) / counts
    return np.concatenate((nodes[:1], nodes[:1] + steps[0], nodes[1:-1], nodes[-1:] - steps[-1], nodes[-1:]))


def _squared_speeds(task: _Task, nodes: Array) -> Array:
    lengths = np.diff(nodes)
    least_shares = _LEAST_SHARE * (1.0 - nodes[1:]) / (1.0 - nodes[:-1])
    alpha, beta = joint_rows(cut(task.path, nodes), lengths, task.limits)
    if task.rows is not None:
        more = task.rows(nodes)
        alpha, beta = np.hstack((alpha, more[0])), np.hstack((beta, more[1]))
    if task.slower is not None:
        squares = task.slower(nodes)[:, None] ** 2
        alpha, beta = squares * alpha, squares * beta
    constraints = stages(lengths, alpha, beta, least_shares)
    start, end = task.most_at_ends
    return fastest(constraints, controllable(constraints, end), start)


def _switches(nodes: Array, x: Array) -> Array:
    """Return the places inside intervals at which u switches, where the lines of x(s) from both sides meet."""
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
    """Return places at which to cut intervals that take long or in which q' changes much, evenly spaced in time."""
    lasting = np.diff(law.breaks)
    slopes = task.path.derivative().at(nodes) / task.limits[0]
    sizes = np.abs(slopes).max(axis=1)
    changes = np.abs(np.diff(slopes, axis=0)).max(axis=1) / np.maximum(sizes[1:], sizes[:-1])
    parts = np.fmax(lasting / law.duration * intervals - 0.5, changes / _CHANGE)
    most = max(1, min(_MOST_PARTS, 2 * LARGEST_PATH // slopes.size))
    counts = np.ceil(np.minimum(parts, most)).astype(int)
    counts = np.maximum(counts, 1)
    times = np.delete(divided(law.breaks, counts), np.append(0, np.cumsum(counts)))
    between: Array = law.at(times)[:, 0]
    return between


def _time_law(nodes: Array, x: Array) -> PiecewisePolynomial:
    speeds, lengths = np.sqrt(x), np.diff(nodes)
    if not ((speeds[:-1] + speeds[1:] > 0.0) & np.isfinite(x[1:])).all():
        raise InvalidField("path", "its slopes are too many powers of ten apart")
    times = np.concatenate(([0.0], np.cumsum(2.0 * lengths / (speeds[:-1] + speeds[1:]))))
    coefficients = np.stack((nodes[:-1], speeds[:-1], 0.25 * np.diff(x) / lengths), axis=1)
    return PiecewisePolynomial(times, coefficients[:, :, None])
