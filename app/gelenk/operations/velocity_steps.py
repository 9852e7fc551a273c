"""Worked solutions of answers about the Jacobian: the core's numbers as questions to `gelenk.course.velocity`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from gelenk.contract.jacobian import JacobianRequest
from gelenk.contract.velocity import VelocityRequest
from gelenk.course.steps import Step
from gelenk.course.velocity.ellipsoid_steps import EllipsoidQuestion, ellipsoid_steps
from gelenk.course.velocity.geometry import chain_geometry
from gelenk.course.velocity.inverse_question import InverseQuestion, derivation
from gelenk.course.velocity.inverse_steps import inverse_steps
from gelenk.course.velocity.inverses import Derivation, LectureInverse
from gelenk.course.velocity.jacobian_steps import JacobianQuestion, jacobian_steps
from gelenk.course.velocity.null_space_steps import NearestPair, NullSpaceWish
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.course.velocity.tip_motion_steps import known_part, tip_motion_steps
from gelenk.course.velocity.writing import row
from gelenk.kinematics.ellipsoids.manipulability import Ellipsoids, Manipulability, Part, is_within_task
from gelenk.kinematics.force.statics import Statics
from gelenk.kinematics.velocity.inverse_velocity import InverseMotion, kept_from_limits
from gelenk.kinematics.velocity.task_space import TaskSpace
from gelenk.kinematics.velocity.velocity import TipMotion, in_reference, product_rule
from gelenk.operations.chains import units_are_mixed
from gelenk.operations.velocity_call import DAMPING_THRESHOLD
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import one_configuration
from gelenk.robot.notations import rpy_from_rotations, zyz_from_rotations
from gelenk.robot.poses import Poses


def worked_jacobians(
    chain: Chain, call: JacobianRequest, qs: Array, poses: Poses, velocities: Array | None
) -> list[list[Step]]:
    """Return the steps of each Jacobian; velocities, shape (N, n), if the time variation is wanted."""
    view = call.reference if call.representation == "geometric" else call.representation
    angles_of = rpy_from_rotations if view == "rpy" else zyz_from_rotations
    angles = angles_of(np.ascontiguousarray(poses.rotations))
    return [
        jacobian_steps(
            JacobianQuestion(
                chain_geometry(chain.flat, q),
                view,
                angles[i],
                call.rank_tolerance,
                None if velocities is None else velocities[i],
            )
        )
        for i, q in enumerate(qs)
    ]


def worked_motions(
    call: VelocityRequest, space: TaskSpace, rates: Array, motion: TipMotion
) -> dict[str, list[list[Step]]]:
    """Return the steps of the tip's motion at each configuration; rates of shape (K, N, n)."""
    aligned = call.reference == "local_world_aligned"
    rows = space.rows if aligned else list(range(6))
    Js = motion.jacobians[:, :, rows]
    sent = [None if aligned else [each[i] for each in motion.derivatives] for i in range(Js.shape[1])]
    return {"steps": [tip_motion_steps(list(Js[:, i]), rates[:, i], sent[i]) for i in range(Js.shape[1])]}


def worked_inversions(
    chain: Chain,
    call: VelocityRequest,
    space: TaskSpace,
    qs: Array,
    rates: Array,
    targets: Array,
    null_motion: Array | None,
    found: InverseMotion,
    nearest: Callable[[int], NearestPair | None] | None,
) -> list[tuple[Derivation, list[Step]]]:
    """Return the matrices and the steps of each inversion.

    The arguments are those of `inverse_motion`, and what gives the nearest pair of each row, if that is known.
    """
    inversion, Js = found.inversion, space.jacobians(chain, qs)
    weights = np.ones(len(chain))
    if call.weights is not None:
        weights = one_configuration(chain, call.weights, "weights")[0]
    adaptive = call.inverse == "damped" and call.damping in {None, "adaptive"}
    results = []
    for i in range(len(qs)):
        parts, damping = inversion.decomposition, float(inversion.dampings[i])
        inverse = LectureInverse(Js[i], int(parts.ranks[i]), weights, damping, float(parts.least[i]))
        question = InverseQuestion(
            inverse,
            call.inverse,
            targets[i] * space.scales,
            _known(call, space, rates[:, i], found.motion, i),
            len(rates) + 1,
            call.characteristic_length if space.turns else None,
            (call.damping_threshold or DAMPING_THRESHOLD) if adaptive else None,
            units_are_mixed(chain, space),
            None
            if null_motion is None
            else replace(
                _wish(chain, call, qs[i], null_motion[i], float(inversion.shares[i])), nearest=nearest and nearest(i)
            ),
        )
        results.append((derivation(question), inverse_steps(question)))
    return results


