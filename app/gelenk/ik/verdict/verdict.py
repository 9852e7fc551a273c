"""Verdicts on unsolved targets: beyond reach, beyond the limits, at a singularity, or merely not found."""

from dataclasses import dataclass
from typing import cast

import numpy as np

from gelenk.errors import counted, quoted
from gelenk.ik.search import kernels
from gelenk.ik.search.descent import Descent, blocked
from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.reach import Reach, reach_of
from gelenk.ik.search.search import ITERATIONS_PER_START, limits_of, make_goal, search_bounds, target_rows
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS, Status
from gelenk.ik.verdict.branches import wound_near
from gelenk.ik.verdict.result import BlockingJoint, UnsolvedTarget
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

ENOUGH_STARTS = 100
"""Number of failed starts after which a target may count as unreachable rather than unlucky."""
_RELAXED_STARTS = 128
"""Number of starts in the search for a solution beyond the limits."""
_STATIONARY = 1e-3
"""Share of σ_max‖e‖ below which Jᵀe, over the free joints, marks a minimum of the error."""
_LOST = 1e-3
"""Share of σ_max below which the tip counts as unable to follow a direction."""


@dataclass(frozen=True, slots=True)
class TargetProblem:
    """A problem: targets for a chain, and the conditions for reaching them.

    Attributes:
        robot: The robot.
        chain: Base and tip.
        targets: Desired T_base_tip; N of them.
        seeds: One configuration for all targets or one each; shape (1 or N, n), [rad or m].
        task: Which directions count.
        tolerances: Of position [m] and orientation [rad].
        respect_limits: Whether solutions must be within the joint limits.
    """

    robot: RobotModel
    chain: Chain
    targets: Poses
    seeds: Array
    task: Task
    tolerances: tuple[float, float]
    respect_limits: bool

    def __len__(self) -> int:
        return len(self.targets)

    def seed(self, i: int) -> Array:
        """Return the seed of one target; shape (n,)."""
        return cast(Array, self.seeds[i if len(self.seeds) > 1 else 0])

    def target(self, i: int) -> Poses:
        """Return one of the targets, as poses of length 1."""
        return self.part(slice(i, i + 1))[0]

    @property
    def reach(self) -> Reach | None:
        """The bounds on reach by distance alone; None if there are none."""
        return reach_of(self.chain, self.task, self.respect_limits)

    def too_far(self) -> Flags:
        """Flag the targets beyond reach by distance alone; shape (N,)."""
        reach = self.reach
        if reach is None:
            return np.zeros(len(self), dtype=bool)
        # The orientation tolerance lets the wrist move, and the sums of lengths are rounded.
        room = self.tolerances[0] + self.tolerances[1] * float(np.linalg.norm(reach.offset)) + 1e-9
        return reach.excess(self.targets) > room

    def part(self, rows: Flags | Indices | slice) -> tuple[Poses, Array]:
        """Return some of the targets, with their seeds."""
        targets = Poses(self.targets.positions[rows], self.targets.rotations[rows])
        return targets, self.seeds[rows] if len(self.seeds) > 1 else self.seeds

    def taken(self, rows: Indices) -> "TargetProblem":
        """Return the question for some of the targets only."""
        targets, seeds = self.part(rows)
        return TargetProblem(self.robot, self.chain, targets, seeds, self.task, self.tolerances, self.respect_limits)

    def wound(self, qs: Array) -> Array:
        """Turn configurations, one per target, by full turns into the limits and towards the seeds; shape (N, n)."""
        lower, upper = limits_of(self.chain, self.respect_limits)
        rows = [wound_near(self.chain, q[None], self.seed(i), lower, upper)[0] for i, q in enumerate(qs)]
        return np.array(rows).reshape(qs.shape)


