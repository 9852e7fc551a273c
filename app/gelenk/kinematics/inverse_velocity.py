"""Joint velocities that give the tip a twist; joint accelerations and jerks that give it an acceleration or a jerk.

The twist is linear in q̇, the acceleration in q̈ and the jerk in q⃛, with the same J: q̇ = J# v, q̈ = J#(r̈ - J̇ q̇) and
q⃛ = J#(r⃛ - 2 J̇ q̈ - J̈ q̇), where J# is one of the inverses of `linear_inverse`.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.certify import TOLERANCE
from gelenk.kinematics.certify_motion import motion_scales
from gelenk.kinematics.ik.null_space import Objective, objective_gradients
from gelenk.kinematics.jacobian import Reference, jacobians
from gelenk.kinematics.linear_inverse import Inversion, Rule, decompose, invert
from gelenk.kinematics.subspaces import rounding
from gelenk.kinematics.task_space import FULL_SPACE, TaskSpace, hessians_in_reference, jacobians_with_terms
from gelenk.kinematics.velocity import TipMotion, in_reference, jacobian_derivatives, product_rule, tip_motion
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain, joints_on_the_way
from gelenk.model.errors import CertificationFailed
from gelenk.model.poses import Poses
from gelenk.model.robot import Robot

_SLACK = 1e-9
"""How far beyond a limit counts as at it, relatively."""
_EDGE = 0.05
"""Share of a joint's range from which on the objective of the limits pushes no harder."""


@dataclass(frozen=True, slots=True)
class Exceeded:
    """A joint that is faster than it may be; velocities in [rad/s or m/s]."""

    joint: str
    velocity: float
    limit: float
    ratio: float


@dataclass(frozen=True, slots=True)
class InverseMotion:
    """The highest of the joints' derivatives at N configurations, and what the tip does with it.

    Attributes:
        inversion: Solutions, with what became of each equation.
        residuals: Requested motion minus the tip's, in the directions that count; shape (N, k), [m/s, rad/s],
            or by s² or s³; through Pinocchio.
        motion: What the tip does, in the chosen reference.
    """

    inversion: Inversion
    residuals: Array
    motion: TipMotion


def inverse_motion(
    robot: Robot,
    chain: Chain,
    qs: Array,
    rates: Array,
    targets: Array,
    rule: Rule,
    *,
    space: TaskSpace = FULL_SPACE,
    null_motion: Array | None = None,
) -> InverseMotion:
    """The next derivative of q for a twist (no rates given), an acceleration (q̇ given) or a jerk (q̇ and q̈ given).

    Args:
        robot: The robot.
        chain: Base and tip.
        qs: Configurations; shape (N, n), [rad or m].
        rates: q̇, q̈ as far as they are known; shape (K, N, n), K from 0 to 2, [rad/sᵏ or m/sᵏ].
        targets: What the tip is to do in the directions that count; shape (N, k), [m/sᵏ, rad/sᵏ].
        rule: Which inverse.
        space: The rows of the Jacobian that count, their reference, of targets too, and the length that makes radians
            metres.
        null_motion: ξ, whose part in ker J is added; shape (N, n).

    Raises:
        CertificationFailed: Pinocchio's tip moves otherwise.
    """
    found = jacobians(robot, chain, qs, reference=space.reference)
    asked = targets
    if len(rates):
        asked = targets - _bias_in_reference(chain, qs, rates, found.poses, space.reference)[:, space.rows]
    limits = velocity_limits(robot, chain) if len(rates) == 0 else None
    least = rounding(jacobians_with_terms(chain, qs, space.reference)[1])
    inversion = invert(found.values[:, space.rows], asked, rule, space.scales, null_motion, limits, least)
    complete = np.concatenate((rates, inversion.xs[None]))
    motion = tip_motion(robot, chain, qs, complete, space.reference)
    residuals = targets - motion.derivatives[-1][:, space.rows]
    _demand_same(residuals, inversion.residuals, motion_scales(robot, chain, qs, complete)[-1], targets)
    return InverseMotion(inversion, residuals, motion)


