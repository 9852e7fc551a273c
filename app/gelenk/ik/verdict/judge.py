"""Checks that configurations are solutions, by recomputing their poses with Pinocchio."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.task import task_errors
from gelenk.ik.verdict.fixed import widened
from gelenk.ik.verdict.result import InverseKinematics, firsts_of
from gelenk.kinematics.judge.judge import agreed_pose, recomputed_poses, sampled_rows, testimony
from gelenk.kinematics.judge.placements import relative_poses
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled
from gelenk.robot.notations import pose_errors

_WITHIN = 1e-9
"""Allowance for rounding at a joint limit, [rad or m]."""


def judged(problem: TargetProblem, qs: Array, claimed: Flags | None = None) -> tuple[Flags, Array, Array]:
    """Check by Pinocchio which configurations solve their targets within the limits; also return the errors [m], [rad].

    Args:
        qs: Configurations, one per target; shape (N, n), [rad or m].
        claimed: Which of them the solver claims as solutions, default all; shape (N,).
    """
    task = problem.task
    # As for all others: a kernel would be compiled for a choice of columns.
    goals, goal_Rs, qs = map(np.ascontiguousarray, (problem.targets.positions, problem.targets.rotations, qs))
    whole, full = widened(problem.chain, qs)
    good, errors = np.empty(len(qs), np.bool_), np.empty((2, len(qs)))
    arguments: tuple[Any, ...] = (
        *testimony(problem.robot, whole, full, is_draft=problem.is_draft),
        *(task.weights, task.kind, task.axis, goals, goal_Rs),
        *(*problem.tolerances, problem.limits, qs, errors, good),
    )
    agreed_pose(*accept(*arguments))
    return good if claimed is None else good & claimed, errors[0], errors[1]


def certify(problem: TargetProblem, answer: InverseKinematics) -> None:
    """Compare an answer made of drafts with Pinocchio's own poses: all of a few, a sample of many.

    Raises CertificationFailed.
    """
    qs = answer.qs
    if answer.failures:
        qs = np.vstack((qs, *(failure.nearest for failure in answer.failures.values())))
    recomputed_poses(problem.robot, *widened(problem.chain, qs[sampled_rows(len(qs))]))


def assembled(
    count: int,
    owners: Indices,
    qs: Array,
    judgement: tuple[Flags, Array, Array],
    labels: Mapping[str, Indices],
    **rest: Any,
) -> InverseKinematics:
    """Build the answer for `count` targets from M judged configurations, without those that are no solutions.

    Args:
        owners: Target of each configuration, ascending; shape (M,).
        labels: Their iterations, restarts, codes and bit masks of free joints, as far as there are any; shape (M,).
        rest: The fields of the answer that are not per solution.
    """
    solved, position_errors, orientation_errors = judgement
    none = np.zeros(len(qs), dtype=np.int64)
    columns: dict[str, Any] = {
        "qs": qs,
        "position_errors": position_errors,
        "orientation_errors": orientation_errors,
        "iterations": none,
        "restarts": none,
        "codes": none - 1,
        "free": none,
        **labels,
    }
    if np.count_nonzero(solved) < len(solved):
        owners, columns = owners[solved], {name: column[solved] for name, column in columns.items()}
    return InverseKinematics(**columns, firsts=firsts_of(owners, count), **rest)


@compiled
def accept(
    base: Array,
    tip: Array,
    full_qs: Array,
    rows: Indices,
    own_positions: Array,
    own_Rs: Array,
    weights: Array,
    kind: int,
    axis: int,
    goals: Array,
    goal_Rs: Array,
    position_tolerance: float,
    orientation_tolerance: float,
    limits: Array,
    qs: Array,
    errors: Array,
    good: Flags,
) -> tuple[float, float, float]:
    """Recompute the poses of a `Testimony`, and return the `pose_errors` of those that Pinocchio has itself.

    For what is filled in see `recompute`. All in one call, because each one from Python takes longer than its
    arithmetic.
    """
    task, tolerances = (weights, kind, axis), (position_tolerance, orientation_tolerance)
    positions, Rs = recompute(base, tip, full_qs, task, goals, goal_Rs, tolerances, limits, qs, errors, good)
    return pose_errors(positions[rows], Rs[rows], own_positions, own_Rs)


@compiled
def recompute(
    base: Array,
    tip: Array,
    full_qs: Array,
    task: tuple[Array, int, int],
    goals: Array,
    goal_Rs: Array,
    tolerances: tuple[float, float],
    limits: Array,
    qs: Array,
    errors: Array,
    good: Flags,
) -> tuple[Array, Array]:
    """Return the poses over the placements of Pinocchio's model; shape (N, 3) and (N, 3, 3). For compiled callers.

    Fill in the `task_errors`, shape (2, N), and which of the configurations, (N, n), are within the tolerances and the
    limits, (N,).
    """
    positions, Rs = relative_poses(base, tip, full_qs)
    errors[:] = task_errors(task[0], task[1], task[2], goals, goal_Rs, positions, Rs)
    for i in range(len(qs)):
        good[i] = errors[0, i] <= tolerances[0] and errors[1, i] <= tolerances[1]
        for j in range(qs.shape[1]):
            good[i] &= limits[0, j] - _WITHIN <= qs[i, j] <= limits[1, j] + _WITHIN
    return positions, Rs
