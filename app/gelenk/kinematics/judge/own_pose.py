"""The comparison of one pose with Pinocchio's own, where Pinocchio leaves it: without a copy, an object or a loop."""

import pinocchio as pin

from gelenk.kinematics.judge.judge import agreed_pose
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.notations import pose_errors
from gelenk.robot.robot import RobotModel


class OwnPose:
    """Pinocchio's pose of a chain's tip in its base, beside another computation of it.

    Args:
        full_q: Where its configuration will be, shape (nq,).
        pose: Where the other pose will be: position (1, 3), [m], and rotation (1, 3, 3).
    """

    def __init__(self, robot: RobotModel, chain: Chain, full_q: Array, pose: tuple[Array, Array]) -> None:
        self._model, self._data, self._full_q, self._pose = robot.model, robot.data, full_q, pose
        self._tip = robot.frame_id(chain.tip_frame)
        self._base = None if chain.base_frame == robot.description.root else robot.frame_id(chain.base_frame)
        self._compared = (*pose, *_arrays(robot.data.oMf[self._tip]))

    def errors(self) -> tuple[float, float]:
        """Return distance [m] and angle [rad] of both poses, while the robot is locked; raises CertificationFailed."""
        pin.forwardKinematics(self._model, self._data, self._full_q)
        pin.updateFramePlacement(self._model, self._data, self._tip)
        compared = self._compared
        if self._base is not None:
            T_world_base = pin.updateFramePlacement(self._model, self._data, self._base)
            compared = *self._pose, *_arrays(T_world_base.actInv(self._data.oMf[self._tip]))
        return agreed_pose(*pose_errors(*compared))


def _arrays(placement: pin.SE3) -> tuple[Array, Array]:
    """Return views of a position, (1, 3), and a rotation, (1, 3, 3), which change with it."""
    return placement.translation[None], placement.rotation[None]
