"""Why a target has no solution: beyond reach, beyond the limits, at a singularity, or only not found."""

from dataclasses import dataclass
from typing import cast

import numpy as np

from gelenk.kinematics.ik import kernels
from gelenk.kinematics.ik.branches import wound_near
from gelenk.kinematics.ik.descent import Descent, blocked
from gelenk.kinematics.ik.linearise import linearise
from gelenk.kinematics.ik.reach import Reach, reach_of
from gelenk.kinematics.ik.result import BlockingJoint, Failure
from gelenk.kinematics.ik.search import ITERATIONS_PER_START, limits_of, make_goal, search_bounds, target_rows
from gelenk.kinematics.ik.task import Task
from gelenk.kinematics.ik.words import DIRECTIONS, Status
from gelenk.model.arrays import Array, Flags, Indices
from gelenk.model.chain import Chain
from gelenk.model.errors import counted, quoted
from gelenk.model.poses import Poses
from gelenk.model.robot import Robot

ENOUGH_STARTS = 100
"""Starts after which a target that none of them reached counts as unreachable rather than unlucky."""
_RELAXED_STARTS = 128
"""Starts without limits that look for what would be solved without them."""
_STATIONARY = 1e-3
"""Share of σ_max‖e‖ below which the free part of Jᵀe shows a nearest configuration."""
_LOST = 1e-3
"""Share of σ_max below which a direction counts as one that the tip cannot follow."""


@dataclass(frozen=True, slots=True)
class Question:
    """The problem: targets for a chain, and what counts as reaching them.

    Attributes:
        robot: The robot.
        chain: Base and tip.
        targets: T_base_tip wanted; N.
        seeds: One for all or one each; shape (1 or N, n).
        task: Which directions count.
        tolerances: Of position [m] and orientation [rad].
        respect_limits: Whether solutions are to be within the limits.
    """

    robot: Robot
    chain: Chain
    targets: Poses
    seeds: Array
    task: Task
    tolerances: tuple[float, float]
    respect_limits: bool

    def __len__(self) -> int:
        return len(self.targets)

    def seed(self, i: int) -> Array:
        """The seed of one target; shape (n,)."""
        return cast(Array, self.seeds[i if len(self.seeds) > 1 else 0])

    def target(self, i: int) -> Poses:
        """One of the targets."""
        return self.part(slice(i, i + 1))[0]

    @property
    def reach(self) -> Reach | None:
        """The reach that distance alone allows."""
        return reach_of(self.chain, self.task, self.respect_limits)

    def too_far(self) -> Flags:
        """Which targets are beyond reach by distance alone; shape (N,)."""
        reach = self.reach
        if reach is None:
            return np.zeros(len(self), dtype=bool)
        # What the orientation may be off moves the wrist; and sums of lengths round.
        room = self.tolerances[0] + self.tolerances[1] * float(np.linalg.norm(reach.offset)) + 1e-9
        return reach.excess(self.targets) > room

    def part(self, rows: Flags | Indices | slice) -> tuple[Poses, Array]:
        """Some of the targets, with their seeds."""
        targets = Poses(self.targets.positions[rows], self.targets.rotations[rows])
        return targets, self.seeds[rows] if len(self.seeds) > 1 else self.seeds

    def taken(self, rows: Indices) -> "Question":
        """The question for some of the targets only."""
        targets, seeds = self.part(rows)
        return Question(self.robot, self.chain, targets, seeds, self.task, self.tolerances, self.respect_limits)

    def wound(self, qs: Array) -> Array:
        """Configurations, one a target, turned by full turns into the limits and near to the seeds."""
        lower, upper = limits_of(self.chain, self.respect_limits)
        rows = [wound_near(self.chain, q[None], self.seed(i), lower, upper)[0] for i, q in enumerate(qs)]
        return np.array(rows).reshape(qs.shape)


