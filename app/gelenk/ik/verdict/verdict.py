"""Verdicts on unsolved targets: beyond reach, beyond the limits, at a singularity, or merely not found; the nearest."""

import numpy as np

from gelenk.errors import counted, quoted
from gelenk.ik.search.bounds import make_goal, target_rows
from gelenk.ik.search.descent import blocked
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.restarts import solutions_from
from gelenk.ik.search.search import ITERATIONS_PER_START, MAX_ITERATIONS, Found
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS, BlockingJoint, IterationPath, Status, StopReason
from gelenk.ik.verdict.branches import wound_near
from gelenk.ik.verdict.result import UnsolvedTarget
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain

ENOUGH_STARTS = 100
"""Number of failed starts after which a target may count as unreachable rather than unlucky."""
_RELAXED_STARTS = 128
"""Number of starts in the search for a solution beyond the limits."""
_STATIONARY = 1e-3
"""Share of σ_max‖e‖ below which Jᵀe, over the free joints, marks a minimum of the error."""
_LOST = 1e-3
"""Share of σ_max below which the tip counts as unable to follow a direction."""


_STEPS, _HALVINGS = 20, 6
_LONGEST = 0.2
"""Longest step of any joint, [rad or m]."""
_LEVEL, _GAIN = 1e-7, 1e-12
"""Share of ‖J‖‖e‖ below which the gradient counts as zero, and least share of the error that a step must gain."""
_DIFFERENCE, _FLAT = 1e-5, 1e-9
"""Joint step of the finite differences, [rad or m]; least curvature, as a share of the largest."""
_STOPPED: dict[StopReason, tuple[Status, str]] = {
    "stagnated": (
        "singular",
        "stopped {away} away, where the error lies in ker Jᵀ: no motion of the joints makes it smaller",
    ),
    "near_singular": (
        "singular",
        "stopped {away} away, where the Jacobian is singular and Newton's step is not defined",
    ),
    "at_limits": (
        "not_converged",
        "stopped {away} away, where only joints at their limits could reduce the error further: {held}",
    ),
    "diverged": (
        "not_converged",
        "the steps grew without bound: take a smaller step size, or leave it out for a line search",
    ),
    "time_limit": ("not_converged", "{away} away after {after}, when the time limit ended the call"),
    "iterations": ("not_converged", "{away} away after {after}; try another start, method or step size"),
}
"""Verdict and reason by why one method stopped."""
_UNANSWERED = "the time limit ended the call before this target was answered"


