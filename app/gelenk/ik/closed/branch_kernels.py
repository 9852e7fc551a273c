"""All branches of a closed form, polished and checked, in batches.

A closed form is only as exact as the geometry it assumes, and loses digits where two branches meet. Damped least
squares on the actual chain therefore drives its candidates to rounding, eight at a time in vector registers. A
candidate that does not come within the tolerances is no solution.
"""

from typing import Any, NamedTuple

import numpy as np

from gelenk.ik.closed.elimination import Scratch, make_space, pivoted
from gelenk.ik.closed.subproblem_chains import GENERAL, MOST, Candidates, SubproblemPlan, compose, elbow_angle
from gelenk.ik.search.iteration import (
    COUNT,
    FULL,
    ROUNDING,
    SINCE,
    Goal,
    Work,
    descend,
    linearise,
    read_lane,
    squares,
    within,
    workspace,
)
from gelenk.kinematics.simd.lanes import (
    LANES,
    Lanes,
    bits,
    floor_lanes,
    lanes,
    load,
    max_lanes,
    min_lanes,
    rint_lanes,
    store,
    where,
)
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged

_TURN = 2.0 * np.pi
_ROUNDS = 40
"""Most iterations of polishing: one or two mostly suffice, but where two branches meet each only halves the error."""
_PERFECT = 1e-28
"""Squared error that needs no refinement, [m² + rad²]."""
_REFINEMENTS, _SHORTEST_SHARE = 40, 1e-4
"""Most steps of Newton's method, and the share of a step at which a lane is given up."""
_CORRECTIONS = 2
"""Correction steps back into the valley after each step along it."""
_SINGULAR, _WEAK = 1e-15, 1e-3
"""Shares of the largest pivot below which one is rounding, and below which it belongs to a valley."""
DIRECTIONS = 6
"""Directions of a full pose."""
_EXACT = 1e-20
"""Squared error up to which a solution meets its target exactly, [m² + rad²]."""
_DAMPING, _LEAST_DAMPING = 1e-12, 1e-22
"""λ of the first step, and its lower bound after successful steps, so small that it works next to singularities."""
_SAME = 1e-7
"""Distance in every joint up to which two candidates are the same, [rad or m]."""
_MOVED = 1e-4
"""Motion by polishing beyond which a joint is not free, [rad or m]."""
_POSITION, _ORIENTATION = SINCE, COUNT
"""State rows that hold the squared errors."""


class BranchTable(NamedTuple):
    """Solutions of N targets in one table: rows firsts[i] up to, but not including, firsts[i + 1] belong to target i.

    Attributes:
        qs: Solutions, nearest to the seed first; shape (M, n), [rad or m].
        codes, free: Bits of the roots chosen, and of the free variables, which kept the seed's value; shape (M,) each.
        firsts: First row of each target's solutions, and M at the end; shape (N + 1,).
        doubtful: 1 if rounding may have cost solutions of a target; shape (N,), or empty if not needed.
    """

    qs: Array
    codes: Indices
    free: Indices
    firsts: Indices
    doubtful: Indices = np.zeros(0, dtype=np.int64)


class _Kept(NamedTuple):
    """Sorted solutions of one target, in MOST rows and a spare one behind them, and space for their refinement."""

    qs: Array
    distances: Array
    errors: Array
    labels: Indices
    system: Array
    residuals: Array
    order: Indices


def branches(
    flat: FlatChain,
    plan: SubproblemPlan,
    goal: Goal,
    limits: Array,
    targets: Array,
    seeds: Array,
    elbow_angles: Array,
    most: int,
) -> BranchTable:
    """Find the solutions of each target within the limits.

    Args:
        limits: Lower and upper limits of the variables, infinite if they do not count; shape (2, n), [rad or m].
        targets: Rotation row by row, then position; shape (N, 12).
        seeds: One configuration for all targets or one each; shape (1 or N, n), [rad or m].
        elbow_angles: Angles of a free elbow, one for all targets or one each, [rad]; shape (1 or N,).
        most: Largest number of solutions of one target: 1 for the nearest to the seed.
    """
    # Passing a tuple to a compiled function costs much more than passing its parts.
    arguments: tuple[Any, ...] = (*flat, *plan, *goal, limits, targets, seeds, elbow_angles, min(most, MOST))
    qs, labels, firsts, doubtful = _branches(*arguments)
    return BranchTable(qs, labels[0], labels[1], firsts, doubtful)