def explain(
    question: TargetProblem,
    i: int,
    nearest: Array,
    errors: tuple[float, float],
    *,
    too_far: bool,
    beyond_limits: Array | None,
    budget: int,
    tried: bool,
    late: bool,
) -> tuple[Status, UnsolvedTarget]:
    """Return the verdict on a target that a search from many starts has not solved.

    Args:
        question: The problem.
        i: Index of the target.
        nearest: Nearest configuration found; shape (n,), [rad or m].
        errors: Its distance [m] and angle [rad] from the target.
        too_far: Whether the target is beyond reach by distance alone.
        beyond_limits: A solution beyond the limits, if one was found; shape (n,), [rad or m].
        budget: Iteration budget of the search.
        tried: Whether there was time for a search.
        late: Whether time has run out, so that no further reason is sought.
    """
    if not tried:
        return "not_converged", UnsolvedTarget(
            "the time limit ended the call before this target's turn", nearest, *errors
        )
    if len(question.chain) == 0:
        reason = f"the chain has no joints: its tip stays {_far(question.task, errors)} away"
        return "unreachable", UnsolvedTarget(reason, nearest, *errors)
    directions = None if late else unserved_directions(question, i, nearest)
    reach = question.reach
    if too_far and reach is not None:
        away = _far(question.task, errors)
        reason = f"{reach.describe(question.target(i))}; the tip of the nearest pose found is {away} away"
        return "unreachable", UnsolvedTarget(reason, nearest, *errors, unserved_directions=directions)
    if beyond_limits is not None:
        outside = blocking_joints(question.chain, beyond_limits)
        reason = "solvable only beyond the joint limits: " + "; ".join(_excess_text(joint) for joint in outside)
        return "outside_limits", UnsolvedTarget(reason, nearest, *errors, outside, directions)
    starts = max(1, budget // ITERATIONS_PER_START)
    if directions is None:
        attempts = f"none of {counted(starts, 'start')} reached it"
        reason = f"{attempts}, and the time limit ended the call before the reason was found"
        return "not_converged", UnsolvedTarget(reason, nearest, *errors)
    if starts < ENOUGH_STARTS:
        reason = (
            f"none of {counted(starts, 'start')} came nearer than {_far(question.task, errors)}: allow more iterations"
        )
        return "not_converged", UnsolvedTarget(reason, nearest, *errors, unserved_directions=directions)
    if _is_stationary(question, i, nearest):
        reason = (
            f"none of {counted(starts, 'start')} came nearer than {_far(question.task, errors)}, and from there no "
            "motion of the joints leads on"
        )
        if len(directions):
            reason += f"; the tip cannot follow {len(directions)} of {counted(len(question.task), 'direction')} there"
        return "unreachable", UnsolvedTarget(reason, nearest, *errors, unserved_directions=directions)
    if len(directions):
        reason = (
            f"the search slowed down {_far(question.task, errors)} from the target, where the Jacobian loses "
            f"{len(directions)} of {counted(len(question.task), 'direction')}"
        )
        return "singular", UnsolvedTarget(reason, nearest, *errors, unserved_directions=directions)
    reason = f"none of {counted(starts, 'start')} came nearer than {_far(question.task, errors)}"
    return "not_converged", UnsolvedTarget(reason, nearest, *errors)


def verdict_on_path(
    question: TargetProblem, i: int, end: Array, errors: tuple[float, float], descent: Descent | None, *, too_far: bool
) -> tuple[Status, UnsolvedTarget]:
    """Return the verdict on a target that one method from one start has not solved.

    Args:
        question: The problem.
        i: Index of the target.
        end: Last configuration, turned by full turns towards the limits and the seed; shape (n,), [rad or m].
        errors: Its distance [m] and angle [rad] from the target.
        descent: The iteration that led there; None if there was no time for it.
        too_far: Whether the target is beyond reach by distance alone.
    """
    if descent is None:
        return "not_converged", UnsolvedTarget("the time limit ended the call before this target's turn", end, *errors)
    directions = unserved_directions(question, i, end)
    away = _far(question.task, errors)
    if too_far and question.reach is not None:
        reason = f"{question.reach.describe(question.target(i))}; the method stopped {away} away"
        return "unreachable", UnsolvedTarget(reason, end, *errors, unserved_directions=directions)
    match descent.stop_reason:
        case "converged":
            joints = blocking_joints(question.chain, end) if question.respect_limits else ()
            if not joints:
                return "not_converged", refused(end, *errors)
            reason = "converged, but beyond the joint limits: " + "; ".join(_excess_text(joint) for joint in joints)
            return "outside_limits", UnsolvedTarget(reason, end, *errors, joints)
        case "stagnated":
            reason = f"stopped {away} away, where the error lies in ker Jᵀ: no motion of the joints makes it smaller"
            return "singular", UnsolvedTarget(reason, end, *errors, unserved_directions=directions)
        case "near_singular":
            reason = f"stopped {away} away, where the Jacobian is singular and Newton's step is not defined"
            return "singular", UnsolvedTarget(reason, end, *errors, unserved_directions=directions)
        case "at_limits":
            names = ", ".join(quoted(question.chain.joint_names[j]) for j in _at_limits(question, i, end))
            reason = f"stopped {away} away, where only joints at their limits could reduce the error further: {names}"
            return "not_converged", UnsolvedTarget(reason, end, *errors)
        case "diverged":
            reason = "the steps grew without bound: take a smaller step size, or leave it out for a line search"
            return "not_converged", UnsolvedTarget(reason, end, *errors)
        case "time_limit":
            reason = (
                f"{away} away after {counted(len(descent.trace) - 1, 'iteration')}, when the time limit ended the call"
            )
            return "not_converged", UnsolvedTarget(reason, end, *errors)
        case "iterations":
            after = counted(len(descent.trace) - 1, "iteration")
            reason = f"{away} away after {after}; try another start, method or step size"
            return "not_converged", UnsolvedTarget(reason, end, *errors)


def unserved_directions(question: TargetProblem, i: int, q: Array) -> Array:
    """Unit twists in the base that count but that the tip cannot follow at a configuration; shape (k, 6).

    They are the left singular vectors of J for vanishing singular values, without the joints blocked at a limit.
    """
    e, J = _linearised(question, i, q)
    held = blocked(J.T @ e, q, search_bounds(question.chain, question.respect_limits))
    U, sigmas, _ = np.linalg.svd(np.where(held, 0.0, J))
    largest = float(sigmas[0]) if len(sigmas) else 0.0
    rank = int(np.sum(sigmas > _LOST * largest)) if largest > 0.0 else 0
    rows = [k for k, direction in enumerate(DIRECTIONS) if direction in question.task.directions]
    twists = np.zeros((len(rows) - rank, 6))
    twists[:, rows] = U[:, rank:].T
    if len(question.task) < len(DIRECTIONS):
        twists[:, 3:] = twists[:, 3:] @ question.targets.rotations[i].T
    return twists


def _linearised(question: TargetProblem, i: int, q: Array) -> tuple[Array, Array]:
    es, Js = linearise(question.chain, question.target(i), q[None], question.task)
    return es[0], Js[0]


def _at_limits(question: TargetProblem, i: int, q: Array) -> Indices:
    e, J = _linearised(question, i, q)
    return np.flatnonzero(blocked(J.T @ e, q, search_bounds(question.chain, question.respect_limits)))


def _is_stationary(question: TargetProblem, i: int, q: Array) -> bool:
    """Check that no motion of the unblocked joints reduces the error to first order."""
    e, J = _linearised(question, i, q)
    slope = J.T @ e
    held = blocked(slope, q, search_bounds(question.chain, question.respect_limits))
    scale = float(np.linalg.norm(J, 2)) * float(np.linalg.norm(e))
    return float(np.linalg.norm(slope[~held])) <= _STATIONARY * scale


def solved_without_limits(question: TargetProblem, i: int, random_seed: int) -> Array | None:
    """Search for solutions without limits and return the one that exceeds them least, if any; shape (n,)."""
    chain = question.chain
    goal = make_goal(
        chain, question.task, *question.tolerances, False, _RELAXED_STARTS * ITERATIONS_PER_START, random_seed
    )
    qs = kernels.gather(chain.flat, goal, target_rows(question.target(i))[0], question.seed(i))
    if len(qs) == 0:
        return None
    qs = wound_near(chain, qs, question.seed(i), chain.lower, chain.upper)
    excesses = np.maximum(np.maximum(chain.lower - qs, qs - chain.upper), 0.0)
    best: Array = qs[int(np.argmin(excesses.max(axis=1, initial=0.0)))]
    return best


def beyond_limits(chain: Chain, q: Array) -> bool:
    """Check whether any joint is beyond its limits."""
    return bool(((q < chain.lower) | (q > chain.upper)).any())


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
    return UnsolvedTarget(reason, q, float(position_error), float(orientation_error))


def _excess_text(joint: BlockingJoint) -> str:
    limit = joint.lower if joint.position < joint.lower else joint.upper
    return f"{quoted(joint.name)} at {joint.position:.6g} is {joint.excess:.3g} beyond {limit:.6g}"


def _far(task: Task, errors: tuple[float, float]) -> str:
    """Format the errors that count in words."""
    parts = []
    if {"x", "y", "z"} & set(task.directions):
        parts.append(f"{errors[0]:.3g} m")
    if {"rx", "ry", "rz"} & set(task.directions):
        parts.append(f"{errors[1]:.3g} rad")
    return " and ".join(parts)
