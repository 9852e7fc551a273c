"""The same numbers through Pinocchio, and how far the two computations are apart.

Kernels and Pinocchio share nothing but the checked description. What differs by more than rounding is never sent.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
import pinocchio as pin

from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.convert import BASE_FRAME, TOOL_FRAME, describe_dh
from gelenk.model.dh import DhTable
from gelenk.model.errors import CertificationFailed
from gelenk.model.notations import pose_errors
from gelenk.model.poses import Poses
from gelenk.model.robot import Robot

View: TypeAlias = Literal["local_world_aligned", "local", "world", "zyz", "rpy"]
"""What a Jacobian is expressed in: a reference frame, or rates of angles."""

MAX_SAMPLES = 16
"""Configurations of a batch that are recomputed; all of a smaller one."""
TABLE_SAMPLES = 100
"""Configurations at which a table is compared with a robot."""
TOLERANCE = 1e-9
"""Allowed difference, absolute and relative to the largest number compared."""

_REACH = 10.0
"""How far from its position next to zero a joint is sampled, [rad or m]: a limit of 1e6 m says that there is none."""


@dataclass(frozen=True, slots=True)
class Certificate:
    """How good an answer is.

    Attributes:
        samples: Configurations that were recomputed through Pinocchio.
        max_position_error: Largest distance between the two, [m].
        max_orientation_error: Largest angle between the two, [rad].
        seed: Of the choice of samples.
    """

    samples: int
    max_position_error: float
    max_orientation_error: float
    seed: int


@dataclass(frozen=True, slots=True)
class JacobianCertificate:
    """How good a Jacobian is.

    Attributes:
        samples: Configurations that were recomputed through Pinocchio.
        max_error: Largest difference of an entry of the geometric Jacobian, [m, rad per rad or m].
        max_time_variation_error: The same of J̇, where derivatives were requested.
        seed: Of the choice of samples.
    """

    samples: int
    max_error: float
    max_time_variation_error: float | None
    seed: int


def certify_poses(robot: Robot, chain: Chain, qs: Array, frames: Mapping[str, Poses], seed: int = 0) -> Certificate:
    """Compare poses with Pinocchio's.

    Args:
        robot: The robot.
        chain: The chain whose base they are expressed in.
        qs: Its configurations; shape (N, n).
        frames: Poses of one or more frames at these configurations, N each.
        seed: Chooses the samples of a large batch.

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
    return Certificate(len(rows), worst_distance, worst_angle, seed)


def certify_jacobians(
    robot: Robot,
    chain: Chain,
    qs: Array,
    Js: Array,
    hessians: Array | None = None,
    view: View = "local_world_aligned",
    values: Array | None = None,
    seed: int = 0,
) -> JacobianCertificate:
    """Compare geometric Jacobians (in the base frame, at the tip) with Pinocchio's, and ∂J/∂q by way of J̇.

    Args:
        robot: The robot.
        chain: The chain.
        qs: Its configurations; shape (N, n).
        Js: Jacobians; shape (N, 6, n).
        hessians: ∂J/∂q of these; shape (N, 6, n, n).
        view: The reference frame, or the angles, of `values`.
        values: The Jacobians as they are sent; shape (N, 6, n), `Js` themselves if left out.
        seed: Chooses the samples of a large batch, and the joint velocities for J̇.

    Raises:
        CertificationFailed: The two differ by more than `TOLERANCE`.
    """
    # Without joints there is no column to compare, and Pinocchio's Jacobian of a robot that has none at all crashes.
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


def certify_table(robot: Robot, chain: Chain, table: DhTable, *, exact: bool = True, seed: int = 0) -> Certificate:
    """Compare the product of a table's own transforms with Pinocchio's poses of a robot's chain.

    Args:
        robot: The robot.
        chain: Of this robot; its variables are the table's, in the same order.
        table: Said to describe the chain.
        exact: Whether more than rounding, at the scale of the table's longest length, is an error; a table that was
            simplified on purpose may differ by more.
        seed: Of the configurations, `table_configurations`.

    Raises:
        CertificationFailed: The two differ though the table is said to be exact, or one is no number.
    """
    qs = table_configurations(chain, TABLE_SAMPLES, seed)
    Ts = np.array([table.pose(q) for q in qs.tolist()])
    ours = Poses(np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3]))
    judge = pinocchio_poses(robot, chain, chain.tip_frame, qs, range(len(qs)))
    return _table_certificate(ours, judge, table, exact, seed)


def certify_conversion(table: DhTable, other: DhTable, seed: int = 0) -> Certificate:
    """Compare two tables of the same variables, the URDF of each through Pinocchio.

    Raises:
        CertificationFailed: The two differ by more than rounding.
    """
    robots = [Robot(describe_dh("table", described)) for described in (table, other)]
    chains = [robot.chain(BASE_FRAME, TOOL_FRAME) for robot in robots]
    qs = table_configurations(chains[0], TABLE_SAMPLES, seed)
    ours, judge = (
        pinocchio_poses(robot, chain, TOOL_FRAME, qs, range(len(qs)))
        for robot, chain in zip(robots, chains, strict=True)
    )
    return _table_certificate(ours, judge, table, True, seed)