def descent(chain: Chain, qs: Array, objective: Objective, gain: float, space: TaskSpace) -> Array:
    """Joint velocities ξ = -gain · gradient of an objective; shape (N, n), [rad/s or m/s].

    Away from the limits no faster than a twentieth of the range before them.

    Of `manipulability`, the logarithm of the measure √det JJᵀ of the directions that count, the derivative by q_j is
    Σ (J#)_ik ∂J_ki/∂q_j, which no scale of J's rows changes.
    """
    if objective.name == "manipulability":
        Js, terms = jacobians_with_terms(chain, qs, space.reference)
        parts = decompose(Js[:, space.rows], Rule(), np.ones(len(space)), rounding(terms))
        few = parts.sigmas.shape[1]
        gains = parts.gains(np.zeros(len(qs)))
        inverses = np.einsum("bir,bi,bki->brk", parts.right[:, :few], gains, parts.left[:, :, :few])
        Hs = hessians_in_reference(chain, qs, space.reference)[:, space.rows]
        climb: Array = np.einsum("bik,bkij->bj", inverses, Hs)
        return gain * climb
    # The other objectives look at the joints alone. That of the limits grows beyond all bounds towards them.
    if objective.name == "limits":
        edges = _EDGE * (chain.upper - chain.lower)
        limited = np.isfinite(edges)
        low, high = np.where(limited, chain.lower + edges, -np.inf), np.where(limited, chain.upper - edges, np.inf)
        qs = np.clip(qs, low, high)
    nowhere = Poses(np.zeros((len(qs), 3)), np.broadcast_to(np.eye(3), (len(qs), 3, 3)))
    return -gain * objective_gradients(chain, nowhere, qs, objective, space.task)


def velocity_limits(robot: Robot, chain: Chain) -> Array:
    """The largest speed of each variable of a chain that its own joint and those that mimic it on the way allow.

    Returns:
        Shape (n,), [rad/s or m/s]; inf where the description says nothing.
    """
    description = robot.description
    own = [description.joint[name].limits.velocity for name in chain.joint_names]
    limits = np.array([np.inf if limit is None else limit for limit in own], dtype=float)
    way = joints_on_the_way(description, chain)
    for joint, variable, multiplier in zip(way, chain.flat.joints[:, 1], chain.flat.drives[:, 0], strict=True):
        if joint.limits.velocity is not None and multiplier != 0.0:
            limits[variable] = min(limits[variable], joint.limits.velocity / abs(multiplier))
    return limits


def exceeded(chain: Chain, speeds: Array, limits: Array) -> list[Exceeded]:
    """The joints of one configuration that are faster than they may be; speeds of shape (n,), [rad/s or m/s]."""
    return [
        Exceeded(chain.joint_names[i], float(speeds[i]), float(limits[i]), float(abs(speeds[i]) / limits[i]))
        for i in np.flatnonzero(np.abs(speeds) > limits * (1.0 + _SLACK))
    ]


def _bias_in_reference(chain: Chain, qs: Array, rates: Array, poses: Poses, reference: Reference) -> Array:
    """The part of the tip's next derivative that the known rates alone make; shape (N, 6)."""
    padded = np.concatenate((rates, np.zeros((1, *qs.shape))))
    derivatives = product_rule(jacobian_derivatives(chain, qs, rates), padded)
    return in_reference(poses, derivatives, reference)[-1]


def _demand_same(certified: Array, computed: Array, scales: Array, targets: Array) -> None:
    """Refuse residuals that are not those of the equation that was solved; scales of shape (N,)."""
    sizes = np.maximum(1.0, scales + np.abs(targets).max(axis=1, initial=0.0))
    worst = float((np.abs(certified - computed).max(axis=1, initial=0.0) / sizes).max(initial=0.0))
    if not worst <= TOLERANCE:
        raise CertificationFailed("the residual", worst, TOLERANCE)