def explain(
    question: Question,
    i: int,
    nearest: Array,
    errors: tuple[float, float],
    *,
    too_far: bool,
    beyond_limits: Array | None,
    budget: int,
    tried: bool,
    late: bool,
) -> tuple[Status, Failure]:
    """The verdict on a target that a search of many starts has not solved.

    Args:
        question: The targets.
        i: Which of them.
        nearest: The nearest configuration that was found; shape (n,).
        errors: Its distance [m] and angle [rad].
        too_far: Whether the target is beyond reach by distance alone.
        beyond_limits: What would solve it without limits; shape (n,).
        budget: Iterations that the search was given.
        tried: Whether there was time for a search.
        late: Whether time has run out by now, and is not to be spent on further reasons.
    """
    if not tried:
        return "not_converged", Failure("the time limit ended the call before this target's turn", nearest, *errors)
    if len(question.chain) == 0:
        reason = f"the chain has no joints: its tip stays {_far(question.task, errors)} away"
        return "unreachable", Failure(reason, nearest, *errors)
    directions = None if late else unserved_directions(question, i, nearest)
    reach = question.reach
    if too_far and reach is not None:
        away = _far(question.task, errors)
        reason = f"{reach.describe(question.target(i))}; the tip of the nearest pose found is {away} away"
        return "unreachable", Failure(reason, nearest, *errors, unserved_directions=directions)
    if beyond_limits is not None:
        outside = blocking_joints(question.chain, beyond_limits)
        reason = "only without joint limits: " + "; ".join(_excess_text(joint) for joint in outside)
        return "outside_limits", Failure(reason, nearest, *errors, outside, directions)
    starts = max(1, budget // ITERATIONS_PER_START)
    if directions is None:
        reason = (
            f"none of {counted(starts, 'start')} reached it, and the time limit ended the call before it was known why"
        )
        return "not_converged", Failure(reason, nearest, *errors)
    if starts < ENOUGH_STARTS:
        reason = (
            f"none of {counted(starts, 'start')} came nearer than {_far(question.task, errors)}: allow more iterations"
        )
        return "not_converged", Failure(reason, nearest, *errors, unserved_directions=directions)
    if _is_stationary(question, i, nearest):
        reason = (
            f"none of {counted(starts, 'start')} came nearer than {_far(question.task, errors)}, and from there no "
            "motion of the joints leads on"
        )
        if len(directions):
            reason += f"; the tip cannot follow {len(directions)} of {counted(len(question.task), 'direction')} there"
        return "unreachable", Failure(reason, nearest, *errors, unserved_directions=directions)
    if len(directions):
        reason = (
            f"the search slowed down {_far(question.task, errors)} from the target, where the Jacobian loses "
            f"{len(directions)} of {counted(len(question.task), 'direction')}"
        )
        return "singular", Failure(reason, nearest, *errors, unserved_directions=directions)
    reason = f"none of {counted(starts, 'start')} came nearer than {_far(question.task, errors)}"
    return "not_converged", Failure(reason, nearest, *errors)


def verdict_on_path(
    question: Question, i: int, end: Array, errors: tuple[float, float], descent: Descent | None, *, too_far: bool
) -> tuple[Status, Failure]:
    """The verdict on a target that one method from one start has not solved.

    Args:
        question: The targets.
        i: Which of them.
        end: Where the method stopped, within a full turn of the limits; shape (n,).
        errors: Its distance [m] and angle [rad].
        descent: The way there; None if there was no time for it.
        too_far: Whether the target is beyond reach by distance alone.
    """
    if descent is None:
        return "not_converged", Failure("the time limit ended the call before this target's turn", end, *errors)
    directions = unserved_directions(question, i, end)
    away = _far(question.task, errors)
    if too_far and question.reach is not None:
        reason = f"{question.reach.describe(question.target(i))}; the method stopped {away} away"
        return "unreachable", Failure(reason, end, *errors, unserved_directions=directions)
    match descent.stop_reason:
        case "converged":
            joints = blocking_joints(question.chain, end) if question.respect_limits else ()
            if not joints:
                return "not_converged", refused(end, *errors)
            reason = "converged, but beyond the joint limits: " + "; ".join(_excess_text(joint) for joint in joints)
            return "outside_limits", Failure(reason, end, *errors, joints)
        case "stagnated":
            reason = f"stopped {away} away, where the error lies in ker Jᵀ: no motion of the joints makes it smaller"
            return "singular", Failure(reason, end, *errors, unserved_directions=directions)
        case "near_singular":
            reason = f"stopped {away} away, where the Jacobian is singular and Newton's step is not defined"
            return "singular", Failure(reason, end, *errors, unserved_directions=directions)
        case "at_limits":
            names = ", ".join(quoted(question.chain.joint_names[j]) for j in _at_limits(question, i, end))
            reason = f"stopped {away} away, where only joints at their limits could go on: {names}"
            return "not_converged", Failure(reason, end, *errors)
        case "diverged":
            reason = "the steps grew without bound: take a smaller step size, or leave it out for a line search"
            return "not_converged", Failure(reason, end, *errors)
        case "time_limit":
            reason = (
                f"{away} away after {counted(len(descent.trace) - 1, 'iteration')}, when the time limit ended the call"
            )
            return "not_converged", Failure(reason, end, *errors)
        case "iterations":
            after = counted(len(descent.trace) - 1, "iteration")
            reason = f"{away} away after {after}; try another start, method or step size"
            return "not_converged", Failure(reason, end, *errors)


def unserved_directions(question: Question, i: int, q: Array) -> Array:
    """Unit twists in the base that the tip cannot follow at a configuration, of those that count; shape (k, 6).

    The left singular vectors of J whose singular values vanish; joints held at a limit do not help.
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


def _linearised(question: Question, i: int, q: Array) -> tuple[Array, Array]:
    es, Js = linearise(question.chain, question.target(i), q[None], question.task)
    return es[0], Js[0]


def _at_limits(question: Question, i: int, q: Array) -> Indices:
    e, J = _linearised(question, i, q)
    return np.flatnonzero(blocked(J.T @ e, q, search_bounds(question.chain, question.respect_limits)))


def _is_stationary(question: Question, i: int, q: Array) -> bool:
    """Whether no joint that is free to move reduces the error."""
    e, J = _linearised(question, i, q)
    slope = J.T @ e
    held = blocked(slope, q, search_bounds(question.chain, question.respect_limits))
    scale = float(np.linalg.norm(J, 2)) * float(np.linalg.norm(e))
    return float(np.linalg.norm(slope[~held])) <= _STATIONARY * scale


def solved_without_limits(question: Question, i: int, random_seed: int) -> Array | None:
    """The configuration that solves a target and exceeds the limits least, if one is found; shape (n,)."""
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
    """Whether a joint is beyond its limits."""
    return bool(((q < chain.lower) | (q > chain.upper)).any())


def blocking_joints(chain: Chain, q: Array) -> tuple[BlockingJoint, ...]:
    """The joints that are beyond their limits, and by how much."""
    bounds = zip(chain.joint_names, q.tolist(), chain.lower.tolist(), chain.upper.tolist(), strict=True)
    return tuple(
        BlockingJoint(name, value, lower, upper, max(lower - value, value - upper))
        for name, value, lower, upper in bounds
        if not lower <= value <= upper
    )


def refused(q: Array, position_error: float, orientation_error: float) -> Failure:
    """Why a configuration that was found is not sent as a solution."""
    reason = "what was found misses the tolerances when it is recomputed: they are near rounding, allow more"
    return Failure(reason, q, float(position_error), float(orientation_error))


def _excess_text(joint: BlockingJoint) -> str:
    limit = joint.lower if joint.position < joint.lower else joint.upper
    return f"{quoted(joint.name)} at {joint.position:.6g} is {joint.excess:.3g} beyond {limit:.6g}"


def _far(task: Task, errors: tuple[float, float]) -> str:
    """Errors in words, of what counts."""
    parts = []
    if {"x", "y", "z"} & set(task.directions):
        parts.append(f"{errors[0]:.3g} m")
    if {"rx", "ry", "rz"} & set(task.directions):
        parts.append(f"{errors[1]:.3g} rad")
    return " and ".join(parts)
