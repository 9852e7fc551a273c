"""Check with Pinocchio's Jacobian that internal motions leave the tip at rest and lost directions need no torque.

The subspaces come from our own Jacobians, and from the structure of the chain at other configurations; here each is
multiplied by Pinocchio's Jacobian, which must give zero.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import sampled_rows
from gelenk.kinematics.singularity.report import SingularityReport
from gelenk.kinematics.velocity.task_space import STRUCTURAL_TOLERANCE, TaskSpace
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

TOLERANCE = 10.0 * STRUCTURAL_TOLERANCE
"""Allowed excess over the largest singular value counted as zero: relative to the largest, absolute below 1."""


@dataclass(frozen=True, slots=True)
class KernelCertificate:
    """Largest products that should be zero: what remains is rounding, or within the rank tolerance.

    Attributes:
        max_internal_motion: Largest ‖J v‖ over the internal motions v, J having the task's rows.
        max_lost_direction: Largest ‖uᵀ J‖ over the lost directions u of these rows.
    """

    max_internal_motion: float
    max_lost_direction: float


def certify_reports(
    robot: RobotModel, chain: Chain, space: TaskSpace, qs: Array, reports: Sequence[SingularityReport], seed: int = 0
) -> KernelCertificate:
    """Check the internal motions and lost directions of reports with Pinocchio's Jacobians.

    Args:
        robot: The robot.
        chain: Base and tip.
        space: The rows of the Jacobian that count.
        qs: Configurations; shape (N, n), [rad or m].
        reports: One report per configuration.
        seed: Seed of the sample selection in a large batch.

    Raises:
        CertificationFailed: An internal motion moves the tip, or a lost direction loads a joint, by more than the
            singular values allow.
    """
    moved, felt = 0.0, 0.0
    for row in sampled_rows(len(qs) if len(chain) else 0, seed):
        report = reports[row]
        J = space.picked(_pinocchio_jacobian(robot, chain, space, qs[row])[None])[0]
        # The structure was found with unscaled rows.
        size = max(1.0, float(report.sigmas.max(initial=0.0)), float(space.scales.max()))
        moved = max(moved, _demand("the tip's rest", J @ report.internal_motions, report, size))
        felt = max(felt, _demand("a lost direction", J.T @ report.lost_directions, report, size))
    return KernelCertificate(moved, felt)


def _demand(quantity: str, products: Array, report: SingularityReport, size: float) -> float:
    """Length of the longest column, refused where it exceeds the largest singular value counted as zero."""
    longest = float(np.linalg.norm(products, axis=0).max(initial=0.0))
    passed = float(report.sigmas[report.rank :].max(initial=0.0))
    allowed = passed + TOLERANCE * size
    if not longest <= allowed:
        raise CertificationFailed(quantity, longest, allowed)
    return longest


def _pinocchio_jacobian(robot: RobotModel, chain: Chain, space: TaskSpace, q: Array) -> Array:
    """Pinocchio's Jacobian of the tip relative to the base, in the reference; shape (6, n).

    In the tip's axes it is J_tip - Ad(T_tip_base) J_base, each in its own frame; other references need one more map.
    """
    expansion = robot.expansion(chain)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    with robot.lock:
        pin.computeJointJacobians(robot.model, robot.data, expansion.offset + expansion.matrix @ q)
        T_base, T_tip = (pin.updateFramePlacement(robot.model, robot.data, frame).copy() for frame in frames)
        J_base, J_tip = (pin.getFrameJacobian(robot.model, robot.data, frame, pin.LOCAL) for frame in frames)
    # For a robot with one joint Pinocchio returns a flat (6,).
    J_base, J_tip = (columns.reshape(6, -1) @ expansion.matrix for columns in (J_base, J_tip))
    T = T_base.actInv(T_tip)
    J = J_tip - T.toActionMatrixInverse() @ J_base
    if space.reference == "local":
        return np.asarray(J)
    lever = T.translation if space.reference == "world" else np.zeros(3)
    return np.asarray(pin.SE3(T.rotation, lever).toActionMatrix() @ J)
