"""Velocity kinematics of a robot: the tip's motion from the joints' motion, and the inverse."""

from typing import Any

import numpy as np

from gelenk.contract.velocity import MAX_REPORTS, VelocityRequest
from gelenk.errors import TooLarge, counted
from gelenk.kinematics.singularity.report import singularity_report
from gelenk.kinematics.velocity.inverse_velocity import (
    InverseMotion,
    exceeded,
    inverse_motion,
    velocity_limits,
)
from gelenk.kinematics.velocity.linear_inverse import Decomposition, InverseRule, Inversion, decompose
from gelenk.kinematics.velocity.subspaces import rounding
from gelenk.kinematics.velocity.task_space import TaskSpace, jacobians_with_terms, structure
from gelenk.kinematics.velocity.velocity import TipMotion, tip_motion
from gelenk.operations.chains import check_numbers, head
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.singularities import singularity_info
from gelenk.operations.velocity_call import (
    RATES,
    TIP,
    asked_field,
    null_motion_of_call,
    positions_and_rates,
    rule_of_call,
    space_of_call,
    targets_of_call,
)
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import check_limits
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

_QUICK = 1
"""Configurations that take the event loop less than about a millisecond; more go to a worker."""
_ROWS_NAMED = 200
"""Maximum number of rows without an answer in a header: proxies allow headers of a few kilobytes."""

_DERIVATIVES = ("twists", "accelerations", "jerks", "snaps")


def run(loaded: LoadedRobot, call: VelocityRequest, limits: Limits) -> Outcome:
    """Compute the tip's twists and their derivatives from joint rates, or joint rates from those of the tip."""
    robot = loaded.robot
    chain = robot.chain(call.base_frame, call.tip_frame)
    qs, rates = positions_and_rates(chain, call)
    asked = asked_field(call, len(rates))
    if call.respect_limits:
        check_limits(chain, qs)
    space = space_of_call(call)
    _check_size(call, len(qs), len(chain), limits)
    if asked is None:
        motion = tip_motion(robot, chain, qs, rates, call.reference)
        return _forward_outcome(robot, chain, call, qs, rates, space, motion)
    rule = rule_of_call(chain, call, asked, len(space))
    targets = targets_of_call(call, asked, space, len(qs))
    null_motion = null_motion_of_call(chain, call, qs, asked, space)
    found = inverse_motion(robot, chain, qs, rates, targets, rule, space=space, null_motion=null_motion)
    return _inverse_outcome(robot, chain, call, qs, rates, space, asked, found)


def is_heavy(call: VelocityRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    slow = (call.joint_snaps, call.tip_accelerations, call.tip_jerks, call.null_space)
    return call.singularity_reports or any(part is not None for part in slow) or len(call.joint_positions) > _QUICK


def _check_size(call: VelocityRequest, count: int, joints: int, limits: Limits) -> None:
    if call.singularity_reports and count > MAX_REPORTS:
        raise TooLarge("configurations with whole singularity reports", count, MAX_REPORTS)
    matrices = 6 * joints * len(RATES) if call.jacobian_derivatives else 0
    numbers = count * (50 + joints + matrices + (100 + 10 * joints) * call.singularity_reports)
    check_numbers(numbers, limits)


def _forward_outcome(
    robot: RobotModel, chain: Chain, call: VelocityRequest, qs: Array, rates: Array, space: TaskSpace, motion: TipMotion
) -> Outcome:
    def content() -> dict[str, Any]:
        answer = _head(chain, call, space)
        for name, values in zip(_DERIVATIVES, motion.derivatives, strict=False):
            answer[name] = np.ascontiguousarray(values)
        if motion.spatial_accelerations is not None:
            answer["spatial_accelerations"] = np.ascontiguousarray(motion.spatial_accelerations)
        Js, terms = jacobians_with_terms(chain, qs, call.reference)
        rule = InverseRule(rank_tolerance=call.rank_tolerance)
        parts = decompose(Js[:, space.rows], rule, space.scales, rounding(terms))
        answer["results"] = _results(robot, chain, call, qs, rates[0], space, parts)
        return _with_proof(answer, call, motion)

    def array() -> tuple[Array, dict[str, str]]:
        derivatives = motion.derivatives
        return (derivatives[0] if len(derivatives) == 1 else np.stack(derivatives, axis=1)), {}

    return Outcome(content, None if call.jacobian_derivatives else array)


def _inverse_outcome(
    robot: RobotModel,
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
        **head(chain),
        "reference": call.reference,
        "task": space.task.directions,
        "rank_tolerance": call.rank_tolerance,
    }


def _with_proof(answer: dict[str, Any], call: VelocityRequest, motion: TipMotion) -> dict[str, Any]:
    """Add the certificate to the answer, and the Jacobian's derivatives if requested."""
    if call.jacobian_derivatives:
        answer["jacobian_derivatives"] = np.ascontiguousarray(motion.jacobians.swapaxes(0, 1))
    answer["certificate"] = motion.certificate
    return answer


def _results(
    robot: RobotModel,
    chain: Chain,
    call: VelocityRequest,
    qs: Array,
    speeds: Array,
    space: TaskSpace,
    parts: Decomposition,
) -> list[dict[str, Any]]:
    """Return the report of each configuration, common to all requests; speeds of shape (N, n)."""
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
    """Return the verdict on one inversion."""
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
    """Return why an inversion has no answer."""
    rank, size = inversion.decomposition.ranks[row], inversion.xs.shape[1]
    if call.inverse == "exact" and rank < size:
        return (
            f"the Jacobian has rank {rank} with {counted(size, 'joint')}, so that it has no inverse: `damped` "
            "or `pseudo_inverse` give an answer here"
        )
    return "the Jacobian is so small here that the joints would be faster than any number says"