@compiled
def _branches(
    placements: Array,
    joints: Indices,
    drives: Array,
    kind: int,
    backwards: int,
    form: int,
    placed: int,
    axes: Array,
    points: Array,
    slides: Indices,
    order: Indices,
    lines: Array,
    zero: Array,
    reach: float,
    terms: Array,
    bounds: Array,
    weights: Array,
    what: int,
    axis: int,
    position_tolerance: float,
    chord_tolerance: float,
    slack: float,
    starts: int,
    random_seed: int,
    limits: Array,
    targets: Array,
    seeds: Array,
    elbow_angles: Array,
    most: int,
) -> tuple[Array, Indices, Indices, Indices]:
    flat = FlatChain(placements, joints, drives)
    plan = SubproblemPlan(kind, backwards, form, placed, axes, points, slides, order, lines, zero, reach, terms)
    goal = Goal(bounds, weights, what, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    count, n = len(targets), seeds.shape[1]
    found = Candidates(
        np.empty((MOST, n)),
        np.empty(MOST, np.int64),
        np.empty(MOST, np.int64),
        np.empty(8),
        np.empty((8, 3)),
        np.empty((8, 3, 2)),
        np.empty((2, 8), np.int64),
        np.zeros(1, np.int64),
    )
    kept = _Kept(
        np.empty((MOST + 1, n)),
        np.empty(MOST + 1),
        np.empty(MOST + 1),
        np.empty((2, MOST + 1), np.int64),
        np.empty((DIRECTIONS, DIRECTIONS + 1)),
        np.empty((DIRECTIONS + 1) * LANES),
        np.empty(DIRECTIONS, np.int64),
    )
    work, space = workspace(flat, n), make_space(kind == GENERAL)
    qs, labels = np.empty((count * most, n)), np.empty((2, count * most), np.int64)
    firsts, doubtful = np.zeros(count + 1, np.int64), np.zeros(count, np.int64)
    table = qs, labels, firsts, doubtful
    _solve_all(flat, plan, goal, limits, targets, seeds, elbow_angles, most, found, space, kept, work, table)
    return qs[: firsts[count]], labels[:, : firsts[count]], firsts, doubtful


def elbow_angles(flat: FlatChain, plan: SubproblemPlan, qs: Array) -> Array:
    """Compute the elbow angle of each configuration about the line from shoulder to wrist; shape (N,), [rad]."""
    arguments: tuple[Any, ...] = (flat.drives, *plan, qs)
    angles: Array = _elbow_angles(*arguments)
    return angles


@compiled
def _elbow_angles(
    drives: Array,
    kind: int,
    backwards: int,
    form: int,
    placed: int,
    axes: Array,
    points: Array,
    slides: Indices,
    order: Indices,
    lines: Array,
    zero: Array,
    reach: float,
    terms: Array,
    qs: Array,
) -> Array:
    plan = SubproblemPlan(kind, backwards, form, placed, axes, points, slides, order, lines, zero, reach, terms)
    angles = np.empty(len(qs))
    for i in range(len(qs)):
        angles[i] = elbow_angle(plan, drives[:, 0] * qs[i] + drives[:, 1])
    return angles


@unmanaged
def _solve_all(
    flat: FlatChain,
    plan: SubproblemPlan,
    goal: Goal,
    limits: Array,
    targets: Array,
    seeds: Array,
    elbow_angles: Array,
    most: int,
    found: Candidates,
    space: Scratch,
    kept: _Kept,
    work: Work,
    table: tuple[Array, Indices, Indices, Indices],
) -> None:
    qs, labels, firsts, doubtful = table
    total, n = 0, seeds.shape[1]
    for i in range(len(targets)):
        seed = seeds[i if len(seeds) > 1 else 0]
        elbow_angle = elbow_angles[i if len(elbow_angles) > 1 else 0]
        count = _solve(flat, plan, goal, limits, targets[i], seed, elbow_angle, found, space, kept, work)
        for k in range(min(count, most)):
            for j in range(n):
                qs[total, j] = kept.qs[k, j]
            labels[0, total], labels[1, total] = kept.labels[0, k], kept.labels[1, k]
            total += 1
        firsts[i + 1], doubtful[i] = total, found.doubtful[0]


@inlined
def _solve(
    flat: FlatChain,
    plan: SubproblemPlan,
    goal: Goal,
    limits: Array,
    target: Array,
    seed: Array,
    elbow_angle: float,
    found: Candidates,
    space: Scratch,
    kept: _Kept,
    work: Work,
) -> int:
    """Put the sorted solutions of one target into `kept` and return their number."""
    n = len(seed)
    own = kept.qs[MOST]
    for i in range(n):
        j = n - 1 - i if plan.backwards else i
        own[i] = flat.drives[j, 0] * seed[j] + flat.drives[j, 1]
    candidates = compose(plan, target, own, elbow_angle, found, space)
    for k in range(12):
        store(work.state, k, lanes(target[k]))
    solutions = 0
    for first in range(0, candidates, LANES):
        for lane in range(LANES):
            row = min(first + lane, candidates - 1)
            for j in range(n):
                i = n - 1 - j if plan.backwards else j
                work.q[j * LANES + lane] = (found.values[row, i] - flat.drives[j, 1]) * flat.drives[j, 0]
        good = _polish(flat, goal, work)
        if n == DIRECTIONS and goal.kind == FULL:
            good = _refine(flat, goal, work, kept)
        good &= _wound(flat, limits, seed, work)
        for lane in range(min(LANES, candidates - first)):
            if (good >> lane) & 1:
                read_lane(work.q, lane, own)
                error = work.state[_POSITION * LANES + lane] + work.state[_ORIENTATION * LANES + lane]
                kept.errors[MOST], kept.labels[0, MOST] = error, found.codes[first + lane]
                kept.labels[1, MOST] = _unmoved(flat, plan, found, work, first + lane, lane)
                solutions = _insert(kept, solutions, flat, seed)
    return _without_near_misses(kept, solutions)


@inlined
def _polish(flat: FlatChain, goal: Goal, work: Work) -> int:
    """Drive the lanes to rounding without ever raising an error; `previous` holds the results. Return `_good`."""
    least, stalled, damping = lanes(np.inf), lanes(0.0), lanes(_DAMPING)
    # With fewer joints than directions JJᵀ is singular everywhere and needs damping.
    floor = _LEAST_DAMPING if len(work.q) >= 6 * LANES and goal.kind == FULL else _DAMPING
    # What an earlier target left there would be taken for errors that are not numbers.
    store(work.state, _POSITION, least)
    store(work.state, _ORIENTATION, least)
    for _ in range(_ROUNDS):
        e = linearise(flat, goal, work)
        position, orientation = squares(e)
        error = position + orientation
        better = error < least
        stalled = where(error < 0.5 * least, 0.0, stalled + 1.0)
        least = where(better, error, least)
        store(work.state, _POSITION, where(better, position, load(work.state, _POSITION)))
        store(work.state, _ORIENTATION, where(better, orientation, load(work.state, _ORIENTATION)))
        damping = where(better, max_lanes(1e-3 * damping, floor), min_lanes(100.0 * damping, 1e6))
        if bits((least > _PERFECT) & (stalled < 6.0)) == 0:
            for j in range(len(work.q) // LANES):
                store(work.previous, j, where(better, load(work.q, j), load(work.previous, j)))
            break
        descend(goal, work, e, damping, where(better, 1.0, 0.0), 1.0)
    return _good(goal, work)


@inlined
def _refine(flat: FlatChain, goal: Goal, work: Work, kept: _Kept) -> int:
    """Apply Newton's method with J itself to the lanes that are not at rounding yet; return `_good`.

    Next to a singularity JJᵀ loses the square of a small singular value, and damped steps stop too early. The solution
    lies along a narrow curved valley in which all equations but one hold. Each step is corrected back into the valley
    before the errors are compared, or every step along it would seem to raise the error.
    """
    state, share = work.state, kept.residuals[DIRECTIONS * LANES :]
    share[:] = 1.0
    for _ in range(_REFINEMENTS):
        before = load(state, _POSITION) + load(state, _ORIENTATION)
        if bits((load(share, 0) > _SHORTEST_SHARE) & (before > _PERFECT)) == 0:
            break
        for j in range(DIRECTIONS):
            store(work.q, j, load(work.previous, j))
        _newton_step(flat, goal, work, kept, _SINGULAR)
        for _ in range(_CORRECTIONS):
            _newton_step(flat, goal, work, kept, _WEAK)
        e = linearise(flat, goal, work)
        position, orientation = squares(e)
        better = position + orientation < before
        # A lane that has gone too far takes a quarter of the step next time.
        store(share, 0, where(better, min_lanes(2.0 * load(share, 0), 1.0), 0.25 * load(share, 0)))
        for j in range(DIRECTIONS):
            store(work.previous, j, where(better, load(work.q, j), load(work.previous, j)))
        store(state, _POSITION, where(better, position, load(state, _POSITION)))
        store(state, _ORIENTATION, where(better, orientation, load(state, _ORIENTATION)))
    return _good(goal, work)


@inlined
def _good(goal: Goal, work: Work) -> int:
    good: int = bits(within(goal, load(work.state, _POSITION), load(work.state, _ORIENTATION)))
    return good


@unmanaged
def _newton_step(flat: FlatChain, goal: Goal, work: Work, kept: _Kept, least: float) -> None:
    """Step the lanes that are not at rounding, ignoring pivots below a share of the largest."""
    A, share = kept.system, kept.residuals[DIRECTIONS * LANES :]
    e = linearise(flat, goal, work)
    for k in range(DIRECTIONS):
        store(kept.residuals, k, e[k])
    for lane in range(LANES):
        if work.state[_POSITION * LANES + lane] + work.state[_ORIENTATION * LANES + lane] <= _PERFECT:
            continue
        for k in range(DIRECTIONS):
            for j in range(DIRECTIONS):
                A[k, j] = work.J[(6 * j + k) * LANES + lane]
            A[k, DIRECTIONS] = kept.residuals[k * LANES + lane]
        _eliminate(A, kept.order, least)
        factor = share[lane] if least <= _SINGULAR else 1.0
        for j in range(DIRECTIONS):
            work.q[j * LANES + lane] += factor * A[j, DIRECTIONS]


@unmanaged
def _eliminate(A: Array, order: Indices, least: float) -> None:
    """Solve six linear equations with full pivoting; the last column becomes the solution, scaled to entries ≤ 0.5.

    Unknowns whose pivot is at most the share `least` of the largest become 0.
    """
    n = DIRECTIONS
    for j in range(n):
        order[j] = j
    largest = 0.0
    for j in range(n):
        best = pivoted(A, j, order)
        largest = max(largest, best)
        if best <= least * largest:
            continue
        for k in range(j + 1, n):
            factor = A[k, j] / A[j, j]
            for m in range(j, n + 1):
                A[k, m] -= factor * A[j, m]
    scale = 1.0
    for i in range(n):
        j = n - 1 - i
        total = A[j, n]
        for m in range(j + 1, n):
            total -= A[j, m] * A[m, n]
        A[j, n] = total / A[j, j] if abs(A[j, j]) > least * largest else 0.0
        scale = max(scale, 2.0 * abs(A[j, n]))
    for j in range(n):
        A[j, 0] = A[j, n] / scale
    for j in range(n):
        A[order[j], n] = A[j, 0]


@inlined
def _wound(flat: FlatChain, limits: Array, seed: Array, work: Work) -> int:
    """Put all lanes into `q`, by full turns within the limits and near the seed; return which fit, bit by bit."""
    inside = lanes(0.0) <= 0.0
    for j in range(len(seed)):
        lower, upper = limits[0, j], limits[1, j]
        x = load(work.previous, j)
        if flat.joints[j, 0] == 0:
            x = _wound_joint(x, seed[j], lower, upper)
        inside = inside & (x >= lower - ROUNDING) & (x <= upper + ROUNDING)
        store(work.q, j, min_lanes(max_lanes(x, lower), upper))
    fits: int = bits(inside)
    return fits


@inlined
def _wound_joint(x: Lanes, seed: float, lower: float, upper: float) -> Lanes:
    """Turn an angle as `wound` does, in all lanes."""
    x = x + _TURN * rint_lanes((seed - x) / _TURN)
    # ⌈a⌉ is -⌊-a⌋.
    down = _TURN * floor_lanes(-(x - upper - ROUNDING) / _TURN)
    up = _TURN * floor_lanes(-(lower - x - ROUNDING) / _TURN)
    return where(x > upper + ROUNDING, x + down, where(x < lower - ROUNDING, x - up, x))


@inlined
def _unmoved(flat: FlatChain, plan: SubproblemPlan, found: Candidates, work: Work, row: int, lane: int) -> int:
    """Bits of the variables whose joints are free in a candidate and have not been moved by polishing."""
    n, mask = found.values.shape[1], 0
    for j in range(n if found.free[row] else 0):
        i = n - 1 - j if plan.backwards else j
        reached = flat.drives[j, 0] * work.previous[j * LANES + lane] + flat.drives[j, 1]
        if (found.free[row] >> i) & 1 and not abs(reached - found.values[row, i]) > _MOVED:
            mask |= 1 << j
    return mask


@inlined
def _insert(kept: _Kept, count: int, flat: FlatChain, seed: Array) -> int:
    """Insert the spare row in the sorted solutions unless it is a duplicate; return their number."""
    own = kept.qs[MOST]
    distance = 0.0
    for j in range(len(seed)):
        distance += (own[j] - seed[j]) ** 2
    for k in range(count):
        apart = 0.0
        for j in range(len(seed)):
            difference = abs(kept.qs[k, j] - own[j])
            if flat.joints[j, 0] == 0:
                difference = abs(difference - _TURN * np.rint(difference / _TURN))
            apart = max(apart, difference)
            if apart > _SAME:
                break
        if apart <= _SAME:
            kept.labels[1, k] |= kept.labels[1, MOST]
            return count
    kept.distances[MOST] = distance
    place = count
    while place > 0 and kept.distances[place - 1] > distance:
        _copy(kept, place - 1, place)
        place -= 1
    _copy(kept, MOST, place)
    return count + 1


@inlined
def _copy(kept: _Kept, source: int, place: int) -> None:
    for j in range(kept.qs.shape[1]):
        kept.qs[place, j] = kept.qs[source, j]
    kept.distances[place], kept.errors[place] = kept.distances[source], kept.errors[source]
    kept.labels[0, place], kept.labels[1, place] = kept.labels[0, source], kept.labels[1, source]


@inlined
def _without_near_misses(kept: _Kept, count: int) -> int:
    """If a solution is exact, drop those that are only within the tolerances; return the number left."""
    least = np.inf
    for k in range(count):
        least = min(least, kept.errors[k])
    if least > _EXACT:
        return count
    left = 0
    for k in range(count):
        if kept.errors[k] <= _EXACT:
            _copy(kept, k, left)
            left += 1
    return left