def _known(call: VelocityRequest, space: TaskSpace, rates: Array, motion: TipMotion, i: int) -> tuple[Array, list[str]]:
    """What the known rates make of the tip's next derivative in the rows of the task, scaled, and its formulas."""
    order = len(rates) + 1
    if order == 1:
        return np.zeros(len(space)), []
    if call.reference == "local_world_aligned":
        Js = [space.picked(J[None])[0] for J in motion.jacobians[:, i]]
        return known_part(order, Js, rates)
    padded = np.concatenate((rates, np.zeros((1, rates.shape[1]))))[:, None]
    poses = Poses(motion.poses.positions[i : i + 1], motion.poses.rotations[i : i + 1])
    last = in_reference(poses, product_rule(motion.jacobians[:order, i : i + 1], padded), call.reference)[-1]
    value = last[0, space.rows] * space.scales
    name = (r"\dot J \dot q", r"2 \dot J \ddot q + \ddot J \dot q")[order - 2]
    return value, [f"{name} = {row(value)}"]


def _wish(chain: Chain, call: VelocityRequest, q: Array, xi: Array, share: float) -> NullSpaceWish:
    wanted = call.null_space
    if wanted is None or wanted.objective is None:
        return NullSpaceWish(xi, share)
    if wanted.objective == "limits":
        q = kept_from_limits(chain, q[None])[0]
    posture = None
    if wanted.posture is not None:
        posture = one_configuration(chain, wanted.posture, "null_space/posture")[0]
    return NullSpaceWish(xi, share, wanted.objective, wanted.gain, q, chain.lower, chain.upper, posture)


def worked_statics(
    still: Statics, wrenches: Array | None, torques: Array, tolerance: float, *, solved: bool
) -> list[list[Step]]:
    """Return the steps at each configuration; `solved` if the wrenches were found from the torques."""
    splits = still.subspaces(tolerance)
    return [
        statics_steps(
            StaticsQuestion(
                chain_geometry(still.chain.flat, q),
                still.Js[i],
                splits[i].rank,
                still.places.positions[i],
                still.places.rotations[i],
                still.rows,
                None if wrenches is None else wrenches[i],
                torques[i],
                None if still.gravity is None else still.gravity_torques[i],
                solved,
            )
        )
        for i, q in enumerate(still.qs)
    ]


def worked_ellipsoids(found: Manipulability, length: float | None, directions: Array | None) -> list[list[Step]]:
    """Return the steps of all parts at each configuration; directions are unit vectors, shape (D, 3)."""

    def question(part: Part, ellipsoids: Ellipsoids, i: int) -> EllipsoidQuestion:
        space = ellipsoids.space
        scales = np.array([length or 1.0 if part == "combined" and row >= 3 else 1.0 for row in space.rows])
        along = np.zeros((0, len(space.rows)))
        if directions is not None and part != "combined":
            along = directions[is_within_task(space, directions)][:, [row % 3 for row in space.rows]]
        J = found.Js[i, space.rows] * scales[:, None]
        return EllipsoidQuestion(part, J, space.basis, space.dimension, int(ellipsoids.ranks[i]), along)

    return [
        [step for part, each in found.parts.items() for step in ellipsoid_steps(question(part, each, i))]
        for i in range(len(found.Js))
    ]
