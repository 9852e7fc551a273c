"""Velocity kinematics of a robot: the tip's motion of the joints', and the joints' of the tip's."""

from typing import Any

import numpy as np

from gelenk.api.routes import Computation, Operation, Outcome
from gelenk.api.singularity import singularity_info
from gelenk.api.velocity_call import (
    RATES,
    TIP,
    asked_field,
    null_motion_of_call,
    positions_and_rates,
    rule_of_call,
    space_of_call,
    targets_of_call,
)
from gelenk.contract.velocity import MAX_REPORTS, VelocityAnswer, VelocityOptions, VelocityRequest
from gelenk.kinematics.certify_motion import MotionCertificate
from gelenk.kinematics.configuration import check_limits
from gelenk.kinematics.inverse_velocity import (
    InverseMotion,
    exceeded,
    inverse_motion,
    velocity_limits,
)
from gelenk.kinematics.linear_inverse import Decomposition, Inversion, Rule, decompose
from gelenk.kinematics.singularity import singularity_report
from gelenk.kinematics.subspaces import rounding
from gelenk.kinematics.task_space import TaskSpace, jacobians_with_terms, structure
from gelenk.kinematics.velocity import TipMotion, tip_motion
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.errors import TooLarge, counted
from gelenk.model.robot import Robot
from gelenk.store.records import LoadedRobot

_QUICK = 1
"""Configurations that take the event loop less than about a millisecond; more go to a thread."""
_ROWS_NAMED = 200
"""Rows without an answer that a header names: proxies allow headers of a few kilobytes."""

_DERIVATIVES = ("twists", "accelerations", "jerks", "snaps")


def velocity_operation(max_answer_numbers: int) -> Operation:
    """The operation `velocity`, none of whose answers holds more numbers than given."""

    def velocity(loaded: LoadedRobot, call: VelocityRequest) -> Outcome:
        """How the tip moves when the joints do, and how the joints must move for the tip.

        **Forward**, `joint_velocities` given: the twist v = J q̇; with `joint_accelerations` the acceleration
        J q̈ + J̇ q̇, both the classical one (p̈; ω̇) and Pinocchio's spatial one; with `joint_jerks` and `joint_snaps`
        the jerk J q⃛ + 2 J̇ q̈ + J̈ q̇ and the snap J q⁗ + 3 J̇ q⃛ + 3 J̈ q̈ + J⃛ q̇, with exact J̇, J̈, J⃛. The
        lecture notes have the jerk without the factor 2, which is an error; so is d²s/ds² for d²p/ds² in their p̈ =
        d²p/ds² ṡ² + dp/ds s̈. They say that the planar arm's 6×2 Jacobian has a rank between 1 and 2: it is 2 always,
        and the 2×2 block of v_x, v_y loses rank at q₂ = 0 and π, which `"task": ["x", "y"]` shows.

        **Inverse**, `twists` given: q̇ = J⁻¹v, the pseudo-inverse J#v by singular values, or damped least squares
        min λ‖q̇‖² + ‖Jq̇ - v‖² with fixed λ (the course's λ, elsewhere written λ²) or one that follows the smallest
        singular value and the velocity limits; joints weighted on request, and a motion (I - J#J) ξ in the null space
        added. `tip_accelerations` and `tip_jerks` are inverted likewise, less what the given rates already make. Each
        entry has its residual, the joints that are too fast, and how near the configuration is to a singularity.
        Where metres and radians are mixed, J#, damping and condition number depend on the unit of length: choose a
        `task` of one kind, or give a `characteristic_length`.

        The tip's motion is recomputed through Pinocchio before it is sent (a sample of a large batch), of an inversion
        that which the found rates make.
        """
        robot = loaded.robot
        chain = robot.chain(call.base_frame, call.tip_frame)
        qs, rates = positions_and_rates(chain, call)
        asked = asked_field(call, len(rates))
        if call.respect_limits:
            check_limits(chain, qs)
        space = space_of_call(call)
        _check_size(call, len(qs), len(chain), max_answer_numbers)
        if asked is None:
            motion = tip_motion(robot, chain, qs, rates, call.reference)
            return _forward_outcome(robot, chain, call, qs, rates, space, motion)
        rule = rule_of_call(chain, call, asked, len(space))
        targets = targets_of_call(call, asked, space, len(qs))
        null_motion = null_motion_of_call(chain, call, qs, asked, space)
        found = inverse_motion(robot, chain, qs, rates, targets, rule, space=space, null_motion=null_motion)
        return _inverse_outcome(robot, chain, call, qs, rates, space, asked, found)

    return Operation(
        name="velocity",
        operation_id="velocity",
        summary="Velocity kinematics",
        computation=Computation(
            run=velocity,
            request=VelocityRequest,
            options=VelocityOptions,
            array_field="joint_positions",
            is_heavy=_is_heavy,
        ),
        answer=VelocityAnswer,
        npy_body="Forward: an array of shape (N, k, n) with 2 ≤ k ≤ 5, of each configuration the joint positions, "
        "velocities, accelerations, jerks and snaps, as far as k goes.",
        npy_answer="Forward: twists as an array of shape (N, 6), or with higher derivatives (N, k, 6). Inverse: the "
        "joint velocities (accelerations, jerks) as an array of shape (N, n), rows without an answer zero; the header "
        "`Gelenk-Unsolved` counts those and `Gelenk-Unsolved-Rows` gives the first 200 of them.",
        example={
            "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
            "twists": [[0.1, 0.0, -0.05, 0.0, 0.0, 0.2]],
            "inverse": "damped",
            "damping": "adaptive",
            "null_space": {"objective": "mid_range", "gain": 0.5},
        },
    )


