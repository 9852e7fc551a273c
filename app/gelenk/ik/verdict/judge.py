"""Checks that configurations are solutions, by recomputing their poses with Pinocchio."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.verdict.fixed import widened
from gelenk.ik.verdict.result import InverseKinematics, firsts_of
from gelenk.kinematics.judge.judge import recomputed_poses
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.compilation import compiled

_WITHIN = 1e-9
"""Allowance for rounding at a joint limit, [rad or m]."""


def judged(problem: TargetProblem, qs: Array, claimed: Flags | None = None) -> tuple[Flags, Array, Array]:
    """Check by Pinocchio which configurations solve their targets within the limits; also return the errors [m], [rad].

    Args:
        qs: Configurations, one per target; shape (N, n), [rad or m].
        claimed: Which of them the solver claims as solutions, default all; shape (N,).
    """
    chain = problem.chain
    whole, full = widened(chain, qs)
    errors = problem.task.errors(problem.targets, recomputed_poses(problem.robot, whole, full))
    claims = np.ones(len(qs), dtype=np.bool_) if claimed is None else claimed
    return accepted(qs, claims, errors, *problem.tolerances, problem.limits), errors[0], errors[1]


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
def accepted(
    qs: Array,
    claimed: Flags,
    errors: Array,
    position_tolerance: float,
    orientation_tolerance: float,
    limits: Array,
) -> Flags:
    """Check which of the claimed solutions are within the tolerances and the limits; shape (N,)."""
    good = claimed.copy()
    for i in range(len(qs)):
        good[i] &= errors[0, i] <= position_tolerance and errors[1, i] <= orientation_tolerance
        for j in range(qs.shape[1]):
            good[i] &= limits[0, j] - _WITHIN <= qs[i, j] <= limits[1, j] + _WITHIN
    return good