def table_configurations(chain: Chain, count: int, seed: int = 0) -> Array:
    """Random configurations of a chain: the first half within the limits, in the others joints turn all the way round.

    Both are uniform, from `numpy.random.default_rng(seed)`: first one number in [0, 1) for each, row by row, and
    these between the bounds. A limit further than 10 rad or m from the position next to zero counts as that far.

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


def _table_certificate(ours: Poses, judge: Poses, table: DhTable, exact: bool, seed: int) -> Certificate:
    distance, angle, extent = pose_errors(ours.positions, ours.rotations, judge.positions, judge.rotations)
    longest = max(abs(length) for row in table.joints for length in (row.a, row.d))
    scale = max(extent, longest, float(np.abs([table.base[:3, 3], table.tool[:3, 3]]).max()))
    demand("a position", distance, scale if exact else np.inf)
    demand("an orientation", angle, len(table.joints) if exact else np.inf)
    return Certificate(len(judge), distance, angle, seed)


def sampled_rows(count: int, seed: int = 0) -> Sequence[int]:
    """The rows of a batch that are recomputed: all of a small one."""
    if count <= MAX_SAMPLES:
        return range(count)
    return sorted(np.random.default_rng(seed).choice(count, MAX_SAMPLES, replace=False).tolist())


def _largest(difference: Array) -> float:
    return float(np.abs(difference).max(initial=0.0))


def demand(quantity: str, error: float, scale: float) -> float:
    """The error, where it is no larger than rounding of numbers of that scale explains; NaN never is.

    Raises:
        CertificationFailed: It is larger.
    """
    tolerance = TOLERANCE * max(1.0, scale)
    if not error <= tolerance:
        raise CertificationFailed(quantity, error, tolerance)
    return error


def agreed(quantity: str, difference: Array, scale: float) -> float:
    """The largest entry of a difference, under the same condition; raises as `demand` does."""
    return demand(quantity, _largest(difference), scale)


def pinocchio_poses(robot: Robot, chain: Chain, frame: str, qs: Array, rows: Sequence[int]) -> Poses:
    """Pinocchio's T_base_frame at some of the configurations, by their numbers."""
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
    """How far a Jacobian (6, n) in some view is from the geometric one, by Pinocchio's algebra of motions.

    For angles the rates are turned back into an angular velocity: by Pinocchio for RPY, and for ZYZ by the three axes
    they turn about, which are the base's z, the normal of both z axes, and the tip's z.
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


def _jacobian(robot: Robot, chain: Chain, q: Array, speeds: Array, *, with_rate: bool) -> tuple[pin.SE3, Array, Array]:
    """Pinocchio's T_base_tip, geometric Jacobian and its time variation at given joint velocities, both (6, n).

    Pinocchio gives both for each frame against the world. With r from base to tip, in the world's axes, the relative
    Jacobian is Rᵀ(J_tip - J_base - ω_base × r) in its linear rows and Rᵀ(J_tip - J_base) in the angular ones, R the
    base's rotation; its time variation follows by the product rule.
    """
    expansion = robot.expansion(chain)
    full_q, full_speeds = expansion.offset + expansion.matrix @ q, expansion.matrix @ speeds
    with robot.lock:
        T_base, T_tip, J_base, J_tip = _world_jacobians(robot, chain, full_q)
        D_base, D_tip = _world_variations(robot, chain, full_q, full_speeds) if with_rate else (J_base, J_tip)
    # Of a robot with one joint Pinocchio gives a flat (6,).
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


def _world_jacobians(robot: Robot, chain: Chain, q: Array) -> tuple[pin.SE3, pin.SE3, Array, Array]:
    """T_world_base, T_world_tip, and both frames' Jacobians in the world's axes, (6, nv) each."""
    pin.computeJointJacobians(robot.model, robot.data, q)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    T_base, T_tip = (pin.updateFramePlacement(robot.model, robot.data, frame).copy() for frame in frames)
    J_base, J_tip = (pin.getFrameJacobian(robot.model, robot.data, frame, pin.LOCAL_WORLD_ALIGNED) for frame in frames)
    return T_base, T_tip, J_base, J_tip


def _world_variations(robot: Robot, chain: Chain, q: Array, speeds: Array) -> tuple[Array, Array]:
    """Time variation of both frames' Jacobians in the world's axes, (6, nv) each."""
    pin.computeJointJacobiansTimeVariation(robot.model, robot.data, q, speeds)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    for frame in frames:
        pin.updateFramePlacement(robot.model, robot.data, frame)
    D_base, D_tip = (
        pin.getFrameJacobianTimeVariation(robot.model, robot.data, frame, pin.LOCAL_WORLD_ALIGNED) for frame in frames
    )
    return D_base, D_tip
