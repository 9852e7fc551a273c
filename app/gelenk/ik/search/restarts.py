"""Many solutions of each of many targets: starts in turn from a configuration, around it, and all over the ranges."""

from typing import Any

import numpy as np

from gelenk.ik.search.iteration import Goal, Work, read_lane, set_target, workspace
from gelenk.ik.search.kernels import _has, _iterate, _set_start, _wind, uniform
from gelenk.kinematics.simd.lanes import LANES
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged


def solutions_from(
    flat: FlatChain, goal: Goal, targets: Array, bases: Array, seeds: Array | None = None, first: int = 0, near: int = 0
) -> tuple[Array, Indices]:
    """Return the solutions to which some starts of each target lead, in the order of targets and of starts.

    Args:
        goal: Its `starts` is the number of the last start, and one more.
        targets: Rotation row by row, then position; shape (N, 12).
        bases: Start 0 of each target; shape (N, n), [rad or m].
        seeds: To which freely turning joints are wound back; one for all targets or one each, shape (1 or N, n).
        first: Number of the first start.
        near: How many starts after 0 are around it, the k-th within the share k / (2 near) of each joint's range.

    Returns:
        Solutions, shape (M, n); and the target of each, shape (M,).
    """
    ends, solved = _ends(flat, goal, targets, bases, bases[:0] if seeds is None else seeds, first, near)
    rows = np.flatnonzero(solved)
    return ends[rows], rows // max(goal.starts - first, 1)


def solutions_by_distance(
    flat: FlatChain, goal: Goal, targets: Array, bases: Array, seeds: Array, first: int, near: int
) -> tuple[Array, Indices, Indices]:
    """Return the ends of some starts, followed as by `solutions_from`, and which of them are solutions.

    Returns:
        Ends, shape (M, n), undefined where a start leads to none; the rows of the solutions by target, nearest to the
        seed first, shape (K,); and where each target's begin there, and K at the end, shape (N + 1,).
    """
    ends, solved = _ends(flat, goal, targets, bases, seeds, first, near)
    order, firsts = _by_distance(ends, solved, seeds, goal.starts - first)
    return ends, order, firsts


@compiled
def _by_distance(ends: Array, solved: Flags, seeds: Array, each: int) -> tuple[Indices, Indices]:
    """Sort the solutions of each target, which are few, by insertion; those as far from the seed stay in turn."""
    order, firsts = np.empty(len(ends), np.int64), np.zeros(len(ends) // each + 1, np.int64)
    squares, count = np.empty(len(ends)), 0
    for row in range(len(ends)):
        i = row // each
        if solved[row]:
            square, seed = 0.0, seeds[i if len(seeds) > 1 else 0]
            for j in range(len(seed)):
                square += (ends[row, j] - seed[j]) ** 2
            at = count
            while at > firsts[i] and squares[at - 1] > square:
                order[at], squares[at] = order[at - 1], squares[at - 1]
                at -= 1
            order[at], squares[at] = row, square
            count += 1
        firsts[i + 1] = count
    return order[:count], firsts


def _ends(
    flat: FlatChain, goal: Goal, targets: Array, bases: Array, seeds: Array, first: int, near: int
) -> tuple[Array, Flags]:
    # Passing a tuple to a compiled function costs much more than passing its parts.
    arguments: tuple[Any, ...] = (*flat, *goal, targets, bases, seeds, first, near)
    ends, solved = _follow(*arguments)
    return ends, solved


@compiled
def _follow(
    placements: Array,
    joints: Indices,
    drives: Array,
    bounds: Array,
    weights: Array,
    kind: int,
    axis: int,
    position_tolerance: float,
    chord_tolerance: float,
    slack: float,
    starts: int,
    random_seed: int,
    targets: Array,
    bases: Array,
    seeds: Array,
    first: int,
    near: int,
) -> tuple[Array, Flags]:
    flat = FlatChain(placements, joints, drives)
    goal = Goal(bounds, weights, kind, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    count, n = bases.shape
    ends, solved = np.empty((count * (starts - first), n)), np.zeros(count * (starts - first), np.bool_)
    _follow_all(flat, goal, targets, bases, seeds, first, near, workspace(flat, n), np.empty(n), ends, solved)
    return ends, solved


@unmanaged
def _follow_all(
    flat: FlatChain,
    goal: Goal,
    targets: Array,
    bases: Array,
    seeds: Array,
    first: int,
    near: int,
    work: Work,
    own: Array,
    ends: Array,
    solved: Flags,
) -> None:
    """Keep every lane busy with a start of some target; write solutions to the rows of their starts."""
    each, rows, following, ended = goal.starts - first, work.owners, 0, (1 << LANES) - 1
    rows[:] = -1
    busy = min(LANES, len(ends))
    while busy:
        for lane in range(LANES):
            if not _has(ended, lane):
                continue
            row = rows[lane]
            if row >= 0 and _has(ended, lane + LANES):
                read_lane(work.previous, lane, ends[row])
                if len(seeds):
                    _wind(goal, seeds[row // each if len(seeds) > 1 else 0], ends[row])
                solved[row] = True
            if following < len(ends):
                owner = following // each
                rows[lane] = following
                set_target(work, lane, targets[owner])
                _begin(goal, work, lane, bases[owner], first + following - owner * each, near, own)
                following += 1
            elif row >= 0:
                rows[lane] = -1
                busy -= 1
        ended = _iterate(flat, goal, work)


@inlined
def _begin(goal: Goal, work: Work, lane: int, base: Array, start: int, near: int, own: Array) -> None:
    if start == 0 or start > near:
        _set_start(goal, work, lane, base, start)
        return
    share = 0.5 * start / near
    for j in range(len(base)):
        shift = share * (2.0 * uniform(goal.random_seed, start, j) - 1.0)
        own[j] = base[j] + shift * (goal.bounds[3, j] - goal.bounds[2, j])
    _set_start(goal, work, lane, own, 0)
