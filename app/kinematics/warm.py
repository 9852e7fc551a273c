"""Compile every kernel, or read it from its cache, before the first caller waits for it."""

import math

import numpy as np

from app.kinematics.configuration import configurations
from app.kinematics.forward import forward_kinematics
from app.kinematics.ik.search import mid_range, start_of
from app.kinematics.ik.solve import Options, inverse_kinematics
from app.kinematics.jacobian import jacobians
from app.kinematics.kernels import chain_measures
from app.model.compilation import note_stored
from app.model.convert import describe_dh
from app.model.dh import DhJoint, DhTable
from app.model.notations import (
    quaternions_xyzw_from_rotations,
    rotations_from_quaternions_xyzw,
    rotations_from_vectors,
    rotations_from_zyz,
    vectors_from_rotations,
)
from app.model.poses import Poses
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
    targets = Poses(np.array([[0.4, 0.3, 0.2]]), np.ascontiguousarray(Rs))
    for every in (False, True):
        inverse_kinematics(robot, chain, targets, mid_range(chain)[None], Options(every=every))
    inverse_kinematics(robot, chain, targets, mid_range(chain)[None], Options(trace=True, max_iterations=1))
    _closed_forms()
    chain_measures(chain.flat, qs, np.arange(3))
    start_of(chain, mid_range(chain), True, 0, 1)
    rotations_from_quaternions_xyzw(quaternions_xyzw_from_rotations(Rs))
    rotations_from_vectors(vectors_from_rotations(Rs))
    rotations_from_zyz(np.zeros((1, 3)))
    note_stored()


def _closed_forms() -> None:
    """An arm with a free elbow: its kernels are those of every closed form."""
    alphas = (-0.5, 0.5, 0.5, -0.5, -0.5, 0.5, 0.0)
    lengths = (0.3, 0.0, 0.3, 0.0, 0.3, 0.0, 0.3)
    rows = [
        DhJoint(f"joint_{i}", "revolute", 0.0, math.pi * alpha, d, 0.0)
        for i, (alpha, d) in enumerate(zip(alphas, lengths, strict=True))
    ]
    robot = Robot(describe_dh("warm-up", DhTable("standard", tuple(rows))))
    chain = robot.chain(None, None)
    qs = np.full((1, 7), 0.4)
    poses = forward_kinematics(robot, chain, qs).poses
    for every in (False, True):
        inverse_kinematics(robot, chain, poses, qs, Options(every=every, method="analytic"))
