"""Compile every kernel, or read it from its cache, before the first caller waits for it."""

import numpy as np

from app.kinematics.configuration import configurations
from app.kinematics.forward import forward_kinematics
from app.kinematics.jacobian import jacobians
from app.model.convert import describe_dh
from app.model.dh import DhJoint, DhTable
from app.model.poses import (
    quaternions_xyzw_from_rotations,
    rotations_from_quaternions_xyzw,
    rotations_from_vectors,
    rotations_from_zyz,
    vectors_from_rotations,
)
from app.model.robot import Robot


def warm_up() -> None:
    """Compute one of everything, on a small arm of our own."""
    rows = [DhJoint(f"joint_{i}", "revolute", 0.3, 1.0, 0.1, 0.5) for i in (1, 2, 3)]
    robot = Robot(describe_dh("warm-up", DhTable("standard", tuple(rows))))
    chain = robot.chain(None, None)
    qs = configurations(chain, [[0.1, 0.2, 0.3]])
    forward_kinematics(robot, chain, qs)
    for representation in ("zyz", "rpy"):
        Rs = jacobians(robot, chain, qs, representation=representation, derivatives=True).poses.rotations
    rotations_from_quaternions_xyzw(quaternions_xyzw_from_rotations(Rs))
    rotations_from_vectors(vectors_from_rotations(Rs))
    rotations_from_zyz(np.zeros((1, 3)))
