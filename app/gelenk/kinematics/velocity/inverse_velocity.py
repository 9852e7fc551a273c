"""Joint velocities, accelerations and jerks that give the tip a desired twist, acceleration or jerk.

The twist is linear in q̇, the acceleration in q̈ and the jerk in q⃛, with the same J: q̇ = J# v, q̈ = J#(r̈ - J̇ q̇) and
q⃛ = J#(r⃛ - 2 J̇ q̈ - J̈ q̇), where J# is one of the inverses of `linear_inverse`.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.ik.search.null_space import objective_gradients
from gelenk.ik.search.problem import Objective
from gelenk.kinematics.judge.judge import agreed
from gelenk.kinematics.judge.motion import motion_scales
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.kinematics.velocity.linear_inverse import InverseRule, Inversion, decompose, invert
from gelenk.kinematics.velocity.subspaces import rounding
from gelenk.kinematics.velocity.task_space import FULL_SPACE, TaskSpace, hessians_in_reference, jacobians_with_terms
from gelenk.kinematics.velocity.velocity import TipMotion, in_reference, jacobian_derivatives, product_rule, tip_motion
from gelenk.kinematics.velocity.words import ExceededLimit
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, crossed_joints
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

_SLACK = 1e-9
"""Relative excess over a velocity limit that is tolerated."""
_EDGE = 0.05
"""Distance from a limit, as a share of the joint's range, within which the limit objective pushes no harder."""


@dataclass(frozen=True, slots=True)
class InverseMotion:
    """The next derivative of q at N configurations, and the tip's resulting motion.

    Attributes:
        residuals: Requested motion minus the tip's certified motion, in the directions that count; shape (N, k),
            [m/sᵏ, rad/sᵏ].
        motion: The tip's motion in the chosen reference.
    """

    inversion: Inversion
    residuals: Array
    motion: TipMotion


def inverse_motion(
    robot: RobotModel,
    chain: Chain,
    qs: Array,
    rates: Array,
    targets: Array,
    rule: InverseRule,
    *,
    space: TaskSpace = FULL_SPACE,
    null_motion: Array | None = None,
) -> InverseMotion:
    """Solve for the next derivative of q: q̇ (no rates given), q̈ (q̇ given) or q⃛ (q̇ and q̈ given).

    Args:
        qs: Configurations; shape (N, n), [rad or m].
        rates: The known rates, none, q̇, or q̇ and q̈; shape (K, N, n), K from 0 to 2, [rad/sᵏ or m/sᵏ].
        targets: Desired twist, acceleration or jerk in the rows and reference of `space`; shape (N, k), [m/sᵏ, rad/sᵏ].
        null_motion: ξ, whose component in ker J is added; shape (N, n).

    Raises:
        CertificationFailed: The tip's motion differs from Pinocchio's.
    """
    found = jacobians(robot, chain, qs, reference=space.reference)
    wanted = targets
    if len(rates):
        # The part of the tip's next derivative that comes from the known rates alone.
        padded = np.concatenate((rates, np.zeros((1, *qs.shape))))
        derivatives = product_rule(jacobian_derivatives(chain, qs, rates), padded)
        wanted = targets - in_reference(found.poses, derivatives, space.reference)[-1][:, space.rows]
    limits = velocity_limits(robot, chain) if len(rates) == 0 else None
    least = rounding(jacobians_with_terms(chain, qs, space.reference)[1])
    inversion = invert(found.values[:, space.rows], wanted, rule, space.scales, null_motion, limits, least)
    complete = np.concatenate((rates, inversion.xs[None]))
    motion = tip_motion(robot, chain, qs, complete, space.reference)
    residuals = targets - motion.derivatives[-1][:, space.rows]
    sizes = motion_scales(robot, chain, qs, complete)[-1] + np.abs(targets).max(axis=1, initial=0.0)
    agreed("the residual", (residuals - inversion.residuals) / np.maximum(1.0, sizes)[:, None], 1.0)
    return InverseMotion(inversion, residuals, motion)


def descent(chain: Chain, qs: Array, objective: Objective, gain: float, space: TaskSpace) -> Array:
    """Compute joint velocities ξ = -gain · gradient of an objective; shape (N, n), [rad/s or m/s].

    For `limits` the gradient within a twentieth of the range from a limit is that at this distance.

    For `manipulability`, the logarithm of the measure √det JJᵀ over the directions that count, the velocities follow
    the ascent; the derivative by q_j is Σ (J#)_ik ∂J_ki/∂q_j, independent of any scaling of J's rows.
    """
    if objective.name == "manipulability":
        Js, terms = jacobians_with_terms(chain, qs, space.reference)
        parts = decompose(Js[:, space.rows], InverseRule(), np.ones(len(space)), rounding(terms))
        few = parts.sigmas.shape[1]
        gains = parts.gains(np.zeros(len(qs)))
        inverses = np.einsum("bir,bi,bki->brk", parts.right[:, :few], gains, parts.left[:, :, :few])
        Hs = hessians_in_reference(chain, qs, space.reference)[:, space.rows]
        climb: Array = np.einsum("bik,bkij->bj", inverses, Hs)
        return gain * climb
    # The other objectives depend on the joints alone. The limit objective is unbounded near the limits.
    if objective.name == "limits":
        qs = kept_from_limits(chain, qs)
    nowhere = Poses(np.zeros((len(qs), 3)), np.broadcast_to(np.eye(3), (len(qs), 3, 3)))
    return -gain * objective_gradients(chain, nowhere, qs, objective, space.task)


def kept_from_limits(chain: Chain, qs: Array) -> Array:
    """Move configurations away from limits, to where the objective `limits` takes its gradient; shape (N, n)."""
    edges = _EDGE * (chain.upper - chain.lower)
    limited = np.isfinite(edges)
    low, high = np.where(limited, chain.lower + edges, -np.inf), np.where(limited, chain.upper - edges, np.inf)
    return np.asarray(np.clip(qs, low, high))


def velocity_limits(robot: RobotModel, chain: Chain) -> Array:
    """Return the largest speed of each variable that its own joint and those of the chain mimicking it allow; (n,).

    It is inf where the description gives no limit.
    """
    description = robot.description
    own = [description.joint[name].limits.velocity for name in chain.joint_names]
    limits = np.array([np.inf if limit is None else limit for limit in own], dtype=float)
    way = crossed_joints(description, chain)
    for joint, variable, multiplier in zip(way, chain.flat.joints[:, 1], chain.flat.drives[:, 0], strict=True):
        if joint.limits.velocity is not None and multiplier != 0.0:
            limits[variable] = min(limits[variable], joint.limits.velocity / abs(multiplier))
    return limits


def exceeded(chain: Chain, speeds: Array, limits: Array) -> list[ExceededLimit]:
    """Return the joints of one configuration that exceed their limits; speeds of shape (n,), [rad/s or m/s]."""
    return [
        ExceededLimit(chain.joint_names[i], float(speeds[i]), float(limits[i]), float(abs(speeds[i]) / limits[i]))
        for i in np.flatnonzero(np.abs(speeds) > limits * (1.0 + _SLACK))
    ]
