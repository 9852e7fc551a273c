"""Damped least squares, eight starts or eight targets at a time.

A *start* is an initial configuration: start 0 is the seed, the others depend only on the random seed and their number.
The answer to a target is that of its lowest-numbered start that converges, whichever lane or thread finishes first, so
it does not depend on the rest of the batch.

The damping λ is proportional to ‖e‖² [Sugihara2011], and no step is longer than 1 rad or m in any joint.
"""

from typing import Any

import numpy as np

from gelenk.ik.search.iteration import (
    BEST,
    COUNT,
    ERROR,
    FIRST,
    KEPT,
    REACHED,
    SINCE,
    Error,
    Goal,
    Work,
    descend,
    linearise,
    read_lane,
    set_target,
    workspace,
    wound,
)
from gelenk.kinematics.simd.lanes import LANES, Lanes, bits, lanes, load, max_lanes, min_lanes, sqrt_lanes, store, where
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined, unmanaged

_MOST_SWEPT = 4 * LANES
"""Starts of a target in a lane of its own while others wait for lanes; a race would repeat those that failed."""
_STAGNATION = 6
"""Iterations without halving of the squared error after which a start is given up."""
LONGEST = 40
"""Iterations after which a start is given up in any case."""
DAMPING, FLOOR = 0.05, 1e-10
"""λ as a share of the squared error, and its lower bound, which is added."""
APPROACHES = 200
"""Iterations spent on following the path from a seed closely."""
_APART = 0.2
"""Distance beyond which the configurations of two failed starts are both kept, [rad or m]."""
_FINALISTS = 2 * LANES
"""Number of kept configurations that are driven to a minimum of the error."""
_SCREENING, _POLISHING, _IDLE = 40, 1600, 60
"""Iterations for all kept configurations, for the finalists, and without progress before stopping. Progress means
that a squared error falls by a share of 1e-9, or by 1e-9 m² if it is above 1 m²."""
CLOSE = 0.01
"""Share of the tolerances above which a start within them takes one more step."""
LONGEST_STEP, CAREFUL_STEP = 1.0, 0.05
"""Largest step of a joint in general, and in following a path closely, [rad or m]."""
_NEAR, _JUMP, _STRETCH = 0.3, 0.2, 4.0
"""A seed with an error below `_NEAR` is near its target. An answer further from it than `_JUMP`, and than `_STRETCH`
times that error, has left the seed's branch."""

_POSITION, _ORIENTATION, _START_DAMPING = SINCE, COUNT, SINCE
"""State rows reused by `_improve` for squared errors, and before that for the initial damping."""


def search(flat: FlatChain, goal: Goal, targets: Array, seeds: Array) -> tuple[Array, Indices, Indices, Indices]:
    """Solve each target by its first start that converges.

    Args:
        targets: Rotation row by row, then position; shape (N, 12).
        seeds: One configuration for all targets or one each; shape (1 or N, n).

    Returns:
        Solutions, or the nearest configurations found, shape (N, n); the start that converged or -1, shape (N,); its
        iterations, shape (N,); and k if the seed was followed closely with initial damping 10⁻ᵏ, else -1, shape (N,).
    """
    # Passing a tuple to a compiled function costs much more than passing its parts.
    arguments: tuple[Any, ...] = (*flat, *goal, targets, seeds)
    qs, outcomes = _search(*arguments)
    return qs, outcomes[0], outcomes[1], outcomes[2]


