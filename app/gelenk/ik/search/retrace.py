"""Step-by-step repetition of the search for a trace: its kernels in NumPy, one configuration at a time."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from gelenk.ik.search.descent import blocked, damped_step, error_damping, iterate, shortened, stop_reason
from gelenk.ik.search.kernels import APPROACHES, CAREFUL_STEP, CLOSE, FLOOR, LONGEST, LONGEST_STEP
from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.words import Iterate, IterationPath
from gelenk.robot.arrays import Array

_Linearised: TypeAlias = Callable[[Array], tuple[Array, Array]]
_Seen: TypeAlias = Callable[[Array, Array], tuple[Array, Array]]
_Steps: TypeAlias = Iterator[tuple[Array, Array, Array, Array]]
"""Configuration, error, Jacobian, and the step taken from there."""


def retrace(problem: TargetProblem, i: int, start: Array, followed: int, slack: float = 0.0) -> IterationPath:
    """Trace one start of the search for target i until it is within the tolerances or given up.

    For `followed` see `Found`; `slack` is the share of the tolerances that the search subtracted from the errors.
    """
    bounds, task, tolerances = problem.bounds[:2], problem.task, problem.tolerances

    def at(q: Array) -> tuple[Array, Array]:
        es, Js = linearise(problem.chain, problem.target(i), q[None], task, chords=True)
        return es[0], Js[0]

    def shortened_error(e: Array, J: Array) -> tuple[Array, Array]:
        """Shorten the error and scale the Jacobian, as the search does to use loose tolerances."""
        parts = zip((e[: task.positions], e[task.positions :]), tolerances, strict=True)
        factors = [
            max(0.0, 1.0 - slack * allowed / max(float(np.linalg.norm(part)), 1e-150)) for part, allowed in parts
        ]
        scale = np.repeat(factors, (task.positions, len(task) - task.positions))
        return scale * e, scale[:, None] * J

    if followed < 0:
        steps = _searched(at, start, bounds, shortened_error)
    else:
        steps = _followed(at, start, bounds, 0.1**followed)
    trace: list[Iterate] = []
    reached = False
    for q, e, J, step in steps:
        sigmas = np.linalg.svd(J, compute_uv=False).astype(np.float64)
        reason = stop_reason(e, J, sigmas, q, bounds, "damped_least_squares", problem)
        # After convergence the search takes one more step, unless the error is small enough already.
        on = reason == "converged" and not reached and not _is_close(e, task.positions, tolerances)
        reached = reason == "converged"
        # Its angles are chords; the trace has the error that the course's methods measure.
        error = float(np.linalg.norm(problem.linearised(i, q[None])[0]))
        following = np.clip(q + step, *bounds) if reason is None or on else None
        trace.append(iterate(error, sigmas, q, following, "damped_least_squares"))
        if reason is not None and not on:
            return IterationPath(reason, trace)
    trace[-1] = replace(trace[-1], step_length=None, method=None)
    return IterationPath("converged" if reached else "iterations", trace)


def _is_close(e: Array, linear: int, tolerances: tuple[float, float]) -> bool:
    """Check whether an error is so far within the tolerances that the search takes no further step."""
    parts = np.linalg.norm(e[:linear]), np.linalg.norm(e[linear:])
    return all(part <= CLOSE * tolerance for part, tolerance in zip(parts, tolerances, strict=True))


def _searched(at: _Linearised, q: Array, bounds: Array, seen: _Seen) -> _Steps:
    """Yield the steps of a search: damping proportional to the squared error, no step undone."""
    for _ in range(LONGEST):
        e, J = at(q)
        f, K = seen(e, J)
        step = shortened(damped_step(_unblocked(K, f, q, bounds), f, error_damping(f)), LONGEST_STEP)
        yield q, e, J, step
        q = np.clip(q + step, *bounds)


def _followed(at: _Linearised, q: Array, bounds: Array, damping: float) -> _Steps:
    """Yield small steps with adaptive damping; steps that increase the error are undone and not reported."""
    least, before = np.inf, q
    for _ in range(APPROACHES):
        e, J = at(q)
        error = float(e @ e)
        if error <= least:
            least, before, damping = error, q, max(0.25 * damping, FLOOR)
            step = shortened(damped_step(_unblocked(J, e, q, bounds), e, damping), CAREFUL_STEP)
            yield q, e, J, step
            q = np.clip(q + step, *bounds)
        else:
            q, damping = before, min(10.0 * damping, 1e6)


def _unblocked(J: Array, e: Array, q: Array, bounds: Array) -> Array:
    return np.where(blocked(J.T @ e, q, bounds), 0.0, J)