def _is_heavy(call: VelocityRequest) -> bool:
    slow = (call.joint_snaps, call.tip_accelerations, call.tip_jerks, call.null_space)
    return call.singularity_reports or any(part is not None for part in slow) or len(call.joint_positions) > _QUICK


def _check_size(call: VelocityRequest, count: int, joints: int, allowed: int) -> None:
    if call.singularity_reports and count > MAX_REPORTS:
        raise TooLarge("configurations with whole singularity reports", count, MAX_REPORTS)
    matrices = 6 * joints * len(RATES) if call.jacobian_derivatives else 0
    numbers = count * (50 + joints + matrices + (100 + 10 * joints) * call.singularity_reports)
    if numbers > allowed:
        raise TooLarge("numbers in the answer", numbers, allowed)


def _forward_outcome(
    robot: Robot, chain: Chain, call: VelocityRequest, qs: Array, rates: Array, space: TaskSpace, motion: TipMotion
) -> Outcome:
    def content() -> dict[str, Any]:
        answer = _head(chain, call, space)
        for name, values in zip(_DERIVATIVES, motion.derivatives, strict=False):
            answer[name] = np.ascontiguousarray(values)
        if motion.spatial_accelerations is not None:
            answer["spatial_accelerations"] = np.ascontiguousarray(motion.spatial_accelerations)
        Js, terms = jacobians_with_terms(chain, qs, call.reference)
        rule = Rule(rank_tolerance=call.rank_tolerance)
        parts = decompose(Js[:, space.rows], rule, space.scales, rounding(terms))
        answer["results"] = _results(robot, chain, call, qs, rates[0], space, parts)
        return _with_proof(answer, call, motion)

    def array() -> tuple[Array, dict[str, str]]:
        derivatives = motion.derivatives
        return (derivatives[0] if len(derivatives) == 1 else np.stack(derivatives, axis=1)), {}

    return Outcome(content, None if call.jacobian_derivatives else array)


def _inverse_outcome(
    robot: Robot,
    chain: Chain,
    call: VelocityRequest,
    qs: Array,
    rates: Array,
    space: TaskSpace,
    asked: str,
    found: InverseMotion,
) -> Outcome:
    inversion = found.inversion
    unsolved = [i for i, status in enumerate(inversion.statuses) if status == "singular"]

    def content() -> dict[str, Any]:
        answer = _head(chain, call, space)
        solutions: list[list[float] | None] = inversion.xs.tolist()
        for row in unsolved:
            solutions[row] = None
        answer[RATES[TIP[asked]]] = solutions
        speeds = rates[0] if len(rates) else inversion.xs
        results = _results(robot, chain, call, qs, speeds, space, inversion.decomposition)
        for row, result in enumerate(results):
            result.update(_verdict(call, space, found, row))
        answer["results"] = results
        return _with_proof(answer, call, found.motion)

    def array() -> tuple[Array, dict[str, str]]:
        named = ",".join(str(row) for row in unsolved[:_ROWS_NAMED])
        return inversion.xs, {"Gelenk-Unsolved": str(len(unsolved)), "Gelenk-Unsolved-Rows": named}

    return Outcome(content, None if call.jacobian_derivatives else array)


