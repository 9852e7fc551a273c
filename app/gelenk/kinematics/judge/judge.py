"""Recomputation of results through Pinocchio, and the differences between the two computations.

Kernels and Pinocchio share only the checked description. A result that differs by more than rounding is never sent.
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.placements import expand, relative_poses, walk_to
from gelenk.kinematics.judge.words import JacobianCertificate, PoseCertificate, Reference, View
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.notations import pose_errors
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

_KEPT = 64
"""Frames whose place in a workspace is remembered; each keeps its robot."""
MAX_SAMPLES = 16
"""Number of configurations that are recomputed in a batch; a smaller batch is recomputed in full."""
TOLERANCE = 1e-9
"""Allowed difference: relative to the largest number compared, absolute where that is below 1."""


def sampled_rows(count: int, seed: int = 0) -> Sequence[int]:
    """Return the rows of a batch to recompute: all of a small batch, else `MAX_SAMPLES` random ones."""
    return range(count) if count <= MAX_SAMPLES else list(_random_rows(count, seed))


@lru_cache
def _random_rows(count: int, seed: int) -> tuple[int, ...]:
    return tuple(sorted(np.random.default_rng(seed).choice(count, MAX_SAMPLES, replace=False).tolist()))


def agreed(quantity: str, difference: Array | float, scale: float, slack: float = 0.0) -> float:
    """Return the largest absolute entry of a difference if rounding of numbers of this scale, and a slack, explain it.

    Raises CertificationFailed if it is larger, or NaN.
    """
    error, tolerance = largest(difference), slack + TOLERANCE * max(1.0, scale)
    if not error <= tolerance:
        raise CertificationFailed(quantity, error, tolerance)
    return error


def largest(values: Array | float) -> float:
    """Return the largest absolute value; 0 if there is none."""
    return abs(values) if isinstance(values, float) else float(np.abs(values).max(initial=0.0))


class Differences(dict[str, float]):
    """The largest difference so far, by field of a certificate."""

    def add(self, field: str, quantity: str, difference: Array | float, scale: float, slack: float = 0.0) -> None:
        """Count one more difference; raises as `agreed` does."""
        self[field] = max(self.get(field, 0.0), agreed(quantity, difference, scale, slack))


def certify_poses(
    robot: RobotModel, chain: Chain, qs: Array, frames: Mapping[str, Poses], seed: int = 0
) -> PoseCertificate:
    """Compare poses with Pinocchio's; raises CertificationFailed if they differ by more than `TOLERANCE`.

    The configurations, shape (N, n), are those of the chain in whose base the poses are expressed.
    """
    rows = sampled_rows(len(qs), seed)
    return _compared(robot, chain, _expanded(robot, chain, _taken(qs, rows)), frames, rows, seed)


def _compared(
    robot: RobotModel, chain: Chain, full_qs: Array, frames: Mapping[str, Poses], rows: Sequence[int], seed: int = 0
) -> PoseCertificate:
    """Compare the given rows of the poses with Pinocchio's at its configurations, shape (number of rows, nq)."""
    position_error = orientation_error = 0.0
    for name, poses in frames.items():
        ours = poses if len(rows) == len(poses) else Poses(poses.positions[rows], poses.rotations[rows])
        judge = poses_at(robot, chain, name, full_qs)
        distance, angle = agreed_pose(*pose_errors(ours.positions, ours.rotations, judge.positions, judge.rotations))
        position_error, orientation_error = max(position_error, distance), max(orientation_error, angle)
    return PoseCertificate(len(rows), position_error, orientation_error, seed)


