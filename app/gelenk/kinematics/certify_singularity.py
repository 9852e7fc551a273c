"""Whether Pinocchio's Jacobian agrees that internal motions leave the tip at rest and lost directions bear for free.

The subspaces come from our own Jacobians, and from the structure of the chain at other configurations: here both are
held against the one product that they are about.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from gelenk.kinematics.certify import sampled_rows
from gelenk.kinematics.singularity import SingularityReport
from gelenk.kinematics.task_space import STRUCTURAL_TOLERANCE, TaskSpace
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.errors import CertificationFailed
from gelenk.model.robot import Robot

TOLERANCE = 10.0 * STRUCTURAL_TOLERANCE
"""Allowed beyond the first singular value that does not count, absolute and relative to the largest."""


@dataclass(frozen=True, slots=True)
class KernelCertificate:
    """What is left where the products are to vanish: rounding, or what the tolerance of the rank lets pass.

    Attributes:
        max_internal_motion: Largest ‖J v‖ of the rows that count over the internal motions v.
        max_lost_direction: Largest ‖uᵀ J‖ over the lost directions u of these rows.
    """

    max_internal_motion: float
    max_lost_direction: float


def certify_reports(
    robot: Robot, chain: Chain, space: TaskSpace, qs: Array, reports: Sequence[SingularityReport], seed: int = 0
) -> KernelCertificate:
    """Multiply what reports say of their configurations with Pinocchio's Jacobians there.

    Args:
        robot: The robot.
        chain: Base and tip.
        space: The rows that count.
        qs: Configurations; shape (N, n), [rad or m].
        reports: One for each.
        seed: Chooses the samples of a large batch, as of the Jacobians.

    Raises:
        CertificationFailed: A motion moves the tip, or a joint feels a wrench, by more than the singular values say.
    """
    moved, felt = 0.0, 0.0
    for row in sampled_rows(len(qs) if len(chain) else 0, seed):
        report = reports[row]
        J = space.picked(_pinocchio_jacobian(robot, chain, space, qs[row])[None])[0]
        # The structure is that of rows without a length.
        size = max(1.0, float(report.sigmas.max(initial=0.0)), float(space.scales.max()))
        moved = max(moved, _demand("the tip's rest", J @ report.internal_motions, report, size))
        felt = max(felt, _demand("a lost direction", J.T @ report.lost_directions, report, size))
    return KernelCertificate(moved, felt)


def _demand(quantity: str, products: Array, report: SingularityReport, size: float) -> float:
    """The longest column, where the first singular value that does not count explains it."""
    longest = float(np.linalg.norm(products, axis=0).max(initial=0.0))
    passed = float(report.sigmas[report.rank :].max(initial=0.0))
    allowed = passed + TOLERANCE * size
    if not longest <= allowed:
        raise CertificationFailed(quantity, longest, allowed)
    return longest


def _pinocchio_jacobian(robot: Robot, chain: Chain, space: TaskSpace, q: Array) -> Array:
    """Pinocchio's Jacobian of the tip against the base, in the reference; shape (6, n).

    In the tip's axes it is J_tip - Ad(T_tip_base) J_base, of both frames' own; each reference is one action further.
    """
    expansion = robot.expansion(chain)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    with robot.lock:
        pin.computeJointJacobians(robot.model, robot.data, expansion.offset + expansion.matrix @ q)
        T_base, T_tip = (pin.updateFramePlacement(robot.model, robot.data, frame).copy() for frame in frames)
        J_base, J_tip = (pin.getFrameJacobian(robot.model, robot.data, frame, pin.LOCAL) for frame in frames)
    # Of a robot with one joint Pinocchio gives a flat (6,).
    J_base, J_tip = (columns.reshape(6, -1) @ expansion.matrix for columns in (J_base, J_tip))
    T = T_base.actInv(T_tip)
    J = J_tip - T.toActionMatrixInverse() @ J_base
    if space.reference == "local":
        return np.asarray(J)
    lever = T.translation if space.reference == "world" else np.zeros(3)
    return np.asarray(pin.SE3(T.rotation, lever).toActionMatrix() @ J)
