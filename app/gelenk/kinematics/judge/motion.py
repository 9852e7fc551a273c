"""Check of the tip's twist, acceleration, jerk and snap through Pinocchio.

Pinocchio gives each frame's twist, its derivative in the moving frame (the spatial acceleration) and the partial
derivatives of that acceleration, hence the next derivative; its own spatial algebra combines them. It does not give the
snap: that is the difference quotient of the jerk along the motion, with Richardson extrapolation.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np
import pinocchio as pin

from gelenk.kinematics.judge.judge import Differences, from_tip, largest, sampled_rows
from gelenk.kinematics.judge.words import Reference, TipMotionCertificate
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

BodyMotion: TypeAlias = list[pin.Motion]
"""A frame's twist in its own axes, followed by its time derivatives."""

_QUANTITIES = {
    "max_twist_error": "the twist",
    "max_acceleration_error": "the acceleration",
    "max_jerk_error": "the jerk",
    "max_snap_error": "the snap",
}

_STEP, _LEVELS = 0.02, 3
"""First step of the difference quotient, as a share of the time for about 1 rad of joint motion; number of steps."""
_STEPS_LOST = 1e-3
"""Relative increase of the snap's allowed error per radian of joint position."""
_SLOWEST = 1e-6
"""Smallest rate from which that time is computed, [1/s]."""


def certify_motion(
    robot: RobotModel,
    chain: Chain,
    qs: Array,
    rates: Array,
    derivatives: Sequence[Array],
    spatial: Array | None = None,
    reference: Reference = "local_world_aligned",
    seed: int = 0,
) -> TipMotionCertificate:
    """Compare the tip's twist, acceleration, jerk, snap and spatial acceleration, as they are sent, with Pinocchio's.

    Args:
        rates: q̇, q̈, q⃛, q⁗, the first one to four of them; shape (K, N, n), [rad/sᵏ or m/sᵏ].
        derivatives: (ṗ; ω), (p̈; ω̇), … in the reference, K of them; shape (N, 6) each.
    """
    # Without joints nothing moves, and Pinocchio crashes on the Jacobian of a robot without joints.
    rows = sampled_rows(len(qs) if len(chain) else 0, seed)
    worst = Differences(dict.fromkeys(list(_QUANTITIES)[: len(rates)], 0.0))
    if spatial is not None:
        worst["max_spatial_acceleration_error"] = 0.0
    for row in rows:
        judge, judge_spatial = _pinocchio_derivatives(robot, chain, qs[row], rates[:, row], reference)
        scales = motion_scales(robot, chain, qs[[row]], rates[:, [row]])[:, 0].tolist()
        # At large joint positions a double resolves the small steps of the snap's difference quotient less finely.
        scales[3:] = [scale * (1.0 + _STEPS_LOST * largest(qs[row])) for scale in scales[3:]]
        for (field, quantity), expected, ours, scale in zip(
            _QUANTITIES.items(), judge, derivatives, scales, strict=False
        ):
            worst.add(field, quantity, expected - ours[row], scale)
        if spatial is not None and judge_spatial is not None:
            difference = judge_spatial - spatial[row]
            worst.add("max_spatial_acceleration_error", "the spatial acceleration", difference, scales[1])
    return TipMotionCertificate(
        len(rows),
        worst["max_twist_error"],
        worst.get("max_acceleration_error"),
        worst.get("max_spatial_acceleration_error"),
        worst.get("max_jerk_error"),
        worst.get("max_snap_error"),
        seed,
    )


def motion_scales(robot: RobotModel, chain: Chain, qs: Array, rates: Array) -> Array:
    """Estimate how large each derivative of the tip's motion can be; shape (K, N), [m/sᵏ, rad/sᵏ].

    Rounding errors are proportional to this, even where the terms of the derivative cancel.
    """
    extents = 1.0 + np.abs(chain.flat.placements[:, 9:]).sum() + np.abs(qs).sum(axis=1)
    orders = np.arange(1, len(rates) + 1)[:, None]
    # The combined rate of all joints is the largest k-th root of a k-th derivative, [1/s].
    totals = np.abs(rates @ robot.expansion(chain).matrix.T).sum(axis=2)
    return np.asarray(extents * (totals ** (1.0 / orders)).max(axis=0) ** orders)


def _pinocchio_derivatives(
    robot: RobotModel, chain: Chain, q: Array, rates: Array, reference: Reference
) -> tuple[list[Array], Array | None]:
    """Derivatives of the tip's motion in a reference, one per rate, and its spatial acceleration; (6,) each."""
    expansion = robot.expansion(chain)
    full_q, full_rates = expansion.offset + expansion.matrix @ q, rates @ expansion.matrix.T
    T, motion = _tip_in_base(robot, chain, full_q, full_rates[:3])
    point = T.inverse().translation if reference == "world" else np.zeros(3)
    derivatives = _of_point(T.rotation, motion, point)
    if len(rates) > 3:
        derivatives.append(_snap(robot, chain, full_q, full_rates, point))
    spatial = None if len(motion) < 2 else from_tip(T, reference).act(motion[1]).vector
    if reference == "local":
        derivatives = [(vector.reshape(2, 3) @ T.rotation).ravel() for vector in derivatives]
    return derivatives, spatial