def agreed_pose(distance: float, angle: float, extent: float) -> tuple[float, float]:
    """Return distance [m] and angle [rad] of `pose_errors`; raises as `agreed` does."""
    if distance <= TOLERANCE and angle <= TOLERANCE:  # as nearly always
        return distance, angle
    return agreed("a position", distance, extent), agreed("an orientation", angle, 1.0)


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
    """Compare geometric Jacobians (in the base frame, at the tip) with Pinocchio's, and ∂J/∂q through J̇; see `agreed`.

    Args:
        Js, hessians: Geometric Jacobians, shape (N, 6, n), and their ∂J/∂q, shape (N, 6, n, n).
        values: The Jacobians that are sent, in the view; shape (N, 6, n). Not compared if None, or the geometric ones
            themselves.
        seed: Seed of the sample selection in a large batch, and of the joint velocities for J̇.
    """
    # Without joints there is no column to compare, and Pinocchio crashes on the Jacobian of a robot without joints.
    rows = sampled_rows(len(qs) if len(chain) else 0, seed)
    speeds = np.random.default_rng(seed).uniform(-1.0, 1.0, len(chain))
    worst = Differences(max_error=0.0)
    rates = None if hessians is None else Differences(max_time_variation_error=0.0)
    for row in rows:
        T_base_tip, local, local_dot = _tip_jacobian(robot, chain, qs[row], speeds if rates is not None else None)
        turn = from_tip(T_base_tip, "local_world_aligned").toActionMatrix()
        J = turn @ local
        worst.add("max_error", "the Jacobian", J - Js[row], largest(J))
        if values is not None and values is not Js:
            value = values[row]
            match view:
                case "zyz" | "rpy":
                    error = np.vstack((value[:3], _angular_velocities(view, T_base_tip) @ value[3:])) - J
                case "space_screws":
                    error = np.roll(T_base_tip.toActionMatrix() @ local, 3, axis=0) - value
                case "body_screws":
                    error = np.roll(local, 3, axis=0) - value
                case _:
                    error = from_tip(T_base_tip, view).toActionMatrix() @ local - value
            worst.add("max_error", "the Jacobian", error, largest(value))
        if rates is not None and hessians is not None:
            # The base's axes turn as seen from the tip's.
            turning = pin.Motion(np.zeros(3), (local @ speeds)[3:]).action
            J_dot = turn @ (local_dot + turning @ local)
            error = J_dot - hessians[row] @ speeds
            rates.add("max_time_variation_error", "the Jacobian's derivative", error, largest(J_dot))
    return JacobianCertificate(
        len(rows), worst["max_error"], None if rates is None else rates["max_time_variation_error"], seed
    )


class Testimony(NamedTuple):
    """What Pinocchio has to say of N configurations of a chain.

    Attributes:
        base, tip: The walks through its model to both ends, see `walk_to`.
        full_qs: Its configurations; shape (N, nq).
        rows: Of which of them its own poses follow: all of a few, a sample of many; shape (K,).
        positions, rotations: Its T_base_tip there; shape (K, 3), [m], and (K, 3, 3).
    """

    base: Array
    tip: Array
    full_qs: Array
    rows: Indices
    positions: Array
    rotations: Array


def testimony(robot: RobotModel, chain: Chain, qs: Array, *, is_draft: bool = False) -> Testimony:
    """Return what Pinocchio has to say of configurations (N, n); without poses of its own if they are a draft."""
    base, tip, full_qs = walk_to(robot, chain.base_frame), walk_to(robot, chain.tip_frame), _expanded(robot, chain, qs)
    rows = sample(0 if is_draft else len(qs))
    own = poses_at(robot, chain, chain.tip_frame, _taken(full_qs, rows))
    return Testimony(base, tip, full_qs, rows, own.positions, own.rotations)


@lru_cache
def sample(count: int) -> Indices:
    """Return the `sampled_rows` of a batch as an array."""
    return np.array(sampled_rows(count), dtype=np.int64)


def recomputed_poses(robot: RobotModel, chain: Chain, qs: Array) -> Poses:
    """Compute T_base_tip over the placements of Pinocchio's model; shape (N, n) → N poses.

    Pinocchio's own poses must agree: all of a few, a sample of many. Raises CertificationFailed.
    """
    base, tip, full_qs, rows, *own = testimony(robot, chain, qs)
    positions, rotations = relative_poses(base, tip, full_qs)
    agreed_pose(*pose_errors(positions[rows], rotations[rows], *own))
    return Poses(positions, rotations)


def pinocchio_poses(robot: RobotModel, chain: Chain, frame: str, qs: Array, rows: Sequence[int]) -> Poses:
    """Compute T_base_frame through Pinocchio at the configurations with the given row numbers."""
    return poses_at(robot, chain, frame, _expanded(robot, chain, _taken(qs, rows)))


def _taken(qs: Array, rows: Sequence[int] | Indices) -> Array:
    return qs if len(rows) == len(qs) else qs[rows]


