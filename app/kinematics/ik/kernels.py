"""Damped least squares, eight starts or eight targets at a time.

A *start* is a configuration from which the error is driven down: start 0 is the seed, the others are drawn from the
random seed and their number alone. The answer to a target is the one of its first start that converges, whichever
lane or thread came to it first; so it does not depend on what else is in the batch.

The step is Δq = Jᵀ(JJᵀ + λI)⁻¹e with λ in proportion to ‖e‖² [Sugihara2011], no longer than 1 rad or m in any joint.
A variable at its bound that the descent pushes outwards is left out of it. Orientation errors are 2 sin(θ/2) times the
axis, which has no false zero at 180°.
"""

from typing import Any, NamedTuple, TypeAlias

import numpy as np

from app.kinematics.kernels import Frame, joint_columns, variable_columns
from app.kinematics.lanes import (
    LANES,
    Lanes,
    abs_lanes,
    bits,
    lanes,
    load,
    max_lanes,
    min_lanes,
    sqrt_lanes,
    store,
    where,
)
from app.model.arrays import Array, Indices, compiled, inlined, unmanaged
from app.model.chain import FlatChain

_Error: TypeAlias = tuple[Lanes, Lanes, Lanes, Lanes, Lanes, Lanes]
"""Errors in registers, linear before angular."""

_Symmetric: TypeAlias = tuple[
    Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes,
    Lanes, Lanes, Lanes, Lanes, Lanes,
]  # fmt: skip
"""A symmetric matrix in registers, lower triangle row by row."""

FULL, AXIS, SOME = 0, 1, 2
"""What of a pose is asked for: all of it; position and one axis's direction; another choice."""

_STAGNATION = 6
"""Iterations without halving the squared error after which a start is given up."""
LONGEST = 40
"""Iterations after which it is given up in any case."""
DAMPING, FLOOR = 0.05, 1e-10
"""λ as a share of the squared error, and what is added to it."""
APPROACHES = 200
"""Iterations spent on the nearest configuration to an unsolved target, and on following a path closely."""
CLOSE = 0.01
"""Share of the tolerances that is good enough; above it a start within them takes one step more."""
_ROUNDING = 1e-10
"""How far beyond a limit counts as at it, [rad]."""
LONGEST_STEP, CAREFUL_STEP = 1.0, 0.05
"""Largest step of a joint, and where a path is followed closely, [rad or m]."""
_NEAR, _JUMP, _STRETCH = 0.3, 0.2, 4.0
"""A seed with no larger error is near its target: an answer that is further from it than a jump, and than so many
times that error, has left its branch."""

_ERROR, _BEST, _SINCE, _COUNT, _REACHED, _FIRST, _STATE_ROWS = 12, 13, 14, 15, 16, 17, 18
"""Rows of a state: the target takes the first twelve."""
_POSITION, _ORIENTATION, _START_DAMPING = _SINCE, _COUNT, _SINCE
"""What three of them hold while candidates are improved: squared errors, and before that the damping to begin with."""


class Goal(NamedTuple):
    """What a search is to reach, and within which bounds.

    Attributes:
        bounds: Lower and upper bound of each variable, infinite where it turns freely; the interval from which starts
            are drawn; and the limits of those that turn freely, NaN for others; shape (6, n), [rad or m].
        weights: 1 for each direction that counts, else 0: x y z in the base's axes, rx ry rz about the target's;
            shape (6,).
        kind: `FULL`, `AXIS` or `SOME`.
        axis: With `AXIS`, which axis of the tip is to point as the target's does.
        position_tolerance: [m].
        chord_tolerance: Of 2 sin(θ/2), θ the angle of the orientation's error, or of its components that count.
        slack: Share of the tolerances that errors are made smaller by: 0 drives them to zero, which is best, and 0.9
            uses what loose tolerances allow.
        starts: How many starts a target gets.
        random_seed: Of the starts.
    """

    bounds: Array
    weights: Array
    kind: int
    axis: int
    position_tolerance: float
    chord_tolerance: float
    slack: float
    starts: int
    random_seed: int