@compiled
def _search(
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
    seeds: Array,
) -> tuple[Array, Indices]:
    flat = FlatChain(placements, joints, drives)
    goal = Goal(bounds, weights, kind, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    count, n = len(targets), seeds.shape[1]
    qs, outcomes = np.empty((count, n)), np.empty((3, count), np.int64)
    _search_all(flat, goal, targets, seeds, False, workspace(flat, n), qs, outcomes)
    return qs, outcomes


@compiled
def search_few(
    flat: FlatChain, goal: Goal, positions: Array, rotations: Array, seeds: Array, qs: Array, outcomes: Indices
) -> bool:
    """Fill in the results of `search`, (N, n) and (3, N), if every target is solved; return whether they are.

    The targets are poses; for an unsolved one no nearest configuration is looked for. For compiled callers.
    """
    targets = np.empty((len(positions), 12))
    for i in range(len(positions)):
        for j in range(3):
            for k in range(3):
                targets[i, 3 * j + k] = rotations[i, j, k]
            targets[i, 9 + j] = positions[i, j]
    _search_all(flat, goal, targets, seeds, True, workspace(flat, seeds.shape[1]), qs, outcomes)
    solved = True
    for i in range(len(targets)):
        solved &= outcomes[0, i] >= 0
    return solved


@unmanaged
def _search_all(
    flat: FlatChain,
    goal: Goal,
    targets: Array,
    seeds: Array,
    all_or_none: bool,
    work: Work,
    qs: Array,
    outcomes: Indices,
) -> None:
    """Sweep over the targets if there are many, then run a race for each unsolved one."""
    outcomes[:] = -1
    if len(targets) >= 2 * LANES:
        _sweep(flat, goal, targets, seeds, work, qs, outcomes[0], outcomes[1])
    for i in range(len(targets)):
        if outcomes[0, i] < 0:
            seed = seeds[i if len(seeds) > 1 else 0]
            outcomes[0, i], outcomes[1, i], outcomes[2, i] = _race(
                flat, goal, targets[i], seed, not all_or_none, work, qs[i]
            )
            if all_or_none and outcomes[0, i] < 0:
                return


@unmanaged
def _sweep(
    flat: FlatChain, goal: Goal, targets: Array, seeds: Array, work: Work, qs: Array, winners: Indices, its: Indices
) -> None:
    """Solve one target per lane, from few starts at the end; leave unsolved targets and jumps to a race."""
    count = len(targets)
    owners, starts = work.owners, work.starts
    following = 0
    for lane in range(LANES):
        owners[lane], starts[lane] = following, 0
        set_target(work, lane, targets[following])
        _set_start(goal, work, lane, seeds[following if len(seeds) > 1 else 0], 0)
        following += 1
    busy = LANES
    while busy:
        ended = _iterate(flat, goal, work)
        if ended == 0:
            continue
        for lane in range(LANES):
            owner = owners[lane]
            if owner < 0 or not _has(ended, lane):
                continue
            seed = seeds[owner if len(seeds) > 1 else 0]
            if _has(ended, lane + LANES):
                read_lane(work.previous, lane, qs[owner])
                _wind(goal, seed, qs[owner])
                if not _has_jumped(work, lane, seed, qs[owner]):
                    winners[owner] = starts[lane]
                    its[owner] = int(work.state[COUNT * LANES + lane])
            elif starts[lane] + 1 < min(goal.starts, _MOST_SWEPT if following < count else LANES):
                starts[lane] += 1
                _set_start(goal, work, lane, seed, starts[lane])
                continue
            if following < count:
                owners[lane], starts[lane] = following, 0
                set_target(work, lane, targets[following])
                _set_start(goal, work, lane, seeds[following if len(seeds) > 1 else 0], 0)
                following += 1
            else:
                owners[lane] = -1
                busy -= 1


@unmanaged
def _race(
    flat: FlatChain, goal: Goal, target: Array, seed: Array, approach: bool, work: Work, q: Array
) -> tuple[int, int, int]:
    """Run one start per lane; put the solution of the lowest-numbered one, or if `approach` the nearest, into `q`.

    Return that start or -1, its iterations, and how the seed was followed, see `search`.
    """
    starts = work.starts
    work.errors[:] = np.inf
    for lane in range(LANES):
        starts[lane] = lane
        set_target(work, lane, target)
        _set_start(goal, work, lane, seed, lane)
    following, winner, iterations, leader = LANES, goal.starts, 0, 0
    while starts[leader] < winner:
        ended, e, damping = _judge(flat, goal, work)
        if _has(ended, leader + LANES):
            # No other start has a lower number.
            winner, iterations = starts[leader], int(work.state[COUNT * LANES + leader])
            read_lane(work.q, leader, q)
            break
        descend(goal, work, e, damping, lanes(1.0), LONGEST_STEP)
        if ended == 0:
            continue
        for lane in range(LANES):
            if starts[lane] >= winner or not _has(ended, lane):
                continue
            if _has(ended, lane + LANES):
                winner, iterations = starts[lane], int(work.state[COUNT * LANES + lane])
                read_lane(work.previous, lane, q)
            else:
                _remember(work, lane, len(seed))
            starts[lane] = following
            _set_start(goal, work, lane, seed, following)
            following += 1
            leader = _first(starts)
    if winner == goal.starts:
        if not approach:
            return -1, 0, -1
        _approach(flat, goal, work, q)
        winner = -1
    _wind(goal, seed, q)
    followed = -1
    if winner >= 0 and _has_jumped(work, 0, seed, q):
        followed, steps = _follow(flat, goal, seed, work, q)
        if followed >= 0:
            winner, iterations = 0, steps
    return winner, iterations, followed


@unmanaged
def _remember(work: Work, lane: int, n: int) -> None:
    """Keep the end of a failed start if it is among the nearest; of ends close together keep only one."""
    error, place = work.state[ERROR * LANES + lane], 0
    for k in range(KEPT):
        if work.errors[k] > work.errors[place]:
            place = k
    if error >= work.errors[place]:
        return
    for k in range(KEPT):
        apart = 0.0 if work.errors[k] < np.inf else np.inf
        for j in range(n):
            apart = max(apart, abs(work.candidates[k * n + j] - work.previous[j * LANES + lane]))
        if apart < _APART:
            if error >= work.errors[k]:
                return
            place = k
            break
    work.errors[place] = error
    for j in range(n):
        work.candidates[place * n + j] = work.previous[j * LANES + lane]


@unmanaged
def _approach(flat: FlatChain, goal: Goal, work: Work, q: Array) -> None:
    """Drive the kept configurations downhill, then the best of them to a minimum; put the nearest into `q`."""
    n, nearest = len(q), 0
    for first in range(0, KEPT, LANES):
        if work.errors[first] < np.inf:
            _approach_from(flat, goal, work, first, n, _SCREENING)
    for place in range(_FINALISTS):
        best = place
        for k in range(place, KEPT):
            if work.errors[k] < work.errors[best]:
                best = k
        work.errors[place], work.errors[best] = work.errors[best], work.errors[place]
        for j in range(n):
            here, there = place * n + j, best * n + j
            work.candidates[here], work.candidates[there] = work.candidates[there], work.candidates[here]
    for first in range(0, _FINALISTS, LANES):
        if work.errors[first] < np.inf:
            _approach_from(flat, goal, work, first, n, _POLISHING)
    for k in range(_FINALISTS):
        if work.errors[k] < work.errors[nearest]:
            nearest = k
    for j in range(n):
        q[j] = work.candidates[nearest * n + j]


@unmanaged
def _approach_from(flat: FlatChain, goal: Goal, work: Work, first: int, n: int, rounds: int) -> None:
    for lane in range(LANES):
        # If fewer starts than lanes have failed, some lanes share a candidate.
        k = first + lane if work.errors[first + lane] < np.inf else first
        for j in range(n):
            work.q[j * LANES + lane] = work.previous[j * LANES + lane] = work.candidates[k * n + j]
    _improve(flat, goal, work, lanes(1e-3), LONGEST_STEP, rounds, True)
    for lane in range(LANES):
        k = first + lane
        work.errors[k] = work.state[BEST * LANES + lane]
        for j in range(n):
            work.candidates[k * n + j] = work.previous[j * LANES + lane]


@unmanaged
def _follow(flat: FlatChain, goal: Goal, seed: Array, work: Work, q: Array) -> tuple[int, int]:
    """Follow the path from the seed in small steps; if a solution nearer to the seed is found, put it into `q`.

    Return the lane k that found it, with initial damping 10⁻ᵏ, and its iterations until it was within the tolerances;
    -1 and 0 if none did.
    """
    for lane in range(LANES):
        _set_start(goal, work, lane, seed, 0)
        work.state[_START_DAMPING * LANES + lane] = 10.0 ** (-lane)
        for j in range(len(q)):
            work.previous[j * LANES + lane] = work.q[j * LANES + lane]
    _improve(flat, goal, work, load(work.state, _START_DAMPING), CAREFUL_STEP, APPROACHES, False)
    nearest, found, iterations = _largest_difference(q, seed), -1, 0
    own = work.candidates[: len(q)]
    for lane in range(LANES):
        position, orientation = work.state[_POSITION * LANES + lane], work.state[_ORIENTATION * LANES + lane]
        if position <= goal.position_tolerance**2 and orientation <= goal.chord_tolerance**2:
            read_lane(work.previous, lane, own)
            _wind(goal, seed, own)
            if _largest_difference(own, seed) < nearest:
                nearest, found = _largest_difference(own, seed), lane
                iterations = int(work.state[REACHED * LANES + lane])
                for j in range(len(q)):
                    q[j] = own[j]
    return found, iterations


@unmanaged
def _improve(
    flat: FlatChain, goal: Goal, work: Work, damping: Lanes, most: float, rounds: int, as_angles: bool
) -> None:
    """Run Levenberg-Marquardt with a separate damping for each lane [Marquardt1963].

    A step that raises the error is undone and the damping multiplied by ten; any other divides it by four. At the end
    `previous` holds the best configurations, `BEST`, `_POSITION` and `_ORIENTATION` their squared errors, and
    `REACHED` the iteration that came within the tolerances, or 0.
    """
    least, idle = lanes(np.inf), 0
    for round_ in range(rounds):
        e = linearise(flat, goal, work, as_angles)
        position = e[0] * e[0] + e[1] * e[1] + e[2] * e[2]
        orientation = e[3] * e[3] + e[4] * e[4] + e[5] * e[5]
        error = position + orientation
        better = error <= least
        idle = 0 if bits(error < least - 1e-9 * min_lanes(least, 1.0)) else idle + 1
        if idle == _IDLE:
            break
        least = where(better, error, least)
        within = (position <= goal.position_tolerance**2) & (orientation <= goal.chord_tolerance**2)
        reached = load(work.state, REACHED)
        store(work.state, REACHED, where(within & (reached < 0.5), float(round_ + 1), reached))
        store(work.state, _POSITION, where(better, position, load(work.state, _POSITION)))
        store(work.state, _ORIENTATION, where(better, orientation, load(work.state, _ORIENTATION)))
        damping = where(better, max_lanes(0.25 * damping, FLOOR), min_lanes(10.0 * damping, 1e6))
        descend(goal, work, e, damping, where(better, 1.0, 0.0), most)
    store(work.state, BEST, least)


@inlined
def _has_jumped(work: Work, lane: int, seed: Array, q: Array) -> bool:
    first = np.sqrt(work.state[FIRST * LANES + lane])
    jumped: bool = first < _NEAR and _largest_difference(q, seed) > max(_JUMP, _STRETCH * first)
    return jumped


@inlined
def _largest_difference(q: Array, other: Array) -> float:
    largest = 0.0
    for j in range(len(q)):
        largest = max(largest, abs(q[j] - other[j]))
    return largest


@inlined
def _first(starts: Indices) -> int:
    first = 0
    for lane in range(LANES):
        if starts[lane] < starts[first]:
            first = lane
    return first


@inlined
def _has(ended: int, bit: int) -> bool:
    return (ended >> bit) & 1 == 1


@inlined
def _wind(goal: Goal, seed: Array, q: Array) -> None:
    for j in range(len(q)):
        lower, upper = goal.bounds[4, j], goal.bounds[5, j]
        if lower <= upper:
            q[j] = min(max(wound(q[j], seed[j], lower, upper), lower), upper)


@inlined
def _set_start(goal: Goal, work: Work, lane: int, seed: Array, start: int) -> None:
    for j in range(len(seed)):
        value = seed[j]
        if start > 0:
            share = uniform(goal.random_seed, start, j)
            value = goal.bounds[2, j] + share * (goal.bounds[3, j] - goal.bounds[2, j])
        work.q[j * LANES + lane] = min(max(value, goal.bounds[0, j]), goal.bounds[1, j])
    work.state[BEST * LANES + lane] = np.inf
    work.state[SINCE * LANES + lane] = 0.0
    work.state[COUNT * LANES + lane] = 0.0
    work.state[REACHED * LANES + lane] = 0.0
    if start == 0:
        work.state[FIRST * LANES + lane] = -1.0


@inlined
def uniform(random_seed: int, start: int, variable: int) -> float:
    """Pseudo-random number in [0, 1) determined by the arguments, by the SplitMix64 mixing function [Steele2014]."""
    z = np.uint64(random_seed) * np.uint64(0xD1342543DE82EF95)
    z += np.uint64(start) * np.uint64(0x9E3779B97F4A7C15) + np.uint64(variable) * np.uint64(0xBF58476D1CE4E5B9)
    for factor in (np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)):
        z = (z ^ (z >> np.uint64(30))) * factor
    z ^= z >> np.uint64(31)
    return float(z >> np.uint64(11)) * 2.0**-53


