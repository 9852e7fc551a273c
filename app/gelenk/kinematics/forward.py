"""Forward kinematics: where the tip is, and every frame that the chain moves."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.certify import Certificate, certify_poses
from gelenk.kinematics.kernels import chain_poses
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.poses import Poses
from gelenk.model.robot import Robot


@dataclass(frozen=True, slots=True)
class ForwardKinematics:
    """Poses at N configurations, in the chain's base frame.

    Attributes:
        poses: T_base_tip, N of them.
        frames: T_base_frame of each requested frame, N of them each.
        certificate: How far Pinocchio's are from all of these.
    """

    poses: Poses
    frames: dict[str, Poses]
    certificate: Certificate


def forward_kinematics(robot: Robot, chain: Chain, qs: Array, frames: Sequence[str] = ()) -> ForwardKinematics:
    """Poses of the tip, and of other frames on the chain, certified.

    Args:
        robot: The robot.
        chain: Base and tip.
        qs: Configurations in the chain's order; shape (N, n), [rad or m].
        frames: Other frames whose poses are wanted.

    Raises:
        UnknownFrame: The robot has no such frame.
        FrameNotOnChain: A frame also moves with joints that the chain does not have.
        CertificationFailed: Pinocchio's poses differ.
    """
    poses = Poses(*chain_poses(chain.flat, qs))
    others = {}
    for frame in frames:
        part, columns = robot.frame_on(chain, frame)
        others[frame] = Poses(*chain_poses(part.flat, np.ascontiguousarray(qs[:, columns])))
    certificate = certify_poses(robot, chain, qs, {**others, chain.tip_frame: poses})
    return ForwardKinematics(poses, others, certificate)
