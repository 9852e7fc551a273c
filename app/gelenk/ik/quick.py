"""One solution for each of a few targets by search, judged, in two calls of compiled code.

Preparing a call from Python takes longer than its arithmetic. So what stays the same from one request to the next is
looked up once for all.
"""

from functools import lru_cache
from typing import Any

import numpy as np

from gelenk.ik.search.bounds import limits_of, make_goal
from gelenk.ik.search.iteration import Goal
from gelenk.ik.search.kernels import search_few
from gelenk.ik.search.task import Task
from gelenk.ik.verdict.judge import accept
from gelenk.ik.verdict.result import InverseKinematics, by_search
from gelenk.kinematics.judge.judge import agreed_pose, poses_at, sample
from gelenk.kinematics.judge.placements import expand, walk_to
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

_KEPT = 64
"""Searches kept ready; each keeps its robot."""


class QuickSearch:
    """The search of a chain for a task, and its judge, ready to be called from any thread."""

    def __init__(
        self,
        robot: RobotModel,
        chain: Chain,
        task: Task,
        tolerances: tuple[float, float],
        respect_limits: bool,
        starts: int,
        random_seed: int,
    ) -> None:
        expansion = robot.expansion(chain)
        goal = make_goal(chain, task, tolerances, respect_limits, starts, random_seed)
        self._robot, self._chain, self._sizes = robot, chain, (len(chain), len(expansion.offset))
        self._walks = walk_to(robot, chain.base_frame), walk_to(robot, chain.tip_frame)
        self._search: tuple[Any, ...] = (*chain.flat, *goal, expansion.offset, expansion.matrix)
        self._task: tuple[Any, ...] = (task.weights, task.kind, task.axis)
        self._bounds: tuple[Any, ...] = (*tolerances, limits_of(chain, respect_limits))

    def __call__(self, targets: Poses, seeds: Array) -> InverseKinematics | None:
        """Return the solutions of N targets, from one seed for all or one each; None if any has none.

        Raises CertificationFailed if Pinocchio's own poses at the solutions are others.
        """
        goals, goal_Rs = targets.positions, targets.rotations
        count, (n, nq) = len(goals), self._sizes
        qs, full_qs, outcomes = np.empty((count, n)), np.empty((count, nq)), np.empty((3, count), np.int64)
        searched: tuple[Any, ...] = (*self._search, goals, goal_Rs, seeds, qs, full_qs, outcomes)
        if not _searched(*searched):
            return None
        own = poses_at(self._robot, self._chain, self._chain.tip_frame, full_qs)
        good, errors = np.empty(count, np.bool_), np.empty((2, count))
        judged: tuple[Any, ...] = (
            *(*self._walks, full_qs, sample(count), own.positions, own.rotations),
            *(*self._task, goals, goal_Rs, *self._bounds, qs, errors, good),
        )
        agreed_pose(*accept(*judged))
        if False in good.tolist():  # for a few, lists are faster than arrays
            return None
        return InverseKinematics(qs, errors[0], errors[1], outcomes[1], outcomes[0], *by_search(count))


quick_search = lru_cache(_KEPT)(QuickSearch)
"""The same search for the same arguments, while it is kept."""


@compiled
def _searched(
    placements: Array,
    joints: Indices,
    drives: Array,
    bounds: Array,
    weights: Array,
    kind: int,
    axis: int,
    position_tolerance: float,
    chord_tolerance: float,
    slack: float,
    starts: int,
    random_seed: int,
    offset: Array,
    matrix: Array,
    positions: Array,
    rotations: Array,
    seeds: Array,
    qs: Array,
    full_qs: Array,
    outcomes: Indices,
) -> bool:
    """Fill in the results of `search_few`, and Pinocchio's configurations, see `expand`, if all targets are solved."""
    flat = FlatChain(placements, joints, drives)
    goal = Goal(bounds, weights, kind, axis, position_tolerance, chord_tolerance, slack, starts, random_seed)
    if not search_few(flat, goal, positions, rotations, seeds, qs, outcomes):
        return False
    expand(offset, matrix, qs, full_qs)
    return True