def _head(chain: Chain, call: VelocityRequest, space: TaskSpace) -> dict[str, Any]:
    return {
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "reference": call.reference,
        "task": space.task.directions,
        "rank_tolerance": call.rank_tolerance,
    }


def _with_proof(answer: dict[str, Any], call: VelocityRequest, motion: TipMotion) -> dict[str, Any]:
    """The answer with the Jacobian's derivatives, if requested, and the certificate."""
    if call.jacobian_derivatives:
        answer["jacobian_derivatives"] = np.ascontiguousarray(motion.jacobians.swapaxes(0, 1))
    answer["certificate"] = _certificate(motion.certificate)
    return answer


def _certificate(certificate: MotionCertificate) -> dict[str, Any]:
    errors: list[float | None] = [*certificate.max_errors, None, None, None]
    return {
        "samples": certificate.samples,
        "max_twist_error": errors[0],
        "max_acceleration_error": errors[1],
        "max_spatial_acceleration_error": certificate.max_spatial_acceleration_error,
        "max_jerk_error": errors[2],
        "max_snap_error": errors[3],
        "seed": certificate.seed,
    }


def _results(
    robot: Robot,
    chain: Chain,
    call: VelocityRequest,
    qs: Array,
    speeds: Array,
    space: TaskSpace,
    parts: Decomposition,
) -> list[dict[str, Any]]:
    """The report of each configuration, common to all requests; speeds of shape (N, n)."""
    limits = velocity_limits(robot, chain)
    highest = structure(chain, space.task, space.reference).rank
    conditions = parts.condition_numbers
    results: list[dict[str, Any]] = []
    for row, (rank, sigmas) in enumerate(zip(parts.ranks.tolist(), parts.sigmas.tolist(), strict=True)):
        singularity = {
            "singular": rank < highest,
            "rank": rank,
            "structural_rank": highest,
            "singular_values": sigmas,
            "condition_number": conditions[row],
            "lost_directions": parts.lost_directions(row).tolist(),
        }
        results.append({"velocity_limits_exceeded": exceeded(chain, speeds[row], limits), "singularity": singularity})
        if call.singularity_reports:
            report = singularity_report(chain, qs[row], tolerance=call.rank_tolerance, space=space)
            results[row]["singularity_report"] = singularity_info(chain, report)
    return results


def _verdict(call: VelocityRequest, space: TaskSpace, found: InverseMotion, row: int) -> dict[str, Any]:
    """What became of one inversion."""
    inversion, residual = found.inversion, found.residuals[row]
    status, damping = inversion.statuses[row], float(inversion.dampings[row])
    linear = np.array([direction < 3 for direction in space.rows])
    if status == "singular":
        return {"status": status, "reason": _no_inverse(call, inversion, row)}
    entry: dict[str, Any] = {
        "status": status,
        "residual": residual.tolist(),
        "residual_linear": float(np.linalg.norm(residual[linear])),
        "residual_angular": float(np.linalg.norm(residual[~linear])),
        "damping": damping,
    }
    if call.null_space is not None:
        entry["null_space_share"] = float(inversion.shares[row])
    if status == "approximate" and damping > 0.0:
        entry["reason"] = f"damping by {damping:.3g} keeps the joints slow at the price of this residual"
    elif status == "approximate":
        entry["reason"] = (
            "the tip cannot move like this: the residual is what no motion of the joints gives"
            if inversion.decomposition.ranks[row] < len(space)
            else "the Jacobian is so nearly singular here that rounding of the fast joints is the residual"
        )
    return entry


def _no_inverse(call: VelocityRequest, inversion: Inversion, row: int) -> str:
    """Why there is no answer."""
    rank, size = inversion.decomposition.ranks[row], inversion.xs.shape[1]
    if call.inverse == "exact" and rank < size:
        return (
            f"the Jacobian has rank {rank} with {counted(size, 'joint')}, so that it has no inverse: `damped` "
            "or `pseudo_inverse` give an answer here"
        )
    return "the Jacobian is so small here that the joints would be faster than any number says"
