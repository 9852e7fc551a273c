"""Many solutions of each of many targets: starts near a configuration first, then all over the joints' ranges."""

from typing import Any

import numpy as np

from gelenk.ik.search.iteration import Goal, Work, read_lane, set_target, workspace
from gelenk.ik.search.kernels import _first, _has, _iterate, _set_start, _wind, uniform
from gelenk.kinematics.simd.lanes import LANES
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged

NEAR = 16
"""Starts around the configuration; the k-th is within the share k / (2 NEAR) of each joint's range."""


def solutions_around(
    flat: FlatChain, goal: Goal, targets: Array, bases: Array, seeds: Array, first: int
) -> tuple[Array, Indices]:
    """Return the solutions that some starts of each target lead to, and the number of each target's.

    Args:
        goal: Its `starts` is the number of the last start, and one more.
        targets: Rotation row by row, then position; shape (N, 12).
        bases: Configurations around which the first starts are; shape (N, n), [rad or m].
        seeds: To which freely turning joints are wound back; one for all targets or one each, shape (1 or N, n).
        first: Number of the first start, from 1.

    Returns:
        Solutions, those of each target together, shape (M, n); and numbers that add up to M, shape (N,).
    """
    # Passing a tuple to a compiled function costs much more than passing its parts.
    arguments: tuple[Any, ...] = (*flat, *goal, targets, bases, seeds, first)
    qs, counts = _solutions_around(*arguments)
    return qs, counts


@compiled
def _solutions_around(
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
) -> tuple[Array, Indices]:
    flat = FlatChain(placements, joints, drives)
    goal = Goal(bounds, weights, kind, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    count, n = bases.shape
    qs, counts = np.empty((count * (starts - first), n)), np.empty(count, np.int64)
    work, own, total = workspace(flat, n), np.empty(n), 0
    for i in range(count):
        seed = seeds[i if len(seeds) > 1 else 0]
        counts[i] = _gather_around(flat, goal, targets[i], bases[i], seed, first, work, own, qs[total:])
        total += counts[i]
    return qs[:total], counts


@unmanaged
def _gather_around(
    flat: FlatChain,
    goal: Goal,
    target: Array,
    base: Array,
    seed: Array,
    first: int,
    work: Work,
    own: Array,
    found: Array,
) -> int:
    count, following, starts = 0, first, work.starts
    for lane in range(LANES):
        set_target(work, lane, target)
        _begin(goal, work, lane, base, following, own)
        following += 1
    while starts[_first(starts)] < goal.starts:
        ended = _iterate(flat, goal, work)
        if ended == 0:
            continue
        for lane in range(LANES):
            if starts[lane] < goal.starts and _has(ended, lane):
                if _has(ended, lane + LANES):
                    read_lane(work.previous, lane, found[count])
                    _wind(goal, seed, found[count])
                    count += 1
                _begin(goal, work, lane, base, following, own)
                following += 1
    return count


@inlined
def _begin(goal: Goal, work: Work, lane: int, base: Array, start: int, own: Array) -> None:
    share = 0.5 * start / NEAR
    for j in range(len(base)):
        random, lower, upper = uniform(goal.random_seed, start, j), goal.bounds[2, j], goal.bounds[3, j]
        own[j] = lower + random * (upper - lower)
        if start <= NEAR:
            own[j] = base[j] + share * (2.0 * random - 1.0) * (upper - lower)
    work.starts[lane] = start
    _set_start(goal, work, lane, own, 0)
