"""One solution for a target by search, judged, in two calls of compiled code.

Preparing a call from Python takes longer than its arithmetic. So all numbers of a search stay in one piece of memory,
from one request to the next, and Pinocchio's pose is compared where Pinocchio leaves it.
"""

from collections.abc import Sequence
from functools import lru_cache, partial
from struct import Struct
from typing import Any

import numpy as np

from gelenk.ik.search.bounds import limits_of, make_goal, mid_range
from gelenk.ik.search.iteration import Goal
from gelenk.ik.search.kernels import search_few
from gelenk.ik.search.task import Task
from gelenk.ik.verdict.judge import recompute
from gelenk.ik.verdict.result import InverseKinematics, by_search
from gelenk.kinematics.judge.own_pose import OwnPose
from gelenk.kinematics.judge.placements import expand, walk_to
from gelenk.kinematics.simd.block import ArrayBlock
from gelenk.kinematics.simd.lanes import part
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.notations import turn_by_quaternions_xyzw
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

_KEPT = 64
"""Searches kept ready; each keeps its robot."""
(
    _CHOICES, _TOLERANCES, _PLACEMENTS, _JOINTS, _DRIVES, _BOUNDS, _WEIGHTS, _LIMITS, _OFFSET, _MATRIX, _BASE, _TIP,
    _SEEDS, _QUATERNION, _POSITION, _ROTATION, _OWN_POSITION, _OWN_ROTATION, _FULL_Q, _Q, _ERRORS, _OUTCOMES,
) = range(22)  # fmt: skip
"""The arrays of a search, in the order in which they are in memory."""


class QuickSearch:
    """The search of a chain of `count` variables for a task, and its judge, ready to be called from any thread."""

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
        n, nq, expansion = len(chain), robot.model.nq, robot.expansion(chain)
        goal = make_goal(chain, task, tolerances, respect_limits, starts, random_seed)
        walks = walk_to(robot, chain.base_frame), walk_to(robot, chain.tip_frame)
        sizes = len(chain.flat.joints), n, nq, *map(len, walks)
        constant = (
            np.array([*sizes, goal.kind, goal.axis, starts, random_seed]),
            np.array([*tolerances, goal.chord_tolerance, goal.slack]),
            *(*chain.flat, goal.bounds, goal.weights, limits_of(chain, respect_limits)),
            *(expansion.offset, expansion.matrix, *walks),
        )
        seeds, pose = np.array([mid_range(chain)] * 2), (np.zeros((1, 3)), np.zeros((1, 3, 3)))
        found = np.zeros((1, n)), np.zeros((2, 1)), np.zeros((3, 1), np.int64)
        block = ArrayBlock((*constant, seeds, np.zeros((1, 5)), *pose, *pose, np.zeros((1, nq)), *found))
        views, numbers, places = block.views, memoryview(block.numbers.data), block.integers.tolist()
        self._memory, self._seed = (block.numbers, block.integers), views[_SEEDS][1]
        self.chain, self.count = chain, n
        self._lock = robot.lock
        self._own = OwnPose(robot, chain, views[_FULL_Q][0], (views[_OWN_POSITION], views[_OWN_ROTATION]))
        self._writers = {
            8: partial(Struct("8d").pack_into, numbers[places[_QUATERNION] :], 0),
            12: partial(Struct("12d").pack_into, numbers[places[_POSITION] :], 0),
        }
        self._found = partial(Struct(f"{n + 2}d3q").unpack_from, numbers[places[_Q] :])

    def __call__(self, target: Sequence[float], seed: Array | None) -> tuple[Any, ...] | None:
        """Return the solution from a seed, shape (n,), or the middle of the ranges; None if the search finds none.

        The target has 8 numbers: the length of a quaternion, the quaternion x y z w, and a position; or 12: a position
        and a rotation row by row. The solution's are the configuration, its errors [m] and [rad], and the outcome, see
        `search_few`. Raises CertificationFailed if Pinocchio's own pose there is another.
        """
        with self._lock:
            self._writers[len(target)](*target)
            if seed is not None:
                self._seed[:] = seed
            if not _searched(*self._memory, len(target) == 8, seed is not None):
                return None
            self._own.errors()
            return self._found()

    def of_each(self, targets: Poses, seeds: Array) -> InverseKinematics | None:
        """Return the solutions of N targets, from one seed for all or one each; None if any has none."""
        found = []
        for i, target in enumerate(np.hstack((targets.positions, targets.rotations.reshape(-1, 9))).tolist()):
            if (numbers := self(target, seeds[i if len(seeds) > 1 else 0])) is None:
                return None
            found.append(numbers)
        n, rows = self.count, np.array(found).reshape(-1, self.count + 5)
        restarts, iterations, _ = rows[:, n + 2 :].T.astype(np.int64)
        return InverseKinematics(rows[:, :n], rows[:, n], rows[:, n + 1], iterations, restarts, *by_search(len(found)))


quick_search = lru_cache(_KEPT)(QuickSearch)
"""The same search for the same arguments, while it is kept."""


@compiled
def _searched(numbers: Array, at: Indices, by_quaternion: bool, is_seeded: bool) -> bool:
    """Fill in a solution, see `search_few` and `recompute`, with Pinocchio's configuration and the pose there.

    The memory comes as numbers and as integers; `by_quaternion` says in which form the target is, and `is_seeded` which
    of the two seeds counts.
    """
    c, t = at[_CHOICES], at[_TOLERANCES]
    joints, n, nq, to_base, to_tip, kind, axis = at[c], at[c + 1], at[c + 2], at[c + 3], at[c + 4], at[c + 5], at[c + 6]
    flat = FlatChain(
        part(numbers, at[_PLACEMENTS], (joints + 1, 12)),
        part(at, at[_JOINTS], (joints, 2)),
        part(numbers, at[_DRIVES], (joints, 2)),
    )
    bounds, weights = part(numbers, at[_BOUNDS], (6, n)), part(numbers, at[_WEIGHTS], (6,))
    tolerances = numbers[t], numbers[t + 1]
    goal = Goal(bounds, weights, kind, axis, tolerances[0], numbers[t + 2], numbers[t + 3], at[c + 7], at[c + 8])
    position, rotation = part(numbers, at[_POSITION], (1, 3)), part(numbers, at[_ROTATION], (1, 3, 3))
    if by_quaternion:
        length, quaternion = numbers[at[_QUATERNION]], part(numbers, at[_QUATERNION] + 1, (1, 4))
        for k in range(4):
            quaternion[0, k] /= length
        turn_by_quaternions_xyzw(quaternion, rotation)
    seed = part(numbers, at[_SEEDS] + n * is_seeded, (1, n))
    q, errors = part(numbers, at[_Q], (1, n)), part(numbers, at[_ERRORS], (2, 1))
    if not search_few(flat, goal, position, rotation, seed, q, part(at, at[_OUTCOMES], (3, 1))):
        return False
    full_q, good = part(numbers, at[_FULL_Q], (1, nq)), np.empty(1, np.bool_)
    expand(part(numbers, at[_OFFSET], (nq,)), part(numbers, at[_MATRIX], (nq, n)), q, full_q)
    walks = part(numbers, at[_BASE], (to_base, 12)), part(numbers, at[_TIP], (to_tip, 12))
    task, limits = (weights, kind, axis), part(numbers, at[_LIMITS], (2, n))
    own = recompute(*walks, full_q, task, position, rotation, tolerances, limits, q, errors, good)
    part(numbers, at[_OWN_POSITION], (1, 3))[:], part(numbers, at[_OWN_ROTATION], (1, 3, 3))[:] = own
    return bool(good[0])
