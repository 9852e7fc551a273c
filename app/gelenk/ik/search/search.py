"""Damped least squares from many starts for each target: the solver behind `auto`, without its verdicts.

The answer is deterministic: it depends on the chain, the target, the seed and the random seed, not on the rest of the
batch or the number of threads.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, fields, replace
from functools import lru_cache

import numpy as np

from gelenk.ik.search import kernels
from gelenk.ik.search.bounds import target_rows
from gelenk.ik.search.problem import TargetProblem
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain

MAX_ITERATIONS = 20_000
"""Default budget for a target: the hardest of 78,000 targets on 39 arms needed an eighth of it."""
ITERATIONS_PER_START = 20
"""Average cost of a start, which converts a budget in iterations to a number of starts."""

_threads: ContextVar[int | None] = ContextVar("threads", default=None)
_CHUNK = 128
"""Targets of a seven-joint chain that one thread solves between two checks of the clock."""


@dataclass(frozen=True, slots=True)
class Found:
    """The results of a search, one entry per target.

    Attributes:
        qs: Solutions, within the limits and as near to the seed as full turns allow; for an unsolved target the
            nearest configuration found; shape (N, n), [rad or m].
        solved: Whether the errors are within the tolerances; shape (N,).
        restarts, iterations: Starts that failed before, and iterations of the one that converged; shape (N,) each.
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
        for column in fields(self):
            getattr(self, column.name)[rows] = getattr(other, column.name)


def nothing_found(count: int, n: int) -> Found:
    """Create results in which no target is solved or tried, with `qs` uninitialised."""
    flags, integers = np.zeros((2, count), dtype=bool), np.zeros((3, count), dtype=np.int64)
    return Found(np.empty((count, n)), flags[0], integers[0], integers[1], integers[2], flags[1], np.zeros(count))


def search(
    problem: TargetProblem, max_iterations: int = MAX_ITERATIONS, slack: float = 0.0, threads: int | None = None
) -> Found:
    """Solve each target by its first start that converges; start 0 is the seed, the others are random.

    Seeds may be outside the limits. The iterations are for each target, the slack is that of `Goal`. A large batch is
    shared between threads, by default one per processor.
    """
    chain, seeds, count = problem.chain, problem.seeds, len(problem)
    goal = problem.goal(max(1, max_iterations // ITERATIONS_PER_START), slack)
    rows, found, winners = target_rows(problem.targets), nothing_found(count, len(chain)), np.full(count, -1)
    # Targets that are never tried keep their seed.
    found.qs[:], found.slack[:] = np.clip(seeds, *problem.limits), slack

    def solve(part: slice) -> None:
        if not problem.is_over:
            own = seeds[part] if len(seeds) > 1 else seeds
            outcome = kernels.search(chain.flat, goal, rows[part], own)
            found.qs[part], winners[part], found.iterations[part], found.followed[part] = outcome
            found.in_time[part] = True

    in_pieces(solve, count, chunk_of(chain), problem.deadline is not None, threads)
    return replace(found, solved=winners >= 0, restarts=np.maximum(winners, 0))


def start_of(problem: TargetProblem, i: int, start: int) -> Array:
    """Return the initial configuration of a start for a target; shape (n,), [rad or m]."""
    bounds, q = problem.bounds, problem.seed(i)
    if start > 0:
        shares = np.array([kernels.uniform(problem.options.random_seed, start, j) for j in range(len(q))])
        q = bounds[2] + shares * (bounds[3] - bounds[2])
    return np.asarray(np.clip(q, bounds[0], bounds[1]))


def processors() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


def chunk_of(chain: Chain) -> int:
    """Number of targets in a piece of work, which takes at most a tenth of a second even if none can be solved."""
    return max(1, _CHUNK * 7 // max(7, len(chain)))


@contextmanager
def in_one_thread() -> Iterator[None]:
    """Let batches in this context share one thread: other processes work on others at the same time.

    On processors that are all busy, more threads take a quarter more of their time for the same work.
    """
    token = _threads.set(1)
    try:
        yield
    finally:
        _threads.reset(token)


def in_pieces(work: Callable[[slice], None], count: int, chunk: int, small: bool, threads: int | None = None) -> None:
    """Work on a batch in threads: a few pieces for each, or small ones if the clock is checked between them."""
    if count <= chunk:
        work(slice(0, count))
        return
    threads = threads or _threads.get() or processors()
    size = chunk if small else max(chunk, -(-count // (4 * threads)))
    parts = [slice(first, min(first + size, count)) for first in range(0, count, size)]
    for _ in map(work, parts) if threads == 1 else _pool(threads).map(work, parts):
        pass


@lru_cache(maxsize=1)
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="search")