class _Work(NamedTuple):
    """Rows of lanes: what a search remembers of each lane, and room for one iteration.

    Attributes:
        state: Target, errors and counts of each lane.
        q: Where each lane stands.
        previous: Where it stood when it was last judged.
        columns: The Jacobian by joints.
        J: The Jacobian by variables.
        candidates: The nearest configuration among the failed starts of each lane.
        errors: How near that is, squared; shape (LANES,).
        starts: Which start each lane is at; shape (LANES,).
        owners: Which target each lane is at; shape (LANES,).
        coupled: Whether the columns by variables are others than those by joints.
    """

    state: Array
    q: Array
    previous: Array
    columns: Array
    J: Array
    candidates: Array
    errors: Array
    starts: Indices
    owners: Indices
    coupled: bool


@compiled
def _workspace(flat: FlatChain, n: int) -> _Work:
    joints = len(flat.joints)
    coupled = joints != n
    for i in range(joints):
        coupled |= flat.joints[i, 1] != i or flat.drives[i, 0] != 1.0
    rows = np.zeros((_STATE_ROWS + 1 + 9 * n + 6 * joints) * LANES)
    integers = np.zeros(2 * LANES, np.int64)
    state, q = _STATE_ROWS * LANES, n * LANES
    columns = state + 3 * q
    J = columns + 6 * joints * LANES
    errors = J + 6 * q
    return _Work(
        rows[:state],
        rows[state : state + q],
        rows[state + q : state + 2 * q],
        rows[columns:J],
        rows[J:errors],
        rows[state + 2 * q : columns],
        rows[errors:],
        integers[:LANES],
        integers[LANES:],
        coupled,
    )


def search(flat: FlatChain, goal: Goal, targets: Array, seeds: Array) -> tuple[Array, Indices, Indices, Indices]:
    """Solve each target by the first of its starts that converges.

    Args:
        flat: The chain.
        goal: What counts.
        targets: Rotation row by row, then position; shape (N, 12).
        seeds: One configuration for all, or one each; shape (1 or N, n).

    Returns:
        Configurations, of an unsolved target the nearest that was found, shape (N, n); the start that converged or
        -1, shape (N,); its iterations, shape (N,); and where the seed had to be followed closely, by how many powers
        of ten the damping began below 1, else -1, shape (N,).
    """
    # To hand over a tuple costs a compiled function much more than its parts.
    arguments: tuple[Any, ...] = (*flat, *goal, targets, seeds)
    qs, outcomes = _search(*arguments)
    return qs, outcomes[0], outcomes[1], outcomes[2]


