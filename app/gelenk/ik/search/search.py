"""Damped least squares from many starts for each target: the solver behind `auto`, without its verdicts.

The answer is deterministic: it depends on the chain, the target, the seed and the random seed, not on the rest of the
batch or the number of threads.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gelenk.ik.search import kernels
from gelenk.ik.search.iteration import SOME, Goal
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import clock
from gelenk.robot.poses import Poses

MAX_ITERATIONS = 20_000
"""Default budget for a target: the hardest of 78,000 targets on 39 arms needed an eighth of it."""
ITERATIONS_PER_START = 20
"""Average cost of a start, which converts a budget in iterations to a number of starts."""

_TURN = 2.0 * np.pi
_CHUNK = 128
"""Targets of a seven-joint chain that one thread solves between two checks of the clock."""


@dataclass(frozen=True, slots=True)
class Found:
    """The results of a search, one entry per target.

    Attributes:
        qs: Solutions, within the limits and as near to the seed as full turns allow; for an unsolved target the
            nearest configuration found; shape (N, n), [rad or m].
        solved: Whether the errors are within the tolerances; shape (N,).
        restarts: Number of starts that failed before; shape (N,).
        iterations: Iterations of the start that converged; shape (N,).
        followed: k if the search followed the path from the seed in small steps with initial damping 10⁻ᵏ, else -1;
            shape (N,).
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
        """Replace the results of some targets by those of another search."""
        self.qs[rows], self.solved[rows], self.in_time[rows] = other.qs, other.solved, other.in_time
        self.restarts[rows], self.iterations[rows] = other.restarts, other.iterations
        self.followed[rows], self.slack[rows] = other.followed, other.slack


def nothing_found(count: int, n: int) -> Found:
    """Create results in which no target is solved or tried, with `qs` uninitialised."""
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
    """Solve each target by its first start that converges; start 0 is the seed, the others are random.

    Args:
        chain: Base and tip.
        targets: Desired T_base_tip; N of them.
        seeds: One configuration for all targets or one each, perhaps outside the limits; shape (1 or N, n).
        task: Which directions count.
        position_tolerance: Largest position error, [m].
        orientation_tolerance: Largest orientation error, [rad].
        respect_limits: Whether solutions must be within the joint limits.
        max_iterations: Budget for each target.
        random_seed: Seed of the random starts.
        slack: Share of the tolerances subtracted from the errors, see `Goal.slack`.
        deadline: When to stop, on `gelenk.robot.compilation.clock`, [s].
        threads: Threads for a large batch; by default one per processor.
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
    """Create the kernels' input; the arguments are those of `search`."""
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
    """Convert an angle θ [rad] to the kernels' chord 2 sin(θ/2); components of it may be as small as 2/π of θ."""
    if task.kind == SOME:
        return tolerance * 2.0 / np.pi
    return float(2.0 * np.sin(0.5 * min(tolerance, np.pi)))


def target_rows(targets: Poses) -> Array:
    """Convert poses to the kernels' rows: rotation row by row, then position [m]; shape (N, 12)."""
    rows = np.empty((len(targets), 12))
    rows[:, :9] = targets.rotations.reshape(-1, 9)
    rows[:, 9:] = targets.positions
    return rows


def start_of(chain: Chain, seed: Array, respect_limits: bool, random_seed: int, start: int) -> Array:
    """Return the initial configuration of a start; shape (n,), [rad or m]."""
    bounds = search_bounds(chain, respect_limits)
    q: Array = np.array(seed, dtype=float)
    if start > 0:
        shares = np.array([kernels.uniform(random_seed, start, j) for j in range(len(chain))])
        q = bounds[2] + shares * (bounds[3] - bounds[2])
    np.clip(q, bounds[0], bounds[1], out=q)
    return q


@lru_cache(maxsize=256)
def mid_range(chain: Chain) -> Array:
    """Middle of the joint limits; the value nearest to 0 if a limit is missing; shape (n,), [rad or m]."""
    lower, upper = chain.lower, chain.upper
    middle = np.zeros(len(chain))
    bounded = np.isfinite(lower) & np.isfinite(upper)
    middle[bounded] = 0.5 * (lower[bounded] + upper[bounded])
    middle = np.where(np.isfinite(lower) & ~bounded, np.maximum(lower, 0.0), middle)
    return np.where(np.isfinite(upper) & ~bounded, np.minimum(upper, 0.0), middle)


@lru_cache(maxsize=256)
def limits_of(chain: Chain, respect_limits: bool) -> tuple[Array, Array]:
    """Lower and upper limits of the variables, infinite if they are not respected; shape (n,) each, [rad or m]."""
    if respect_limits:
        return chain.lower, chain.upper
    return np.full(len(chain), -np.inf), np.full(len(chain), np.inf)


@lru_cache(maxsize=256)
def free_variables(chain: Chain) -> Flags:
    """Flag the variables whose full turn leaves the pose unchanged: revolute, with integer gear ratios; shape (n,)."""
    free = np.ones(len(chain), dtype=bool)
    for (prismatic, variable), (multiplier, _) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        if prismatic or multiplier != np.rint(multiplier):
            free[variable] = False
    return free


@lru_cache(maxsize=256)
def search_bounds(chain: Chain, respect_limits: bool) -> Array:
    """Compute `Goal.bounds`; shape (6, n), [rad or m].

    A joint whose limits are a full turn or more apart turns freely, and is wound back into them at the end.
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
    """Half-width of the interval from which starts of a variable without limits are drawn; shape (n,), [rad or m].

    Half a turn of the slowest joint it drives, or the total length of the chain's constant parts, at least a metre.
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
    """Search a large batch piece by piece in threads; targets that are never tried keep `untried`."""
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
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


def is_over(deadline: float | None) -> bool:
    """Check whether the deadline has passed."""
    return deadline is not None and clock() > deadline


def chunk_of(chain: Chain) -> int:
    """Number of targets in a piece of work, which takes at most a tenth of a second even if none can be solved."""
    return max(1, _CHUNK * 7 // max(7, len(chain)))


def pieces(count: int, threads: int, chunk: int, small: bool) -> Iterator[slice]:
    """Split a batch into a few pieces per thread, or into small ones if the clock is checked between them."""
    size = chunk if small else max(chunk, -(-count // (4 * threads)))
    return (slice(first, min(first + size, count)) for first in range(0, count, size))


def shared(work: Callable[[slice], None], parts: Iterator[slice], threads: int) -> None:
    """Run the parts of a batch in a number of threads."""
    if threads == 1:
        for part in parts:
            work(part)
    else:
        list(_pool(threads).map(work, parts))


@lru_cache(maxsize=1)
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="search")
