"""Forward kinematics: poses of the tip and of every frame that the chain moves."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.judge.judge import certify_poses
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel


@dataclass(frozen=True, slots=True)
class ForwardKinematics:
    """N poses T_base_tip, and as many T_base_frame of each requested frame, by its name."""

    poses: Poses
    frames: dict[str, Poses]
    certificate: PoseCertificate


def forward_kinematics(robot: RobotModel, chain: Chain, qs: Array, frames: Sequence[str] = ()) -> ForwardKinematics:
    """Compute and certify poses of the tip, and of other frames on the chain.

    Args:
        qs: Configurations in the chain's order; shape (N, n), [rad or m].

    Raises:
        UnknownFrame: The robot has no such frame.
        FrameNotOnChain: A frame also moves with joints off the chain.
        CertificationFailed: Pinocchio's poses differ by more than rounding.
    """
    poses = Poses(*chain_poses(chain.flat, qs))
    others = {}
    for frame in frames:
        part, columns = robot.frame_on(chain, frame)
        others[frame] = Poses(*chain_poses(part.flat, np.ascontiguousarray(qs[:, columns])))
    certificate = certify_poses(robot, chain, qs, {**others, chain.tip_frame: poses})
    return ForwardKinematics(poses, others, certificate)