def gather(flat: FlatChain, goal: Goal, target: Array, seed: Array) -> Array:
    """Where each start of one target converges, in the order in which they do; shape (k, n).

    Args:
        flat: The chain.
        goal: What counts.
        target: Rotation row by row, then position; shape (12,).
        seed: The first start; shape (n,).
    """
    arguments: tuple[Any, ...] = (*flat, *goal, target, seed)
    found: Array = _gather(*arguments)
    return found


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
    """See `search`."""
    flat = FlatChain(placements, joints, drives)
    goal = Goal(bounds, weights, kind, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    count, n = len(targets), seeds.shape[1]
    qs, outcomes = np.empty((count, n)), np.empty((3, count), np.int64)
    work = _workspace(flat, n)
    _search_all(flat, goal, targets, seeds, work, qs, outcomes)
    return qs, outcomes


@compiled
def _gather(
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
    target: Array,
    seed: Array,
) -> Array:
    """See `gather`."""
    flat = FlatChain(placements, joints, drives)
    goal = Goal(bounds, weights, kind, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    found = np.empty((starts, len(seed)))
    return found[: _gather_all(flat, goal, target, seed, _workspace(flat, len(seed)), found)]


@unmanaged
def _search_all(
    flat: FlatChain, goal: Goal, targets: Array, seeds: Array, work: _Work, qs: Array, outcomes: Indices
) -> None:
    """A sweep over many targets, then a race for each that it leaves."""
    outcomes[:] = -1
    if len(targets) >= 2 * LANES:
        _sweep(flat, goal, targets, seeds, work, qs, outcomes[0], outcomes[1])
    for i in range(len(targets)):
        if outcomes[0, i] < 0:
            seed = seeds[i if len(seeds) > 1 else 0]
            outcomes[0, i], outcomes[1, i], outcomes[2, i] = _race(flat, goal, targets[i], seed, work, qs[i])


@unmanaged
def _gather_all(flat: FlatChain, goal: Goal, target: Array, seed: Array, work: _Work, found: Array) -> int:
    """Fill `found` and say how many there are."""
    count = 0
    starts = work.starts
    for lane in range(LANES):
        starts[lane] = lane
        _set_target(work, lane, target)
        _set_start(goal, work, lane, seed, lane)
    following = LANES
    while starts[_first(starts)] < goal.starts:
        ended = _iterate(flat, goal, work)
        if ended == 0:
            continue
        for lane in range(LANES):
            if starts[lane] < goal.starts and _has(ended, lane):
                if _has(ended, lane + LANES):
                    _read(work.previous, lane, found[count])
                    count += 1
                starts[lane] = following
                _set_start(goal, work, lane, seed, following)
                following += 1
    return count


@unmanaged
def _sweep(
    flat: FlatChain, goal: Goal, targets: Array, seeds: Array, work: _Work, qs: Array, winners: Indices, its: Indices
) -> None:
    """A target a lane, at most `LANES` starts each; what is not solved then, or not near, is left to a race."""
    most = min(goal.starts, LANES)
    count = len(targets)
    owners, starts = work.owners, work.starts
    following = 0
    for lane in range(LANES):
        owners[lane], starts[lane] = following, 0
        _set_target(work, lane, targets[following])
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
                _read(work.previous, lane, qs[owner])
                _wind(goal, seed, qs[owner])
                if not _has_jumped(work, lane, seed, qs[owner]):
                    winners[owner] = starts[lane]
                    its[owner] = int(work.state[_COUNT * LANES + lane])
            elif starts[lane] + 1 < most:
                starts[lane] += 1
                _set_start(goal, work, lane, seed, starts[lane])
                continue
            if following < count:
                owners[lane], starts[lane] = following, 0
                _set_target(work, lane, targets[following])
                _set_start(goal, work, lane, seeds[following if len(seeds) > 1 else 0], 0)
                following += 1
            else:
                owners[lane] = -1
                busy -= 1


@unmanaged
def _race(flat: FlatChain, goal: Goal, target: Array, seed: Array, work: _Work, q: Array) -> tuple[int, int, int]:
    """A start a lane: the one of the lowest number that converges; or -1, and `q` the nearest.

    Returns:
        That start, its iterations, and how the seed was followed, as `search` tells it.
    """
    starts = work.starts
    for lane in range(LANES):
        starts[lane], work.errors[lane] = lane, np.inf
        _set_target(work, lane, target)
        _set_start(goal, work, lane, seed, lane)
    following, winner, iterations, leader = LANES, goal.starts, 0, 0
    while starts[leader] < winner:
        ended, e, damping = _judge(flat, goal, work)
        if _has(ended, leader + LANES):
            # None of the others can come before it.
            winner, iterations = starts[leader], int(work.state[_COUNT * LANES + leader])
            _read(work.q, leader, q)
            break
        _descend(goal, work, e, damping, lanes(1.0), LONGEST_STEP)
        if ended == 0:
            continue
        for lane in range(LANES):
            if starts[lane] >= winner or not _has(ended, lane):
                continue
            if _has(ended, lane + LANES):
                winner, iterations = starts[lane], int(work.state[_COUNT * LANES + lane])
                _read(work.previous, lane, q)
            else:
                _remember(work, lane, len(seed))
            starts[lane] = following
            _set_start(goal, work, lane, seed, following)
            following += 1
            leader = _first(starts)
    if winner == goal.starts:
        _approach(flat, goal, work, q)
        winner = -1
    _wind(goal, seed, q)
    followed = -1
    if winner >= 0 and _has_jumped(work, 0, seed, q):
        followed, steps = _follow(flat, goal, seed, work, q)
        if followed >= 0:
            winner, iterations = 0, steps
    return winner, iterations, followed


@inlined
def _remember(work: _Work, lane: int, n: int) -> None:
    """Keep where a failed start came to, if no other of its lane came nearer."""
    error = work.state[_ERROR * LANES + lane]
    if error < work.errors[lane]:
        work.errors[lane] = error
        for j in range(n):
            work.candidates[j * LANES + lane] = work.previous[j * LANES + lane]


@unmanaged
def _approach(flat: FlatChain, goal: Goal, work: _Work, q: Array) -> None:
    """Drive the candidates, one a lane, to the least error near them; `q` becomes the best."""
    nearest = 0
    for lane in range(LANES):
        if work.errors[lane] < work.errors[nearest]:
            nearest = lane
    for lane in range(LANES):
        # A lane whose starts have not failed yet takes the nearest of the others.
        source = lane if work.errors[lane] < np.inf else nearest
        for j in range(len(q)):
            value = work.candidates[j * LANES + source]
            work.q[j * LANES + lane] = work.previous[j * LANES + lane] = value
    _improve(flat, goal, work, lanes(1e-3), LONGEST_STEP)
    best = 0
    for lane in range(LANES):
        if work.state[_BEST * LANES + lane] < work.state[_BEST * LANES + best]:
            best = lane
    _read(work.previous, best, q)


@unmanaged
def _follow(flat: FlatChain, goal: Goal, seed: Array, work: _Work, q: Array) -> tuple[int, int]:
    """Go from the seed by small steps, each lane with a damping of its own; `q` becomes what is nearer to the seed.

    Returns:
        The lane that came nearest, which is the power of ten below 1 at which its damping began, and how many
        iterations took it within the tolerances; -1 and 0 if none came nearer.
    """
    for lane in range(LANES):
        _set_start(goal, work, lane, seed, 0)
        work.state[_START_DAMPING * LANES + lane] = 10.0 ** (-lane)
        for j in range(len(q)):
            work.previous[j * LANES + lane] = work.q[j * LANES + lane]
    _improve(flat, goal, work, load(work.state, _START_DAMPING), CAREFUL_STEP)
    nearest, found, iterations = _largest_difference(q, seed), -1, 0
    own = work.candidates[: len(q)]
    for lane in range(LANES):
        position, orientation = work.state[_POSITION * LANES + lane], work.state[_ORIENTATION * LANES + lane]
        if position <= goal.position_tolerance**2 and orientation <= goal.chord_tolerance**2:
            _read(work.previous, lane, own)
            _wind(goal, seed, own)
            if _largest_difference(own, seed) < nearest:
                nearest, found = _largest_difference(own, seed), lane
                iterations = int(work.state[_REACHED * LANES + lane])
                for j in range(len(q)):
                    q[j] = own[j]
    return found, iterations


@unmanaged
def _improve(flat: FlatChain, goal: Goal, work: _Work, damping: Lanes, most: float) -> None:
    """Levenberg-Marquardt with a damping of its own for each lane, never to the worse [Marquardt1963].

    A step that makes it worse is taken back and damped ten times more, any other halves the damping twice. In the end
    `previous` is where each lane stands; `_BEST`, `_POSITION` and `_ORIENTATION` hold its squared errors, `_REACHED`
    the iteration that came within the tolerances, or 0.
    """
    least = lanes(np.inf)
    for round_ in range(APPROACHES):
        e = _linearise(flat, goal, work)
        position = e[0] * e[0] + e[1] * e[1] + e[2] * e[2]
        orientation = e[3] * e[3] + e[4] * e[4] + e[5] * e[5]
        error = position + orientation
        better = error <= least
        least = where(better, error, least)
        within = (position <= goal.position_tolerance**2) & (orientation <= goal.chord_tolerance**2)
        reached = load(work.state, _REACHED)
        store(work.state, _REACHED, where(within & (reached < 0.5), float(round_ + 1), reached))
        store(work.state, _POSITION, where(better, position, load(work.state, _POSITION)))
        store(work.state, _ORIENTATION, where(better, orientation, load(work.state, _ORIENTATION)))
        damping = where(better, max_lanes(0.25 * damping, FLOOR), min_lanes(10.0 * damping, 1e6))
        _descend(goal, work, e, damping, where(better, 1.0, 0.0), most)
    store(work.state, _BEST, least)


@inlined
def _has_jumped(work: _Work, lane: int, seed: Array, q: Array) -> bool:
    """Whether an answer is far from a seed that was near its target."""
    first = np.sqrt(work.state[_FIRST * LANES + lane])
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
    """The lane of the start with the lowest number."""
    first = 0
    for lane in range(LANES):
        if starts[lane] < starts[first]:
            first = lane
    return first


@inlined
def _has(ended: int, bit: int) -> bool:
    return (ended >> bit) & 1 == 1


@inlined
def _read(rows: Array, lane: int, q: Array) -> None:
    for j in range(len(q)):
        q[j] = rows[j * LANES + lane]


@inlined
def _wind(goal: Goal, seed: Array, q: Array) -> None:
    """Turn what turns freely by full turns into its limits and as near to the seed as they allow."""
    turn = 2.0 * np.pi
    for j in range(len(q)):
        lower, upper = goal.bounds[4, j], goal.bounds[5, j]
        if lower <= upper:
            value = q[j] + turn * np.rint((seed[j] - q[j]) / turn)
            # Rounding may carry a joint over its limit: that is no reason to turn it all the way round.
            if value > upper + _ROUNDING:
                value -= turn * np.ceil((value - upper - _ROUNDING) / turn)
            elif value < lower - _ROUNDING:
                value += turn * np.ceil((lower - value - _ROUNDING) / turn)
            q[j] = min(max(value, lower), upper)


@inlined
def _set_target(work: _Work, lane: int, target: Array) -> None:
    for k in range(12):
        work.state[k * LANES + lane] = target[k]


@inlined
def _set_start(goal: Goal, work: _Work, lane: int, seed: Array, start: int) -> None:
    """Put a lane at a start, within the bounds."""
    for j in range(len(seed)):
        value = seed[j]
        if start > 0:
            share = uniform(goal.random_seed, start, j)
            value = goal.bounds[2, j] + share * (goal.bounds[3, j] - goal.bounds[2, j])
        work.q[j * LANES + lane] = min(max(value, goal.bounds[0, j]), goal.bounds[1, j])
    work.state[_BEST * LANES + lane] = np.inf
    work.state[_SINCE * LANES + lane] = 0.0
    work.state[_COUNT * LANES + lane] = 0.0
    work.state[_REACHED * LANES + lane] = 0.0
    if start == 0:
        work.state[_FIRST * LANES + lane] = -1.0


@inlined
def uniform(random_seed: int, start: int, variable: int) -> float:
    """A number in [0, 1) that the three determine, by the mixing function of SplitMix64 [Steele2014]."""
    z = np.uint64(random_seed) * np.uint64(0xD1342543DE82EF95)
    z += np.uint64(start) * np.uint64(0x9E3779B97F4A7C15) + np.uint64(variable) * np.uint64(0xBF58476D1CE4E5B9)
    for factor in (np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)):
        z = (z ^ (z >> np.uint64(30))) * factor
    z ^= z >> np.uint64(31)
    return float(z >> np.uint64(11)) * 2.0**-53


@inlined
def _iterate(flat: FlatChain, goal: Goal, work: _Work) -> int:
    """One iteration of every lane: judge where it stands, then step.

    Returns:
        Bits 0 to LANES - 1: the lane's start has ended; the next LANES bits: because it has converged, and then
        `previous` is its configuration.
    """
    ended, e, damping = _judge(flat, goal, work)
    _descend(goal, work, e, damping, lanes(1.0), LONGEST_STEP)
    return ended


@inlined
def _judge(flat: FlatChain, goal: Goal, work: _Work) -> tuple[int, _Error, Lanes]:
    """Which lanes have ended at `q`, in bits as `_iterate` gives them; and the error and damping of the next step."""
    state = work.state
    e = _linearise(flat, goal, work)
    position, orientation = e[0] * e[0] + e[1] * e[1] + e[2] * e[2], e[3] * e[3] + e[4] * e[4] + e[5] * e[5]
    error = position + orientation
    within = (position <= goal.position_tolerance**2) & (orientation <= goal.chord_tolerance**2)
    if goal.slack > 0.0:
        a = _shortening(position, goal.slack * goal.position_tolerance)
        b = _shortening(orientation, goal.slack * goal.chord_tolerance)
        e = (a * e[0], a * e[1], a * e[2], b * e[3], b * e[4], b * e[5])
        error = a * a * position + b * b * orientation
        # What is good enough must not hold the joints back either.
        for row in range(0, len(work.J) // LANES, 6):
            for k in range(3):
                store(work.J, row + k, a * load(work.J, row + k))
                store(work.J, row + 3 + k, b * load(work.J, row + 3 + k))
    halved = error < 0.5 * load(state, _BEST)
    since = where(halved, 0.0, load(state, _SINCE) + 1.0)
    count = load(state, _COUNT) + 1.0
    given_up = (since >= float(_STAGNATION)) | (count >= float(LONGEST))
    # One step more than needed takes the error from the tolerance to rounding.
    near = (position <= (CLOSE * goal.position_tolerance) ** 2) & (orientation <= (CLOSE * goal.chord_tolerance) ** 2)
    converged = within & ((load(state, _REACHED) > 0.5) | given_up | near)
    store(state, _ERROR, error)
    store(state, _FIRST, where(load(state, _FIRST) < 0.0, error, load(state, _FIRST)))
    store(state, _BEST, where(halved, error, load(state, _BEST)))
    store(state, _SINCE, since)
    store(state, _COUNT, count)
    store(state, _REACHED, where(within, 1.0, 0.0))
    return bits(converged | given_up) | (bits(converged) << LANES), e, DAMPING * error + FLOOR


@inlined
def _shortening(square: Lanes, length: float) -> Lanes:
    """The factor that makes vectors of a squared length shorter by a length, those that are no longer to nothing."""
    return max_lanes(1.0 - length / sqrt_lanes(max_lanes(square, 1e-300)), 0.0)


@inlined
def _linearise(flat: FlatChain, goal: Goal, work: _Work) -> _Error:
    """The error of every lane, and in `J` the columns that go with it; what does not count is zero in both."""
    columns = work.J
    if work.coupled:
        columns = work.columns
    frame = joint_columns(flat, work.q, columns)
    if work.coupled:
        variable_columns(flat, columns, work.J)
    state = work.state
    e0, e1, e2 = load(state, 9) - frame[9], load(state, 10) - frame[10], load(state, 11) - frame[11]
    if goal.kind == FULL:
        w = _turn(state, frame)
        return e0, e1, e2, w[0], w[1], w[2]
    w = _swing(state, frame, goal.axis) if goal.kind == AXIS else _turn(state, frame)
    weights = goal.weights
    for j in range(len(work.J) // (6 * LANES)):
        u = _in_target(state, load(work.J, 6 * j + 3), load(work.J, 6 * j + 4), load(work.J, 6 * j + 5))
        for k in range(3):
            store(work.J, 6 * j + k, weights[k] * load(work.J, 6 * j + k))
            store(work.J, 6 * j + 3 + k, weights[3 + k] * u[k])
    w = _in_target(state, w[0], w[1], w[2])
    return weights[0] * e0, weights[1] * e1, weights[2] * e2, weights[3] * w[0], weights[4] * w[1], weights[5] * w[2]


@inlined
def _in_target(state: Array, w0: Lanes, w1: Lanes, w2: Lanes) -> tuple[Lanes, Lanes, Lanes]:
    """A vector of the base expressed in the target's axes."""
    return (
        load(state, 0) * w0 + load(state, 3) * w1 + load(state, 6) * w2,
        load(state, 1) * w0 + load(state, 4) * w1 + load(state, 7) * w2,
        load(state, 2) * w0 + load(state, 5) * w1 + load(state, 8) * w2,
    )


@inlined
def _turn(state: Array, frame: Frame) -> tuple[Lanes, Lanes, Lanes]:
    """2 sin(θ/2) times the axis of the rotation from the tip to the target, in the base.

    The skew part of R = R_target R_tipᵀ is sin θ times the axis. Near 180° it vanishes, and the axis is read from a
    column of the symmetric part instead, I cos θ + (1 - cos θ) a aᵀ.
    """
    t = (
        load(state, 0), load(state, 1), load(state, 2), load(state, 3), load(state, 4), load(state, 5),
        load(state, 6), load(state, 7), load(state, 8),
    )  # fmt: skip
    m00 = t[0] * frame[0] + t[1] * frame[1] + t[2] * frame[2]
    m01 = t[0] * frame[3] + t[1] * frame[4] + t[2] * frame[5]
    m02 = t[0] * frame[6] + t[1] * frame[7] + t[2] * frame[8]
    m10 = t[3] * frame[0] + t[4] * frame[1] + t[5] * frame[2]
    m11 = t[3] * frame[3] + t[4] * frame[4] + t[5] * frame[5]
    m12 = t[3] * frame[6] + t[4] * frame[7] + t[5] * frame[8]
    m20 = t[6] * frame[0] + t[7] * frame[1] + t[8] * frame[2]
    m21 = t[6] * frame[3] + t[7] * frame[4] + t[8] * frame[5]
    m22 = t[6] * frame[6] + t[7] * frame[7] + t[8] * frame[8]
    cosine_squared = 0.25 * (1.0 + m00 + m11 + m22)
    scale = 0.5 / sqrt_lanes(max_lanes(cosine_squared, 1e-6))
    w0, w1, w2 = scale * (m21 - m12), scale * (m02 - m20), scale * (m10 - m01)
    reversed_ = cosine_squared < 1e-4
    if bits(reversed_):
        c = 2.0 * cosine_squared - 1.0
        first, second = (m00 >= m11) & (m00 >= m22), m11 >= m22
        s01, s02, s12 = 0.5 * (m01 + m10), 0.5 * (m02 + m20), 0.5 * (m12 + m21)
        a0 = where(first, m00 - c, where(second, s01, s02))
        a1 = where(first, s01, where(second, m11 - c, s12))
        a2 = where(first, s02, where(second, s12, m22 - c))
        length = 2.0 * sqrt_lanes(1.0 - cosine_squared) / sqrt_lanes(a0 * a0 + a1 * a1 + a2 * a2)
        length = where(a0 * w0 + a1 * w1 + a2 * w2 < 0.0, -length, length)
        w0 = where(reversed_, length * a0, w0)
        w1 = where(reversed_, length * a1, w1)
        w2 = where(reversed_, length * a2, w2)
    return w0, w1, w2


@inlined
def _swing(state: Array, frame: Frame, axis: int) -> tuple[Lanes, Lanes, Lanes]:
    """2 sin(θ/2) times the axis of the shortest rotation of one axis of the tip onto the target's, in the base."""
    t0, t1, t2 = load(state, axis), load(state, axis + 3), load(state, axis + 6)
    a0, a1, a2 = frame[axis], frame[axis + 3], frame[axis + 6]
    cosine_squared = 0.5 * (1.0 + a0 * t0 + a1 * t1 + a2 * t2)
    scale = 1.0 / sqrt_lanes(max_lanes(cosine_squared, 1e-6))
    w0, w1, w2 = scale * (a1 * t2 - a2 * t1), scale * (a2 * t0 - a0 * t2), scale * (a0 * t1 - a1 * t0)
    reversed_ = cosine_squared < 1e-4
    if bits(reversed_):
        # Any axis square to it will do; the tip's next one is.
        other = (axis + 1) % 3
        w0 = where(reversed_, 2.0 * frame[other], w0)
        w1 = where(reversed_, 2.0 * frame[other + 3], w1)
        w2 = where(reversed_, 2.0 * frame[other + 6], w2)
    return w0, w1, w2


@inlined
def _descend(goal: Goal, work: _Work, e: _Error, damping: Lanes, keep: Lanes, most: float) -> None:
    """Step q by Jᵀ(JJᵀ + λI)⁻¹e within the bounds and let `previous` be q; where `keep` is 0, take `previous` back.

    No joint steps further than `most`.
    """
    J, n = work.J, len(work.J) // (6 * LANES)
    x0, x1, x2, x3, x4, x5 = _solve(_normal_matrix(goal, work, e, damping), e)
    longest = lanes(most)
    for j in range(n):
        c0, c1, c2 = load(J, 6 * j), load(J, 6 * j + 1), load(J, 6 * j + 2)
        c3, c4, c5 = load(J, 6 * j + 3), load(J, 6 * j + 4), load(J, 6 * j + 5)
        step = c0 * x0 + c1 * x1 + c2 * x2 + c3 * x3 + c4 * x4 + c5 * x5
        longest = max_lanes(longest, abs_lanes(step))
        store(J, 6 * j, step)
    scale = most / longest
    kept = keep > 0.5
    for j in range(n):
        q, before = load(work.q, j), load(work.previous, j)
        after = min_lanes(max_lanes(q + scale * load(J, 6 * j), goal.bounds[0, j]), goal.bounds[1, j])
        store(work.q, j, where(kept, after, before))
        store(work.previous, j, where(kept, q, before))


@inlined
def _normal_matrix(goal: Goal, work: _Work, e: _Error, damping: Lanes) -> _Symmetric:
    """JJᵀ + λI, lower triangle row by row; in `J` the column of each variable that is blocked becomes zero."""
    J, bounds = work.J, goal.bounds
    n = len(J) // (6 * LANES)
    e0, e1, e2, e3, e4, e5 = e
    a00, a11, a22, a33, a44, a55 = damping, damping, damping, damping, damping, damping
    o = lanes(0.0)
    a10, a20, a21, a30, a31, a32, a40, a41, a42, a43 = o, o, o, o, o, o, o, o, o, o
    a50, a51, a52, a53, a54 = o, o, o, o, o
    for j in range(n):
        c0, c1, c2 = load(J, 6 * j), load(J, 6 * j + 1), load(J, 6 * j + 2)
        c3, c4, c5 = load(J, 6 * j + 3), load(J, 6 * j + 4), load(J, 6 * j + 5)
        if bounds[0, j] > -np.inf or bounds[1, j] < np.inf:
            slope = c0 * e0 + c1 * e1 + c2 * e2 + c3 * e3 + c4 * e4 + c5 * e5
            q = load(work.q, j)
            free = where(((q <= bounds[0, j]) & (slope < 0.0)) | ((q >= bounds[1, j]) & (slope > 0.0)), 0.0, 1.0)
            c0, c1, c2, c3, c4, c5 = free * c0, free * c1, free * c2, free * c3, free * c4, free * c5
            store(J, 6 * j, c0)
            store(J, 6 * j + 1, c1)
            store(J, 6 * j + 2, c2)
            store(J, 6 * j + 3, c3)
            store(J, 6 * j + 4, c4)
            store(J, 6 * j + 5, c5)
        a00, a10, a11 = a00 + c0 * c0, a10 + c1 * c0, a11 + c1 * c1
        a20, a21, a22 = a20 + c2 * c0, a21 + c2 * c1, a22 + c2 * c2
        a30, a31, a32, a33 = a30 + c3 * c0, a31 + c3 * c1, a32 + c3 * c2, a33 + c3 * c3
        a40, a41, a42, a43, a44 = a40 + c4 * c0, a41 + c4 * c1, a42 + c4 * c2, a43 + c4 * c3, a44 + c4 * c4
        a50, a51, a52 = a50 + c5 * c0, a51 + c5 * c1, a52 + c5 * c2
        a53, a54, a55 = a53 + c5 * c3, a54 + c5 * c4, a55 + c5 * c5
    return (
        a00, a10, a11, a20, a21, a22, a30, a31, a32, a33, a40, a41, a42, a43, a44, a50, a51, a52, a53, a54, a55,
    )  # fmt: skip


@inlined
def _solve(a: _Symmetric, e: _Error) -> _Error:
    """Solve A x = e by A = L D Lᵀ; i_k is 1/d_k, and m_jk is l_jk d_k."""
    a00, a10, a11, a20, a21, a22, a30, a31, a32, a33, a40, a41, a42, a43, a44, a50, a51, a52, a53, a54, a55 = a
    e0, e1, e2, e3, e4, e5 = e
    i0 = 1.0 / a00
    l10, l20, l30, l40, l50 = a10 * i0, a20 * i0, a30 * i0, a40 * i0, a50 * i0
    i1 = 1.0 / (a11 - l10 * a10)
    m21, m31, m41, m51 = a21 - l20 * a10, a31 - l30 * a10, a41 - l40 * a10, a51 - l50 * a10
    l21, l31, l41, l51 = m21 * i1, m31 * i1, m41 * i1, m51 * i1
    i2 = 1.0 / (a22 - l20 * a20 - l21 * m21)
    m32, m42, m52 = a32 - l30 * a20 - l31 * m21, a42 - l40 * a20 - l41 * m21, a52 - l50 * a20 - l51 * m21
    l32, l42, l52 = m32 * i2, m42 * i2, m52 * i2
    i3 = 1.0 / (a33 - l30 * a30 - l31 * m31 - l32 * m32)
    m43, m53 = a43 - l40 * a30 - l41 * m31 - l42 * m32, a53 - l50 * a30 - l51 * m31 - l52 * m32
    l43, l53 = m43 * i3, m53 * i3
    i4 = 1.0 / (a44 - l40 * a40 - l41 * m41 - l42 * m42 - l43 * m43)
    m54 = a54 - l50 * a40 - l51 * m41 - l52 * m42 - l53 * m43
    l54 = m54 * i4
    i5 = 1.0 / (a55 - l50 * a50 - l51 * m51 - l52 * m52 - l53 * m53 - l54 * m54)
    y1 = e1 - l10 * e0
    y2 = e2 - l20 * e0 - l21 * y1
    y3 = e3 - l30 * e0 - l31 * y1 - l32 * y2
    y4 = e4 - l40 * e0 - l41 * y1 - l42 * y2 - l43 * y3
    y5 = e5 - l50 * e0 - l51 * y1 - l52 * y2 - l53 * y3 - l54 * y4
    x5 = y5 * i5
    x4 = y4 * i4 - l54 * x5
    x3 = y3 * i3 - l43 * x4 - l53 * x5
    x2 = y2 * i2 - l32 * x3 - l42 * x4 - l52 * x5
    x1 = y1 * i1 - l21 * x2 - l31 * x3 - l41 * x4 - l51 * x5
    x0 = e0 * i0 - l10 * x1 - l20 * x2 - l30 * x3 - l40 * x4 - l50 * x5
    return x0, x1, x2, x3, x4, x5
