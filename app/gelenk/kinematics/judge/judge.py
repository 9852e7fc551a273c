"""Recomputation of results through Pinocchio, and the differences between the two computations.

Kernels and Pinocchio share only the checked description. A result that differs by more than rounding is never sent.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
import pinocchio as pin

from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME, describe_dh
from gelenk.errors import CertificationFailed
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.dh import DhTable
from gelenk.robot.notations import pose_errors
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

View: TypeAlias = Literal["local_world_aligned", "local", "world", "zyz", "rpy"]
"""Reference frame of a Jacobian, or the Euler angles whose rates its angular rows give."""

MAX_SAMPLES = 16
"""Number of configurations that are recomputed in a batch; a smaller batch is recomputed in full."""
TABLE_SAMPLES = 100
"""Number of configurations at which a table is compared with a robot."""
TOLERANCE = 1e-9
"""Allowed difference: relative to the largest number compared, absolute where that is below 1."""

_REACH = 10.0
"""Largest distance of a sample from the allowed position nearest zero, [rad or m]: 1e6 m stands for no limit."""


@dataclass(frozen=True, slots=True)
class PoseCertificate:
    """Agreement of poses with Pinocchio's.

    Attributes:
        samples: Number of configurations recomputed through Pinocchio.
        max_position_error: Largest distance between the positions, [m].
        max_orientation_error: Largest angle between the orientations, [rad].
        seed: Seed of the sample selection.
    """

    samples: int
    max_position_error: float
    max_orientation_error: float
    seed: int


@dataclass(frozen=True, slots=True)
class JacobianCertificate:
    """Agreement of Jacobians with Pinocchio's.

    Attributes:
        samples: Number of configurations recomputed through Pinocchio.
        max_error: Largest difference in an entry of the Jacobian, [m, rad per rad or m].
        max_time_variation_error: Largest difference in an entry of J̇, if derivatives were requested.
        seed: Seed of the sample selection.
    """

    samples: int
    max_error: float
    max_time_variation_error: float | None
    seed: int


def certify_poses(
    robot: RobotModel, chain: Chain, qs: Array, frames: Mapping[str, Poses], seed: int = 0
) -> PoseCertificate:
    """Compare poses with Pinocchio's.

    Args:
        robot: The robot.
        chain: The chain in whose base the poses are expressed.
        qs: Configurations of the chain; shape (N, n), [rad or m].
        frames: Poses of one or more frames at these configurations, N each.
        seed: Seed of the sample selection in a large batch.

    Raises:
        CertificationFailed: The two differ by more than `TOLERANCE`.
    """
    rows = sampled_rows(len(qs), seed)
    worst_distance, worst_angle = 0.0, 0.0
    for name, poses in frames.items():
        samples = poses if len(rows) == len(qs) else Poses(poses.positions[rows], poses.rotations[rows])
        judge = pinocchio_poses(robot, chain, name, qs, rows)
        distance, angle, extent = pose_errors(samples.positions, samples.rotations, judge.positions, judge.rotations)
        worst_distance = max(worst_distance, demand("a position", distance, extent))
        worst_angle = max(worst_angle, demand("an orientation", angle, 1.0))
    return PoseCertificate(len(rows), worst_distance, worst_angle, seed)


def certify_jacobians(
    robot: RobotModel,
    chain: Chain,
    qs: Array,
    Js: Array,
    hessians: Array | None = None,
    view: View = "local_world_aligned",
    values: Array | None = None,
    seed: int = 0,
) -> JacobianCertificate:
    """Compare geometric Jacobians (in the base frame, at the tip) with Pinocchio's, and ∂J/∂q through J̇.

    Args:
        robot: The robot.
        chain: The chain.
        qs: Configurations of the chain; shape (N, n), [rad or m].
        Js: Geometric Jacobians; shape (N, 6, n).
        hessians: ∂J/∂q of these; shape (N, 6, n, n).
        view: The reference frame, or the angles, of `values`.
        values: The Jacobians that are sent; shape (N, 6, n). Not compared if None.
        seed: Seed of the sample selection in a large batch, and of the joint velocities for J̇.

    Raises:
        CertificationFailed: The two differ by more than `TOLERANCE`.
    """
    # Without joints there is no column to compare, and Pinocchio crashes on the Jacobian of a robot without joints.
    rows = sampled_rows(len(qs) if len(chain) else 0, seed)
    speeds = np.random.default_rng(seed).uniform(-1.0, 1.0, len(chain))
    worst, worst_rate = 0.0, 0.0
    for row in rows:
        T_base_tip, J, J_dot = _jacobian(robot, chain, qs[row], speeds, with_rate=hessians is not None)
        worst = max(worst, demand("the Jacobian", _largest(J - Js[row]), _largest(J)))
        if values is not None:
            error = _view_error(view, T_base_tip, J, values[row])
            worst = max(worst, demand("the Jacobian", error, _largest(values[row])))
        if hessians is not None:
            error = _largest(J_dot - hessians[row] @ speeds)
            worst_rate = max(worst_rate, demand("the Jacobian's derivative", error, _largest(J_dot)))
    return JacobianCertificate(len(rows), worst, worst_rate if hessians is not None else None, seed)


def certify_table(
    robot: RobotModel, chain: Chain, table: DhTable, *, exact: bool = True, seed: int = 0
) -> PoseCertificate:
    """Compare the product of a table's own transforms with Pinocchio's poses of a robot's chain.

    Args:
        robot: The robot.
        chain: A chain of this robot; its variables are the table's, in the same order.
        table: The table that should describe the chain.
        exact: Whether to refuse more than rounding, at the scale of the table's longest length; a table that was
            simplified on purpose may differ by more.
        seed: Seed of `table_configurations`.

    Raises:
        CertificationFailed: The two differ although the table should be exact, or a difference is NaN.
    """
    qs = table_configurations(chain, TABLE_SAMPLES, seed)
    Ts = np.array([table.pose(q) for q in qs.tolist()])
    ours = Poses(np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3]))
    judge = pinocchio_poses(robot, chain, chain.tip_frame, qs, range(len(qs)))
    return _table_certificate(ours, judge, table, exact, seed)


def certify_conversion(table: DhTable, other: DhTable, seed: int = 0) -> PoseCertificate:
    """Compare two tables of the same variables, each as a robot in Pinocchio.

    Raises:
        CertificationFailed: The two differ by more than rounding.
    """
    robots = [RobotModel(describe_dh("table", described)) for described in (table, other)]
    chains = [robot.chain(BASE_FRAME, TOOL_FRAME) for robot in robots]
    qs = table_configurations(chains[0], TABLE_SAMPLES, seed)
    ours, judge = (
        pinocchio_poses(robot, chain, TOOL_FRAME, qs, range(len(qs)))
        for robot, chain in zip(robots, chains, strict=True)
    )
    return _table_certificate(ours, judge, table, True, seed)


def table_configurations(chain: Chain, count: int, seed: int = 0) -> Array:
    """Draw random configurations of a chain: half within the limits, half with revolute joints over a full turn.

    Both are uniform: `numpy.random.default_rng(seed)` gives one number in [0, 1) per entry, row by row, which is scaled
    to the bounds. A limit more than 10 rad or m from the allowed position nearest zero is replaced by that distance.

    Returns:
        Shape (count, n), [rad or m].
    """
    next_to_zero = np.clip(0.0, chain.lower, chain.upper)
    lower = np.tile(np.maximum(chain.lower, next_to_zero - _REACH), (count, 1))
    upper = np.tile(np.minimum(chain.upper, next_to_zero + _REACH), (count, 1))
    slides = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    turns = [j for j in range(len(chain)) if j not in slides]
    lower[count // 2 :, turns], upper[count // 2 :, turns] = -np.pi, np.pi
    qs: Array = lower + np.random.default_rng(seed).random((count, len(chain))) * (upper - lower)
    return qs


def _table_certificate(ours: Poses, judge: Poses, table: DhTable, exact: bool, seed: int) -> PoseCertificate:
    distance, angle, extent = pose_errors(ours.positions, ours.rotations, judge.positions, judge.rotations)
    longest = max(abs(length) for row in table.joints for length in (row.a, row.d))
    scale = max(extent, longest, float(np.abs([table.base[:3, 3], table.tool[:3, 3]]).max()))
    demand("a position", distance, scale if exact else np.inf)
    demand("an orientation", angle, len(table.joints) if exact else np.inf)
    return PoseCertificate(len(judge), distance, angle, seed)


def sampled_rows(count: int, seed: int = 0) -> Sequence[int]:
    """Return the rows of a batch to recompute: all of a small batch, else `MAX_SAMPLES` random ones."""
    if count <= MAX_SAMPLES:
        return range(count)
    return sorted(np.random.default_rng(seed).choice(count, MAX_SAMPLES, replace=False).tolist())


def _largest(difference: Array) -> float:
    return float(np.abs(difference).max(initial=0.0))


def demand(quantity: str, error: float, scale: float) -> float:
    """Return the error if rounding of numbers of this scale explains it.

    Raises:
        CertificationFailed: The error is larger, or NaN.
    """
    tolerance = TOLERANCE * max(1.0, scale)
    if not error <= tolerance:
        raise CertificationFailed(quantity, error, tolerance)
    return error


def agreed(quantity: str, difference: Array, scale: float) -> float:
    """Return the largest absolute entry of a difference; raises as `demand` does."""
    return demand(quantity, _largest(difference), scale)


def pinocchio_poses(robot: RobotModel, chain: Chain, frame: str, qs: Array, rows: Sequence[int]) -> Poses:
    """Compute T_base_frame through Pinocchio at the configurations with the given row numbers."""
    model, data, lock = robot.model, robot.data, robot.lock
    expansion = robot.expansion(chain)
    base, tip = robot.frame_id(chain.base_frame), robot.frame_id(frame)
    full_qs = expansion.offset + (qs if len(rows) == len(qs) else qs[rows]) @ expansion.matrix.T
    positions, rotations = np.empty((len(rows), 3)), np.empty((len(rows), 3, 3))
    for k, q in enumerate(full_qs):
        with lock:
            pin.forwardKinematics(model, data, q)
            T_base_frame = pin.updateFramePlacement(model, data, tip)
            if chain.base_frame != robot.description.root:
                T_base_frame = pin.updateFramePlacement(model, data, base).actInv(T_base_frame)
            positions[k], rotations[k] = T_base_frame.translation, T_base_frame.rotation
    return Poses(positions, rotations)


def _view_error(view: View, T_base_tip: pin.SE3, J: Array, value: Array) -> float:
    """Largest difference between a Jacobian (6, n) in some view and the geometric one, by Pinocchio's spatial algebra.

    Euler rates are converted back into an angular velocity: by Pinocchio for RPY, and for ZYZ by the three rotation
    axes, which are the base's z, the common normal of both z axes, and the tip's z.
    """
    if view == "local":
        return _largest(pin.SE3(T_base_tip.rotation, np.zeros(3)).toActionMatrixInverse() @ J - value)
    if view == "world":
        return _largest(pin.SE3(np.eye(3), T_base_tip.translation).toActionMatrix() @ J - value)
    axes = np.eye(3)
    if view == "rpy":
        axes = pin.rpy.computeRpyJacobian(pin.rpy.matrixToRpy(T_base_tip.rotation), pin.LOCAL_WORLD_ALIGNED)
    elif view == "zyz":
        z, tip_z = np.array([0.0, 0.0, 1.0]), T_base_tip.rotation[:, 2]
        normal = np.cross(z, tip_z)
        axes = np.column_stack((z, normal / np.linalg.norm(normal), tip_z))
    return _largest(np.vstack((value[:3], axes @ value[3:])) - J)


def _jacobian(
    robot: RobotModel, chain: Chain, q: Array, speeds: Array, *, with_rate: bool
) -> tuple[pin.SE3, Array, Array]:
    """Pinocchio's T_base_tip, geometric Jacobian and its time variation at given joint velocities, both (6, n).

    Pinocchio gives both for each frame relative to the world. With r from base to tip, in the world's axes, the linear
    rows of the relative Jacobian are Rᵀ(J_tip - J_base - ω_base × r) and the angular rows Rᵀ(J_tip - J_base), where R
    is the base's rotation; its time variation follows by the product rule.
    """
    expansion = robot.expansion(chain)
    full_q, full_speeds = expansion.offset + expansion.matrix @ q, expansion.matrix @ speeds
    with robot.lock:
        T_base, T_tip, J_base, J_tip = _world_jacobians(robot, chain, full_q)
        D_base, D_tip = _world_variations(robot, chain, full_q, full_speeds) if with_rate else (J_base, J_tip)
    # For a robot with one joint Pinocchio returns a flat (6,).
    J_base, J_tip, D_base, D_tip = (
        columns.reshape(6, -1) @ expansion.matrix for columns in (J_base, J_tip, D_base, D_tip)
    )
    R, arm = T_base.rotation, pin.skew(T_tip.translation - T_base.translation)
    J_world = J_tip - J_base
    J_world[:3] += arm @ J_base[3:]
    D_world = D_tip - D_base
    if with_rate:
        arm_dot, turning = pin.skew((J_tip[:3] - J_base[:3]) @ speeds), pin.skew(J_base[3:] @ speeds)
        D_world[:3] += arm @ D_base[3:] + arm_dot @ J_base[3:] - turning @ J_world[:3]
        D_world[3:] -= turning @ J_world[3:]
    J, D = ((R.T @ rows.reshape(2, 3, -1)).reshape(6, -1) for rows in (J_world, D_world))
    return T_base.actInv(T_tip), J, D


def _world_jacobians(robot: RobotModel, chain: Chain, q: Array) -> tuple[pin.SE3, pin.SE3, Array, Array]:
    """T_world_base, T_world_tip, and the Jacobians of both frames in the world's axes, (6, nv) each."""
    pin.computeJointJacobians(robot.model, robot.data, q)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    T_base, T_tip = (pin.updateFramePlacement(robot.model, robot.data, frame).copy() for frame in frames)
    J_base, J_tip = (pin.getFrameJacobian(robot.model, robot.data, frame, pin.LOCAL_WORLD_ALIGNED) for frame in frames)
    return T_base, T_tip, J_base, J_tip


def _world_variations(robot: RobotModel, chain: Chain, q: Array, speeds: Array) -> tuple[Array, Array]:
    """Time variations of the Jacobians of both frames in the world's axes, (6, nv) each."""
    pin.computeJointJacobiansTimeVariation(robot.model, robot.data, q, speeds)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    for frame in frames:
        pin.updateFramePlacement(robot.model, robot.data, frame)
    D_base, D_tip = (
        pin.getFrameJacobianTimeVariation(robot.model, robot.data, frame, pin.LOCAL_WORLD_ALIGNED) for frame in frames
    )
    return D_base, D_tip
