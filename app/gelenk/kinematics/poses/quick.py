"""The pose of a chain's tip at one configuration, judged, in two calls of compiled code.

Preparing a call from Python takes longer than its arithmetic. So what stays the same from one request to the next is
looked up once for all.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from gelenk.kinematics.judge.own_pose import OwnPose
from gelenk.kinematics.judge.placements import expand
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.configuration import MAX_MAGNITUDE
from gelenk.robot.notations import quaternions_xyzw_from_rotations
from gelenk.robot.robot import RobotModel

_KEPT = 64
"""Chains kept ready; each keeps its robot."""


class QuickPose:
    """The tip of a chain and its judge, ready to be called from any thread."""

    def __init__(self, robot: RobotModel, chain: Chain) -> None:
        expansion, full_qs, qs = robot.expansion(chain), np.empty((1, robot.model.nq)), np.empty((1, len(chain)))
        self._found = np.empty(16)
        self._pose = poses_in(self._found)
        given = (*chain.flat, expansion.offset, expansion.matrix, qs, full_qs)
        self._placing: tuple[Any, ...] = (*given, *self._pose, self._found[None, 12:])
        self._count, self._q, self._lock = len(chain), qs[0], robot.lock
        self._own = OwnPose(robot, chain, full_qs[0], self._pose)

    def __call__(self, q: Sequence[float]) -> tuple[Array, PoseCertificate] | None:
        """Return T_base_tip at a configuration, and how far it is from Pinocchio's.

        The numbers are position, rotation row by row and quaternion x y z w, shape (16,). None unless the configuration
        has a number of sensible size for each joint. Raises CertificationFailed.
        """
        if len(q) != self._count:
            return None
        with self._lock:
            self._q[:] = q
            if not _placed(*self._placing):
                return None
            errors = self._own.errors()
            return self._found.copy(), PoseCertificate(1, *errors, 0)


quick_pose = lru_cache(_KEPT)(QuickPose)
"""The same function for the same chain of a robot, while it is kept."""


def poses_in(numbers: Array) -> tuple[Array, Array]:
    """Return views of the position, (1, 3), and the rotation, (1, 3, 3), among the numbers of a `QuickPose`."""
    return numbers[None, :3], numbers[3:12].reshape(1, 3, 3)


@compiled
def _placed(
    placements: Array,
    joints: Indices,
    drives: Array,
    offset: Array,
    matrix: Array,
    qs: Array,
    full_qs: Array,
    positions: Array,
    rotations: Array,
    quaternions: Array,
) -> bool:
    """Fill in T_base_tip, see `chain_poses`, and Pinocchio's configuration, see `expand`; False if too large."""
    for value in qs[0]:
        if not abs(value) <= MAX_MAGNITUDE:
            return False
    for i in range(len(joints)):
        if not abs(drives[i, 0] * qs[0, joints[i, 1]] + drives[i, 1]) <= MAX_MAGNITUDE:
            return False
    positions[:], rotations[:] = chain_poses(FlatChain(placements, joints, drives), qs)
    quaternions[:] = quaternions_xyzw_from_rotations(rotations)
    expand(offset, matrix, qs, full_qs)
    return True