def poses_at(robot: RobotModel, chain: Chain, frame: str, full_qs: Array) -> Poses:
    """Compute T_base_frame through Pinocchio at its configurations, shape (N, nq)."""
    model, data = robot.model, robot.data
    tip, position, rotation = _placement(robot, frame)
    base = None if chain.base_frame == robot.description.root else robot.frame_id(chain.base_frame)
    positions, rotations = np.empty((len(full_qs), 3)), np.empty((len(full_qs), 3, 3))
    with robot.lock:
        for k, full_q in enumerate(full_qs):
            pin.forwardKinematics(model, data, full_q)
            pin.updateFramePlacement(model, data, tip)
            if base is not None:
                T_base_frame = pin.updateFramePlacement(model, data, base).actInv(data.oMf[tip])
                position, rotation = T_base_frame.translation, T_base_frame.rotation
            positions[k], rotations[k] = position, rotation
    return Poses(positions, rotations)


@lru_cache(_KEPT)
def _placement(robot: RobotModel, frame: str) -> tuple[int, Array, Array]:
    """Return Pinocchio's index of a frame, its position (3,) and rotation (3, 3); raises UnknownFrame.

    The arrays are views of the robot's workspace and change with it: making them takes as long as computing the pose.
    """
    index = robot.frame_id(frame)
    placement = robot.data.oMf[index]
    return index, placement.translation, placement.rotation


def _expanded(robot: RobotModel, chain: Chain, qs: Array) -> Array:
    expansion = robot.expansion(chain)
    full_qs = np.empty((len(qs), len(expansion.offset)))
    expand(expansion.offset, expansion.matrix, np.ascontiguousarray(qs), full_qs)
    return full_qs


def pinocchio_jacobian(robot: RobotModel, chain: Chain, q: Array, reference: Reference) -> Array:
    """Compute the geometric Jacobian of the tip relative to the base through Pinocchio; (n,) → (6, n), n ≥ 1."""
    T_base_tip, J, _ = _tip_jacobian(robot, chain, q)
    return np.asarray(from_tip(T_base_tip, reference).toActionMatrix() @ J)


def from_tip(T_base_tip: pin.SE3, reference: Reference) -> pin.SE3:
    """Return the transform that takes a twist from the tip's axes into a reference."""
    if reference == "local":
        return pin.SE3.Identity()
    return T_base_tip if reference == "world" else pin.SE3(T_base_tip.rotation, np.zeros(3))


def _tip_jacobian(
    robot: RobotModel, chain: Chain, q: Array, speeds: Array | None = None
) -> tuple[pin.SE3, Array, Array | None]:
    """T_base_tip, and in the tip's axes the Jacobian and its time variation at given joint velocities, (6, n) each.

    Pinocchio gives both for each frame relative to the world, in that frame's axes. With A = Ad(T⁻¹) the Jacobian is
    J = J_tip - A J_base, and by the product rule J̇ = J̇_tip - A J̇_base + ad(J q̇) A J_base.
    """
    model, data, expansion = robot.model, robot.data, robot.expansion(chain)
    frames = robot.frame_id(chain.base_frame), robot.frame_id(chain.tip_frame)
    full_q = expansion.offset + expansion.matrix @ q
    kinds = [pin.getFrameJacobian]
    with robot.lock:
        if speeds is None:
            pin.computeJointJacobians(model, data, full_q)
        else:
            pin.computeJointJacobiansTimeVariation(model, data, full_q, expansion.matrix @ speeds)
            kinds.append(pin.getFrameJacobianTimeVariation)
        T_base, T_tip = (pin.updateFramePlacement(model, data, frame).copy() for frame in frames)
        # For a robot with one joint Pinocchio returns a flat (6,).
        (J_base, J_tip), *rates = [
            [kind(model, data, frame, pin.LOCAL).reshape(6, -1) @ expansion.matrix for frame in frames]
            for kind in kinds
        ]
    T = T_base.actInv(T_tip)
    A = T.toActionMatrixInverse()
    carried = A @ J_base
    J = J_tip - carried
    if not rates:
        return T, J, None
    D_base, D_tip = rates[0]
    return T, J, D_tip - A @ D_base + pin.Motion(J @ speeds).action @ carried


def _angular_velocities(view: View, T_base_tip: pin.SE3) -> Array:
    """Matrix from the rates of Euler angles to the angular velocity: RPY by Pinocchio, ZYZ by its rotation axes."""
    if view == "rpy":
        return np.asarray(pin.rpy.computeRpyJacobian(pin.rpy.matrixToRpy(T_base_tip.rotation), pin.LOCAL_WORLD_ALIGNED))
    # The base's z, the common normal of both z axes, and the tip's z.
    z, tip_z = np.array([0.0, 0.0, 1.0]), T_base_tip.rotation[:, 2]
    normal = np.cross(z, tip_z)
    return np.column_stack((z, normal / np.linalg.norm(normal), tip_z))
