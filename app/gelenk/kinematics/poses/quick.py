"""The pose of a chain's tip at one configuration, judged, in two calls of compiled code.

Preparing a call from Python takes longer than its arithmetic. So what stays the same from one request to the next is
looked up once for all, and Pinocchio's pose is compared where Pinocchio leaves it.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
import pinocchio as pin

from gelenk.kinematics.judge.judge import agreed_pose
from gelenk.kinematics.judge.placements import expand
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.configuration import MAX_MAGNITUDE
from gelenk.robot.notations import pose_errors, quaternions_xyzw_from_rotations
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
        self._count, self._q, self._full_q = len(chain), qs[0], full_qs[0]
        self._workspace, self._lock = (robot.model, robot.data), robot.lock
        self._tip = robot.frame_id(chain.tip_frame)
        self._base = None if chain.base_frame == robot.description.root else robot.frame_id(chain.base_frame)
        self._compared = (*self._pose, *_arrays(robot.data.oMf[self._tip]))

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
            pin.forwardKinematics(*self._workspace, self._full_q)
            pin.updateFramePlacement(*self._workspace, self._tip)
            errors = pose_errors(*(self._compared if self._base is None else self._compared_in(self._base)))
            found = self._found.copy()
        return found, PoseCertificate(1, *agreed_pose(*errors), 0)

    def _compared_in(self, base: int) -> tuple[Array, ...]:
        T_world_base, data = pin.updateFramePlacement(*self._workspace, base), self._workspace[1]
        return *self._pose, *_arrays(T_world_base.actInv(data.oMf[self._tip]))


quick_pose = lru_cache(_KEPT)(QuickPose)
"""The same function for the same chain of a robot, while it is kept."""


def poses_in(numbers: Array) -> tuple[Array, Array]:
    """Return views of the position, (1, 3), and the rotation, (1, 3, 3), among the numbers of a `QuickPose`."""
    return numbers[None, :3], numbers[3:12].reshape(1, 3, 3)


def _arrays(placement: pin.SE3) -> tuple[Array, Array]:
    """Return views of a position, (1, 3), and a rotation, (1, 3, 3), which change with it."""
    return placement.translation[None], placement.rotation[None]


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