def explain(
    problem: TargetProblem, i: int, found: Found, errors: Array, is_too_far: bool, outside: tuple[BlockingJoint, ...]
) -> UnsolvedTarget:
    """Return the verdict on a target that a search from many starts has not solved.

    Args:
        problem: The problem; after its deadline, no further reason is sought.
        errors: Distances [m] and angles [rad] of `found` from the targets; shape (2, N).
        is_too_far: Whether the target is beyond reach by distance alone.
        outside: The joints beyond their limits in a solution without limits, if one was found.
    """
    nearest, tried = found.qs[i], bool(found.in_time[i])
    late = problem.is_over
    directions = None if late or not tried or not len(problem.chain) else unserved_directions(problem, i, nearest)
    joints: tuple[BlockingJoint, ...] = ()
    budget = problem.options.max_iterations or MAX_ITERATIONS
    starts, away = max(1, budget // ITERATIONS_PER_START), _far(problem.task, errors[:, i])
    status: Status = "not_converged"
    reason = f"none of {counted(starts, 'start')} came nearer than {away}"
    reach = problem.reach if is_too_far else None
    if not tried:
        reason = _UNANSWERED
    elif len(problem.chain) == 0:
        status, reason = "unreachable", f"the chain has no joints: its tip stays {away} away"
    elif reach is not None:
        reason = f"{reach.describe(problem.target(i))}; the tip of the nearest pose found is {away} away"
        status = "unreachable"
    elif outside:
        joints = outside
        status, reason = "outside_limits", f"solvable only beyond the joint limits: {_excesses(joints)}"
    elif directions is None:
        reason = (
            f"none of {counted(starts, 'start')} reached it, and the time limit ended the call before the reason was "
            "found"
        )
    elif starts < ENOUGH_STARTS:
        reason += ": allow more iterations"
    else:
        lost = f"{len(directions)} of {counted(len(problem.task), 'direction')}"
        if _is_stationary(problem, i, nearest):
            status, reason = "unreachable", f"{reason}, and from there no motion of the joints leads on"
            reason += f"; the tip cannot follow {lost} there" if len(directions) else ""
        elif len(directions):
            reason = f"the search slowed down {away} from the target, where the Jacobian loses {lost}"
            status = "singular"
        else:
            directions = None
    return UnsolvedTarget(status, reason, nearest, *_pair(errors[:, i]), joints, directions, late or not tried)


def verdict_on_path(
    problem: TargetProblem, i: int, end: Array, errors: Array, path: IterationPath, is_too_far: bool
) -> UnsolvedTarget:
    """Return the verdict on a target that one method from one start has not solved.

    The method's path led to `end`, turned by full turns towards the limits and the seed, shape (n,), [rad or m], with
    these errors, [m] and [rad]; `is_too_far` tells whether the target is beyond reach by distance alone.
    """
    if not path.trace:
        return UnsolvedTarget("not_converged", _UNANSWERED, end, *_pair(errors))
    away = _far(problem.task, errors)
    if is_too_far and (reach := problem.reach):
        status: Status = "unreachable"
        reason = f"{reach.describe(problem.target(i))}; the method stopped {away} away"
    elif path.stop_reason == "converged":
        joints = blocking_joints(problem.chain, end) if problem.options.respect_limits else ()
        if not joints:
            return refused(end, *errors)
        reason = f"converged, but beyond the joint limits: {_excesses(joints)}"
        return UnsolvedTarget("outside_limits", reason, end, *_pair(errors), joints)
    else:
        status, text = _STOPPED[path.stop_reason]
        held = ", ".join(quoted(problem.chain.joint_names[j]) for j in np.flatnonzero(_linearised(problem, i, end)[2]))
        reason = text.format(away=away, after=counted(len(path.trace) - 1, "iteration"), held=held)
    directions = None if status == "not_converged" else unserved_directions(problem, i, end)
    return UnsolvedTarget(status, reason, end, *_pair(errors), unserved_directions=directions)


def polished(problem: TargetProblem, i: int, q: Array) -> Array:
    """Descend from the end of a search to a nearby minimum of the error, never to a larger one; shape (n,).

    Damped least squares ignores the curvature of the error, so it converges slowly where an error remains. Newton's
    method with the full Hessian does not.
    """
    bounds = problem.bounds

    def slopes(qs: Array) -> tuple[Array, Array, Array]:
        """Return ½‖e‖², its gradient -Jᵀe, and ‖J‖‖e‖ to compare that with; shapes (k,), (k, n), (k,)."""
        es, Js = problem.linearised(i, qs)
        sizes = np.linalg.norm(Js, axis=(1, 2)) * np.linalg.norm(es, axis=1)
        return 0.5 * np.sum(es * es, axis=1), -np.einsum("kmn,km->kn", Js, es), sizes

    for _ in range(_STEPS):
        (error,), (slope,), (size,) = slopes(q[None])
        free = ~blocked(-slope, q, bounds)
        if np.linalg.norm(slope[free]) <= _LEVEL * size:
            break
        ahead, behind = (slopes(q + sign * _DIFFERENCE * np.eye(len(q)))[1] for sign in (1.0, -1.0))
        step = _newton(((ahead - behind) / (2.0 * _DIFFERENCE))[np.ix_(free, free)], slope[free])
        full = np.zeros(len(q))
        full[free] = step * min(1.0, _LONGEST / np.abs(step).max())
        tried = np.clip(q + 0.5 ** np.arange(_HALVINGS)[:, None] * full, bounds[0], bounds[1])
        errors = slopes(tried)[0]
        best = int(np.argmin(errors))
        if not errors[best] < error * (1.0 - _GAIN):
            break
        q = tried[best]
    return q


def _newton(second: Array, slope: Array) -> Array:
    """Newton step by absolute eigenvalues, so that it goes downhill even where the Hessian is indefinite."""
    values, vectors = np.linalg.eigh(0.5 * (second + second.T))
    sizes = np.maximum(np.abs(values), _FLAT * np.abs(values).max())
    return np.asarray(-vectors @ ((vectors.T @ slope) / sizes))


def unserved_directions(problem: TargetProblem, i: int, q: Array) -> Array:
    """Unit twists in the base that count but that the tip cannot follow at a configuration; shape (k, 6).

    They are the left singular vectors of J for vanishing singular values, without the joints blocked at a limit.
    """
    _, J, held = _linearised(problem, i, q)
    U, sigmas, _ = np.linalg.svd(np.where(held, 0.0, J))
    largest = float(sigmas[0]) if len(sigmas) else 0.0
    rank = int(np.sum(sigmas > _LOST * largest)) if largest > 0.0 else 0
    rows = [k for k, direction in enumerate(DIRECTIONS) if direction in problem.task.directions]
    twists = np.zeros((len(rows) - rank, 6))
    twists[:, rows] = U[:, rank:].T
    if len(problem.task) < len(DIRECTIONS):
        twists[:, 3:] = twists[:, 3:] @ problem.targets.rotations[i].T
    return twists


def _linearised(problem: TargetProblem, i: int, q: Array) -> tuple[Array, Array, Flags]:
    (e,), (J,) = problem.linearised(i, q[None])
    return e, J, blocked(J.T @ e, q, problem.bounds)


def _is_stationary(problem: TargetProblem, i: int, q: Array) -> bool:
    """Check that no motion of the unblocked joints reduces the error to first order."""
    e, J, held = _linearised(problem, i, q)
    scale = float(np.linalg.norm(J, 2)) * float(np.linalg.norm(e))
    return float(np.linalg.norm((J.T @ e)[~held])) <= _STATIONARY * scale


def solved_without_limits(problem: TargetProblem, i: int) -> Array | None:
    """Search for solutions without limits and return the one that exceeds them least, if any; shape (n,)."""
    chain, seed = problem.chain, problem.seed(i)
    goal = make_goal(chain, problem.task, problem.tolerances, False, _RELAXED_STARTS, problem.options.random_seed)
    qs, _ = solutions_from(chain.flat, goal, target_rows(problem.target(i)), seed[None])
    if len(qs) == 0:
        return None
    qs = wound_near(chain, qs, seed, chain.lower, chain.upper)
    excesses = np.maximum(np.maximum(chain.lower - qs, qs - chain.upper), 0.0)
    return np.asarray(qs[int(np.argmin(excesses.max(axis=1, initial=0.0)))])


def blocking_joints(chain: Chain, q: Array) -> tuple[BlockingJoint, ...]:
    """List the joints that are beyond their limits, and by how much."""
    bounds = zip(chain.joint_names, q.tolist(), chain.lower.tolist(), chain.upper.tolist(), strict=True)
    return tuple(
        BlockingJoint(name, value, lower, upper, max(lower - value, value - upper))
        for name, value, lower, upper in bounds
        if not lower <= value <= upper
    )


def refused(q: Array, position_error: float, orientation_error: float) -> UnsolvedTarget:
    """Return the failure for a configuration that Pinocchio does not confirm as a solution."""
    reason = "the recomputed solution misses the tolerances, which are close to rounding: loosen them"
    return UnsolvedTarget("not_converged", reason, q, float(position_error), float(orientation_error))


def _excesses(joints: tuple[BlockingJoint, ...]) -> str:
    return "; ".join(
        f"{quoted(joint.name)} at {joint.position:.6g} is {joint.excess:.3g} beyond "
        f"{joint.lower if joint.position < joint.lower else joint.upper:.6g}"
        for joint in joints
    )


def _far(task: Task, errors: Array) -> str:
    parts = []
    if {"x", "y", "z"} & set(task.directions):
        parts.append(f"{errors[0]:.3g} m")
    if {"rx", "ry", "rz"} & set(task.directions):
        parts.append(f"{errors[1]:.3g} rad")
    return " and ".join(parts)


def _pair(errors: Array) -> tuple[float, float]:
    return float(errors[0]), float(errors[1])