@inlined
def _iterate(flat: FlatChain, goal: Goal, work: Work) -> int:
    """Take one iteration in every SIMD lane: judge the state, then step.

    In the result, bits 0 to LANES - 1 flag lanes whose start has ended; the next LANES bits those that have converged,
    whose solutions are in `previous`.
    """
    ended, e, damping = _judge(flat, goal, work)
    descend(goal, work, e, damping, lanes(1.0), LONGEST_STEP)
    return ended


@inlined
def _judge(flat: FlatChain, goal: Goal, work: Work) -> tuple[int, Error, Lanes]:
    """Return bits of the lanes that have ended at `q`, see `_iterate`, and error and damping of the next step."""
    state = work.state
    e = linearise(flat, goal, work)
    position, orientation = e[0] * e[0] + e[1] * e[1] + e[2] * e[2], e[3] * e[3] + e[4] * e[4] + e[5] * e[5]
    error = position + orientation
    within = (position <= goal.position_tolerance**2) & (orientation <= goal.chord_tolerance**2)
    if goal.slack > 0.0:
        a = _shortening(position, goal.slack * goal.position_tolerance)
        b = _shortening(orientation, goal.slack * goal.chord_tolerance)
        e = (a * e[0], a * e[1], a * e[2], b * e[3], b * e[4], b * e[5])
        error = a * a * position + b * b * orientation
        # An error that is small enough must not hold the joints back either.
        for row in range(0, len(work.J) // LANES, 6):
            for k in range(3):
                store(work.J, row + k, a * load(work.J, row + k))
                store(work.J, row + 3 + k, b * load(work.J, row + 3 + k))
    halved = error < 0.5 * load(state, BEST)
    since = where(halved, 0.0, load(state, SINCE) + 1.0)
    count = load(state, COUNT) + 1.0
    given_up = (since >= float(_STAGNATION)) | (count >= float(LONGEST))
    # One more step than needed takes the error from the tolerance to rounding.
    near = (position <= (CLOSE * goal.position_tolerance) ** 2) & (orientation <= (CLOSE * goal.chord_tolerance) ** 2)
    converged = within & ((load(state, REACHED) > 0.5) | given_up | near)
    store(state, ERROR, error)
    store(state, FIRST, where(load(state, FIRST) < 0.0, error, load(state, FIRST)))
    store(state, BEST, where(halved, error, load(state, BEST)))
    store(state, SINCE, since)
    store(state, COUNT, count)
    store(state, REACHED, where(within, 1.0, 0.0))
    return bits(converged | given_up) | (bits(converged) << LANES), e, DAMPING * error + FLOOR


@inlined
def _shortening(square: Lanes, length: float) -> Lanes:
    """Factor that shortens vectors, given by their squared lengths, by a length, but not below zero."""
    return max_lanes(1.0 - length / sqrt_lanes(max_lanes(square, 1e-300)), 0.0)
