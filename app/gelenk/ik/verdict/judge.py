"""Checks that configurations are solutions, by recomputing their poses with Pinocchio."""

import numpy as np

from gelenk.ik.search.search import limits_of
from gelenk.ik.verdict.fixed import widened
from gelenk.ik.verdict.verdict import TargetProblem
from gelenk.kinematics.judge.judge import pinocchio_poses
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.compilation import compiled
from gelenk.robot.poses import Poses

_WITHIN = 1e-9
"""Allowance for rounding at a joint limit, [rad or m]."""


def judged(
    question: TargetProblem, qs: Array, claimed: Flags, worth: Flags | None = None
) -> tuple[Flags, Array, Array]:
    """Check which configurations solve their targets within the limits, by Pinocchio, and return the errors.

    Args:
        question: The problem, with one target per configuration.
        qs: Configurations; shape (N, n), [rad or m].
        claimed: Which of them the solver claims as solutions; shape (N,).
        worth: Which of them Pinocchio recomputes, default all; our own kernels compute the others; shape (N,).

    Returns:
        Flags, distances [m] and angles [rad]; shape (N,) each.
    """
    chain = question.chain
    whole, full = widened(chain, qs)
    if worth is None or worth.all():
        poses = pinocchio_poses(question.robot, whole, chain.tip_frame, full, range(len(qs)))
    else:
        poses = Poses(*chain_poses(chain.flat, qs))
        rows = np.flatnonzero(worth)
        recomputed = pinocchio_poses(question.robot, whole, chain.tip_frame, full, rows.tolist())
        poses.positions[rows], poses.rotations[rows] = recomputed.positions, recomputed.rotations
    errors = question.task.errors(question.targets, poses)
    limits = limits_of(chain, question.respect_limits)
    return accepted(qs, claimed, errors, *question.tolerances, *limits), errors[0], errors[1]


@compiled
def accepted(
    qs: Array,
    claimed: Flags,
    errors: Array,
    position_tolerance: float,
    orientation_tolerance: float,
    lower: Array,
    upper: Array,
) -> Flags:
    """Check which of the claimed solutions are within the tolerances and the limits; shape (N,)."""
    good = claimed.copy()
    for i in range(len(qs)):
        good[i] &= errors[0, i] <= position_tolerance and errors[1, i] <= orientation_tolerance
        for j in range(qs.shape[1]):
            good[i] &= lower[j] - _WITHIN <= qs[i, j] <= upper[j] + _WITHIN
    return good
