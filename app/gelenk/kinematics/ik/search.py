"""Many starts of damped least squares for each target: the solver behind `auto`, without its verdicts.

The answer is deterministic: it depends on the chain, the target, the seed and the random seed, not on the batch it
comes in, nor on the number of threads.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gelenk.kinematics.ik import kernels
from gelenk.kinematics.ik.iteration import SOME, Goal
from gelenk.kinematics.ik.task import FULL_POSE, Task
from gelenk.model.arrays import Array, Flags, Indices
from gelenk.model.chain import Chain
from gelenk.model.compilation import clock
from gelenk.model.poses import Poses

MAX_ITERATIONS = 20_000
"""Default budget for a target: of 78,000 targets on 39 arms the hardest needed an eighth of it."""
ITERATIONS_PER_START = 20
"""What a start costs on average, so that a budget in iterations becomes a number of starts."""

_TURN = 2.0 * np.pi
_CHUNK = 128
"""Targets of seven joints that one thread takes at once; the clock is checked before the next."""


@dataclass(frozen=True, slots=True)
class Found:
    """The results of a search, one entry a target.

    Attributes:
        qs: The solution, within the limits and as near to the seed as full turns allow; of an unsolved target the
            nearest that was found; shape (N, n), [rad or m].
        solved: Whether the errors are within the tolerances; shape (N,).
        restarts: How many starts failed before; shape (N,).
        iterations: Of the start that converged; shape (N,).
        followed: Where the seed had to be followed closely: by how many powers of ten the damping began below 1, else
            -1; shape (N,).
        in_time: Whether the target was tried before time ran out; shape (N,).
        slack: See `Goal.slack`; shape (N,).
    """

    qs: Array
    solved: Flags
    restarts: Indices
    iterations: Indices
    followed: Indices
    in_time: Flags
    slack: Array

    def put(self, rows: Flags, other: "Found") -> None:
        """Put what another search found of some targets in the place of what was found before."""
        self.qs[rows], self.solved[rows], self.in_time[rows] = other.qs, other.solved, other.in_time
        self.restarts[rows], self.iterations[rows] = other.restarts, other.iterations
        self.followed[rows], self.slack[rows] = other.followed, other.slack


def nothing_found(count: int, n: int) -> Found:
    """No answer yet to so many targets of a chain with n variables."""
    flags, integers = np.zeros((2, count), dtype=bool), np.zeros((3, count), dtype=np.int64)
    return Found(np.empty((count, n)), flags[0], integers[0], integers[1], integers[2], flags[1], np.zeros(count))


def search(
    chain: Chain,
    targets: Poses,
    seeds: Array,
    *,
    task: Task = FULL_POSE,
    position_tolerance: float = 1e-6,
    orientation_tolerance: float = 1e-6,
    respect_limits: bool = True,
    max_iterations: int = MAX_ITERATIONS,
    random_seed: int = 0,
    slack: float = 0.0,
    deadline: float | None = None,
    threads: int | None = None,
) -> Found:
    """Solve each target by the first of its starts that converges; start 0 is the seed, the others are random.

    Args:
        chain: Base and tip.
        targets: T_base_tip wanted, N of them.
        seeds: One configuration for all or one each, not necessarily within the limits; shape (1 or N, n).
        task: Which directions count.
        position_tolerance: [m].
        orientation_tolerance: [rad].
        respect_limits: Whether a solution is to be within the joint limits.
        max_iterations: Budget for each target.
        random_seed: Of the starts.
        slack: Share of the tolerances that errors are made smaller by, see `Goal.slack`.
        deadline: When to stop, on `gelenk.model.compilation.clock`, [s].
        threads: How many share a large batch; by default as many as there are processors.
    """
    goal = make_goal(
        chain, task, position_tolerance, orientation_tolerance, respect_limits, max_iterations, random_seed, slack
    )
    rows = target_rows(targets)
    if len(rows) <= chunk_of(chain) and not is_over(deadline):
        qs, winners, iterations, followed = kernels.search(chain.flat, goal, rows, seeds)
        tried, slacks = np.ones(len(rows), dtype=bool), np.full(len(rows), slack)
        return Found(qs, winners >= 0, np.maximum(winners, 0), iterations, followed, tried, slacks)
    untried = np.clip(seeds, *limits_of(chain, respect_limits))
    return _in_parts(chain, goal, rows, seeds, untried, deadline, threads or processors())


@lru_cache(maxsize=1024)
def make_goal(
    chain: Chain,
    task: Task,
    position_tolerance: float,
    orientation_tolerance: float,
    respect_limits: bool,
    max_iterations: int,
    random_seed: int,
    slack: float = 0.0,
) -> Goal:
    """The input of the kernels; arguments as of `search`."""
    return Goal(
        search_bounds(chain, respect_limits),
        task.weights,
        task.kind,
        task.axis,
        position_tolerance,
        _chord(orientation_tolerance, task),
        slack,
        max(1, max_iterations // ITERATIONS_PER_START),
        random_seed,
    )


def _chord(tolerance: float, task: Task) -> float:
    """A tolerance as the kernels measure it: 2 sin(θ/2), of which some components may be as little as 2/π of θ."""
    if task.kind == SOME:
        return tolerance * 2.0 / np.pi
    return float(2.0 * np.sin(0.5 * min(tolerance, np.pi)))


def target_rows(targets: Poses) -> Array:
    """Poses as the kernels take them: rotation row by row, then position; shape (N, 12)."""
    rows = np.empty((len(targets), 12))
    rows[:, :9] = targets.rotations.reshape(-1, 9)
    rows[:, 9:] = targets.positions
    return rows


def start_of(chain: Chain, seed: Array, respect_limits: bool, random_seed: int, start: int) -> Array:
    """The configuration from which a start sets out; shape (n,)."""
    bounds = search_bounds(chain, respect_limits)
    q: Array = np.array(seed, dtype=float)
    if start > 0:
        shares = np.array([kernels.uniform(random_seed, start, j) for j in range(len(chain))])
        q = bounds[2] + shares * (bounds[3] - bounds[2])
    np.clip(q, bounds[0], bounds[1], out=q)
    return q


@lru_cache(maxsize=256)
def mid_range(chain: Chain) -> Array:
    """The middle of the joint limits, 0 where a joint turns without end; shape (n,), [rad or m]."""
    lower, upper = chain.lower, chain.upper
    middle = np.zeros(len(chain))
    bounded = np.isfinite(lower) & np.isfinite(upper)
    middle[bounded] = 0.5 * (lower[bounded] + upper[bounded])
    middle = np.where(np.isfinite(lower) & ~bounded, np.maximum(lower, 0.0), middle)
    return np.where(np.isfinite(upper) & ~bounded, np.minimum(upper, 0.0), middle)


@lru_cache(maxsize=256)
def limits_of(chain: Chain, respect_limits: bool) -> tuple[Array, Array]:
    """Lower and upper limit of each variable, infinite where none are to be respected; shape (n,) each."""
    if respect_limits:
        return chain.lower, chain.upper
    return np.full(len(chain), -np.inf), np.full(len(chain), np.inf)


@lru_cache(maxsize=256)
def free_variables(chain: Chain) -> Flags:
    """Which variables come to the same pose after a full turn: joints that turn, geared 1:1 or by whole numbers."""
    free = np.ones(len(chain), dtype=bool)
    for (prismatic, variable), (multiplier, _) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        if prismatic or multiplier != np.rint(multiplier):
            free[variable] = False
    return free


@lru_cache(maxsize=256)
def search_bounds(chain: Chain, respect_limits: bool) -> Array:
    """See `Goal.bounds`.

    A joint with a full turn or more between its limits turns freely, and is wound back at the end.
    """
    n = len(chain)
    lower, upper = limits_of(chain, respect_limits)
    free = free_variables(chain) & (upper - lower >= _TURN)
    spread = _spreads(chain)
    middle = mid_range(chain)
    bounds = np.empty((6, n))
    bounds[0], bounds[1] = np.where(free, -np.inf, lower), np.where(free, np.inf, upper)
    bounds[2] = np.where(free, -np.pi, np.where(np.isfinite(lower), lower, middle - spread))
    bounds[3] = np.where(free, np.pi, np.where(np.isfinite(upper), upper, middle + spread))
    bounds[4], bounds[5] = np.where(free, lower, np.nan), np.where(free, upper, np.nan)
    return bounds


def _spreads(chain: Chain) -> Array:
    """How far from its middle a variable without limits is drawn; shape (n,), [rad or m].

    Half a turn of what it turns slowest, or a slide as long as the chain's constant parts, at least a metre.
    """
    length = max(1.0, float(np.linalg.norm(chain.flat.placements[:, 9:], axis=1).sum()))
    spreads = np.zeros(len(chain))
    for (prismatic, variable), (multiplier, _) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        spread = (length if prismatic else np.pi) / max(abs(multiplier), 1e-3)
        spreads[variable] = max(spreads[variable], spread)
    return spreads


def _in_parts(
    chain: Chain, goal: Goal, rows: Array, seeds: Array, untried: Array, deadline: float | None, threads: int
) -> Found:
    """A large batch, shared by threads and in pieces where time is limited; targets never tried keep `untried`."""
    count, n = len(rows), len(chain)
    qs, winners, iterations, followed = np.empty((count, n)), *np.full((3, count), -1)
    in_time = np.zeros(count, dtype=bool)
    qs[:] = untried

    def solve(part: slice) -> None:
        if is_over(deadline):
            return
        own = seeds[part] if len(seeds) > 1 else seeds
        qs[part], winners[part], iterations[part], followed[part] = kernels.search(chain.flat, goal, rows[part], own)
        in_time[part] = True

    shared(solve, pieces(count, threads, chunk_of(chain), deadline is not None), threads)
    return Found(qs, winners >= 0, np.maximum(winners, 0), iterations, followed, in_time, np.full(count, goal.slack))


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0))


def is_over(deadline: float | None) -> bool:
    """Whether time has run out."""
    return deadline is not None and clock() > deadline


def chunk_of(chain: Chain) -> int:
    """Targets that one thread takes at once; a tenth of a second even if none of them can be solved."""
    return max(1, _CHUNK * 7 // max(7, len(chain)))


def pieces(count: int, threads: int, chunk: int, small: bool) -> Iterator[slice]:
    """A batch in pieces: a few for each thread, or many small ones to look at the clock between them."""
    size = chunk if small else max(chunk, -(-count // (4 * threads)))
    return (slice(first, min(first + size, count)) for first in range(0, count, size))


def shared(work: Callable[[slice], None], parts: Iterator[slice], threads: int) -> None:
    """Do the parts of a batch, in so many threads."""
    if threads == 1:
        for part in parts:
            work(part)
    else:
        list(_pool(threads).map(work, parts))


@lru_cache(maxsize=1)
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="search")
