"""Use of the freedom that a task leaves: motion along the self-motion that minimises an objective."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.descent import blocked
from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.problem import Objective, TargetProblem
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.kinematics.simd.kernels import chain_hessians
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses

_TOGETHER = 4096
"""Solutions moved along their self-motion at once: each needs its own Hessian."""
_ROUNDS = 80
_LONGEST_STEP = 0.2
"""Largest joint step in a round, [rad or m]."""
_PASSES = 8
"""Number of passes that look for joints at their limits."""
_AT_LIMIT = 1e-6
"""Distance from a limit that counts as at it, [rad or m]."""


def settled(problem: TargetProblem, qs: Array, rows: Flags, touching: Callable[[Array], Flags] | None = None) -> Array:
    """Move the solutions of some targets by the objective of the problem, see `settle`; shape (N, n)."""
    objective, settled = problem.options.objective, qs.copy()
    if objective is None:
        return settled
    if objective.name == "posture" and objective.posture is None:
        objective = replace(objective, posture=problem.seeds)
    posture = objective.posture
    for first in range(0, len(qs), _TOGETHER):
        some, own = first + np.flatnonzero(rows[first : first + _TOGETHER]), objective
        if posture is not None and posture.ndim == 2 and len(posture) > 1:
            own = replace(objective, posture=posture[some])
        settled[some] = settle(problem.taken(some), qs[some], own, touching)
    return settled


def settle(
    problem: TargetProblem, qs: Array, objective: Objective, touching: Callable[[Array], Flags] | None = None
) -> Array:
    """Move solutions, one per target, along their self-motion to a nearby minimum of an objective; shape (N, n).

    Each round steps down the gradient projected onto the kernel of J, and brings the error back to zero by damped
    steps, both without joints blocked at a limit. It is kept if the objective has fallen [Liegeois1977], so that no
    solution becomes worse, and only if nothing is `touching` there. A solution without freedom stays unchanged.
    """
    chain, targets, task = problem.chain, problem.targets, problem.task
    bounds = problem.limits
    best = qs.copy()
    values = _value(chain, targets, best, objective, task)
    sizes = np.full(len(qs), 0.5)
    moving = np.ones(len(qs), dtype=bool)
    for _ in range(_ROUNDS):
        if problem.is_over:
            break
        steps = _projected_gradient(chain, targets, best, objective, task, bounds)
        steps *= -sizes[:, None]
        longest = np.abs(steps).max(axis=1, initial=0.0)
        steps /= np.maximum(1.0, longest / _LONGEST_STEP)[:, None]
        # Stop each solution separately: its result must not depend on the rest of the batch.
        moving &= longest >= 1e-9
        if not moving.any():
            break
        trial, errors = _corrected(chain, targets, _up_to_limits(best, steps, bounds), task, bounds)
        after = _value(chain, targets, trial, objective, task)
        better = moving & (after < values) & (errors < 1e-10)
        if touching is not None:
            better[better] = ~touching(trial[better])
        best[better], values[better] = trial[better], after[better]
        sizes = np.where(better, 1.5 * sizes, 0.3 * sizes)
    return best


def _up_to_limits(qs: Array, steps: Array, bounds: Array) -> Array:
    """Move each configuration along its step as far as the first limit it meets; shape (N, n).

    Clipping joint by joint would bend the step away from the self-motion.
    """
    room = np.where(steps > 0.0, bounds[1] - qs, qs - bounds[0])
    shares = np.where(np.abs(steps) > 0.0, room / np.maximum(np.abs(steps), 1e-300), np.inf)
    shares = np.minimum(1.0, np.maximum(shares, 0.0).min(axis=1, initial=1.0))
    inside: Array = np.clip(qs + shares[:, None] * steps, *bounds)
    return inside


def _corrected(chain: Chain, targets: Poses, qs: Array, task: Task, bounds: Array) -> tuple[Array, Array]:
    """Bring configurations back onto their targets; return them and the remaining errors; shapes (N, n), (N,)."""
    for _ in range(4):
        es, Js = linearise(chain, targets, qs, task)
        qs = np.clip(qs + _damped(_unblocked(Js, es, qs, bounds), es), *bounds)
    return qs, np.linalg.norm(linearise(chain, targets, qs, task)[0], axis=1)


def _damped(Js: Array, es: Array) -> Array:
    """Damped steps Jᵀ(JJᵀ + λI)⁻¹e; shape (N, n)."""
    grams = Js @ Js.transpose(0, 2, 1)
    # In proportion to JJᵀ, to keep the matrix regular whatever the size of the arm.
    floor = 1e-12 * np.trace(grams, axis1=1, axis2=2) + 1e-300
    grams += floor[:, None, None] * np.eye(Js.shape[1])
    steps: Array = (Js.transpose(0, 2, 1) @ np.linalg.solve(grams, es[:, :, None]))[:, :, 0]
    return steps


def _unblocked(Js: Array, es: Array, qs: Array, bounds: Array) -> Array:
    """J with zero columns for joints at a bound that the step would push further; shape (N, m, n)."""
    slopes = np.einsum("bmi,bm->bi", Js, es)
    return np.asarray(np.where(blocked(slopes, qs, bounds)[:, None, :], 0.0, Js))


def _projected_gradient(
    chain: Chain, targets: Poses, qs: Array, objective: Objective, task: Task, bounds: Array
) -> Array:
    """Project the gradient onto the kernel of J, without joints at a limit that its descent would push further.

    Fixing one joint changes the projection for the others, so the joints to fix are found in several passes.
    """
    gradients = objective_gradients(chain, targets, qs, objective, task)
    Js = linearise(chain, targets, qs, task)[1]
    free = np.ones(qs.shape, dtype=bool)
    projected, margins = gradients, np.array([[_AT_LIMIT], [-_AT_LIMIT]])
    for _ in range(_PASSES):
        allowed, columns = np.where(free, gradients, 0.0), np.where(free[:, None, :], Js, 0.0)
        projected = np.where(free, allowed - _damped(columns, np.einsum("bmi,bi->bm", columns, allowed)), 0.0)
        outwards = blocked(-projected, qs, bounds + margins)
        if not outwards.any():
            break
        free &= ~outwards
    return np.where(free, projected, 0.0)


def _spans(chain: Chain) -> tuple[Array, Array, Array]:
    """Lower limits, upper limits and 1 / range, which is 0 for a joint that lacks a limit; shape (n,) each."""
    limited = np.isfinite(chain.lower) & np.isfinite(chain.upper) & (chain.upper > chain.lower)
    ranges = np.where(limited, chain.upper, 1.0) - np.where(limited, chain.lower, 0.0)
    return np.where(limited, chain.lower, -1.0), np.where(limited, chain.upper, 1.0), np.where(limited, 1 / ranges, 0.0)


def _value(chain: Chain, targets: Poses, qs: Array, objective: Objective, task: Task) -> Array:
    lower, upper, inverse_ranges = _spans(chain)
    value: Array
    match objective.name:
        case "posture":
            value = 0.5 * np.square(qs - _posture(objective)).sum(axis=1)
        case "mid_range":
            value = 0.5 * np.square((qs - mid_range(chain)) * inverse_ranges).sum(axis=1)
        case "limits":
            limited = inverse_ranges > 0.0
            room = np.maximum((upper - qs) * (qs - lower), 1e-12)[:, limited]
            value = (0.25 / (np.square(inverse_ranges[limited]) * room)).sum(axis=1)
        case "manipulability":
            Js = linearise(chain, targets, qs, task)[1]
            value = -0.5 * np.linalg.slogdet(Js @ Js.transpose(0, 2, 1) + 1e-300 * np.eye(len(task)))[1]
        case "clearance":
            value = -_clearances(objective, qs)[0]
    return value


def objective_gradients(chain: Chain, targets: Poses, qs: Array, objective: Objective, task: Task) -> Array:
    """Compute the gradient of the objective at each configuration; shape (N, n)."""
    lower, upper, inverse_ranges = _spans(chain)
    gradient: Array
    match objective.name:
        case "posture":
            gradient = qs - _posture(objective)
        case "mid_range":
            gradient = (qs - mid_range(chain)) * np.square(inverse_ranges)
        case "limits":
            limited = inverse_ranges > 0.0
            room = np.where(limited, np.maximum((upper - qs) * (qs - lower), 1e-12), 1.0)
            scale = np.where(limited, 0.25 / np.square(np.where(limited, inverse_ranges, 1.0)), 0.0)
            gradient = scale * (2.0 * qs - upper - lower) / np.square(room)
        case "manipulability":
            # ∂ log w/∂q_i = tr((JJᵀ)⁻¹ ∂J/∂q_i Jᵀ)
            Js, Hs = linearise(chain, targets, qs, task)[1], chain_hessians(chain.flat, qs)
            if len(task) < len(DIRECTIONS):
                Hs[:, 3:] = np.einsum("brk,brij->bkij", targets.rotations, Hs[:, 3:])
                Hs = Hs[:, np.flatnonzero(task.weights)]
            inverses = np.linalg.pinv(Js @ Js.transpose(0, 2, 1))
            gradient = -np.einsum("bkl,blji,bkj->bi", inverses, Hs, Js)
        case "clearance":
            gradient = -_clearances(objective, qs)[1]
    return gradient


def _posture(objective: Objective) -> Array:
    if objective.posture is None:
        raise ValueError("the objective `posture` needs a posture")
    return objective.posture


def _clearances(objective: Objective, qs: Array) -> tuple[Array, Array]:
    if objective.clearance is None:
        raise ValueError("the objective `clearance` needs a cell")
    return objective.clearance(qs)