def _snap(robot: RobotModel, chain: Chain, q: Array, rates: Array, point: Array) -> Array:
    """(p⁗; ω⃛) of a point of the tip's body, along the base's axes, by difference quotients of its jerk; shape (6,)."""

    def jerk(time: float) -> Array:
        T, motion = _tip_in_base(robot, chain, *_after(q, rates, time))
        return _of_point(T.rotation, motion, point)[2]

    roots = np.abs(rates).sum(axis=1) ** (1.0 / np.arange(1, len(rates) + 1))
    steps = [_STEP / max(float(roots.max()), _SLOWEST) / 2**level for level in range(_LEVELS)]
    estimates = [(jerk(step) - jerk(-step)) / (2 * step) for step in steps]
    for order in range(1, _LEVELS):
        estimates = [b + (b - a) / (4**order - 1) for a, b in pairwise(estimates)]
    return np.asarray(estimates[0])


def _after(q: Array, rates: Array, t: float) -> tuple[Array, Array]:
    """Configuration and its first three derivatives at time t, for constant q⁗; shapes (nq,) and (3, nq)."""
    q1, q2, q3, q4 = rates
    moved = q + t * (q1 + t * (q2 / 2 + t * (q3 / 6 + t * q4 / 24)))
    return moved, np.array([q1 + t * (q2 + t * (q3 / 2 + t * q4 / 6)), q2 + t * (q3 + t * q4 / 2), q3 + t * q4])


def _tip_in_base(robot: RobotModel, chain: Chain, q: Array, rates: Array) -> tuple[pin.SE3, BodyMotion]:
    """T_base_tip, and the tip's motion relative to the base, for up to three rates of the full model, shape (K, nv)."""
    with robot.lock:
        T_tip, tip = _body_motion(robot, chain.tip_frame, q, rates)
        if chain.base_frame == robot.description.root:
            return T_tip, tip
        T_base, base = _body_motion(robot, chain.base_frame, q, rates)
    T_base_tip = T_base.actInv(T_tip)
    return T_base_tip, _relative(T_base_tip, tip, base)


def _body_motion(robot: RobotModel, frame_name: str, q: Array, rates: Array) -> tuple[pin.SE3, BodyMotion]:
    """Pose of a frame in the world, and its twist in its own axes with up to two time derivatives."""
    model, data, frame = robot.model, robot.data, robot.frame_id(frame_name)
    v, a, j = (*rates, *np.zeros((3 - len(rates), model.nv)))
    motion = []
    if len(rates) > 2:
        pin.computeForwardKinematicsDerivatives(model, data, q, v, a)
        # For a robot with one joint Pinocchio returns a flat (6,).
        parts = (part.reshape(6, -1) for part in pin.getFrameAccelerationDerivatives(model, data, frame, pin.LOCAL)[1:])
        by_q, by_v, by_a = parts
        motion = [pin.Motion(by_q @ v + by_v @ a + by_a @ j)]
    pin.forwardKinematics(model, data, q, v, a)
    T = pin.updateFramePlacement(model, data, frame).copy()
    if len(rates) > 1:
        motion.insert(0, pin.getFrameAcceleration(model, data, frame, pin.LOCAL))
    return T, [pin.getFrameVelocity(model, data, frame, pin.LOCAL), *motion]


def _relative(T_base_tip: pin.SE3, tip: BodyMotion, base: BodyMotion) -> BodyMotion:
    """Motion relative to a moving base: ξ = ξ_tip - y, y = Ad(T⁻¹) ξ_base, hence ẏ = Ad(T⁻¹) ξ̇_base - ξ × y."""
    carried = [T_base_tip.actInv(motion) for motion in base]
    relative = [tip[0] - carried[0]]
    if len(tip) > 1:
        first = carried[1] - relative[0].cross(carried[0])
        relative.append(tip[1] - first)
    if len(tip) > 2:
        second = carried[2] - relative[0].cross(carried[1]) - relative[1].cross(carried[0]) - relative[0].cross(first)
        relative.append(tip[2] - second)
    return relative


def _of_point(R: Array, motion: BodyMotion, point: Array) -> list[Array]:
    """Derivatives of the position and angular velocity of a point of the tip's body, along the base's axes."""
    w = motion[0].angular
    u = motion[0].linear + np.cross(w, point)
    derivatives = [np.concatenate((R @ u, R @ w))]
    if len(motion) > 1:
        w1 = motion[1].angular
        u1 = motion[1].linear + np.cross(w1, point)
        derivatives.append(np.concatenate((R @ (u1 + np.cross(w, u)), R @ w1)))
    if len(motion) > 2:
        w2 = motion[2].angular
        u2 = motion[2].linear + np.cross(w2, point)
        linear = u2 + 2.0 * np.cross(w, u1) + np.cross(w1, u) + np.cross(w, np.cross(w, u))
        derivatives.append(np.concatenate((R @ linear, R @ (w2 + np.cross(w, w1)))))
    return derivatives
