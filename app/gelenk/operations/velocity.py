"""Velocity kinematics of a robot: the tip's motion from the joints' motion, and the inverse."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from gelenk.contract.velocity import MAX_REPORTS, VelocityRequest
from gelenk.errors import TooLarge, counted
from gelenk.kinematics.singularity.report import singularity_report
from gelenk.kinematics.velocity.inverse_velocity import InverseMotion, exceeded, inverse_motion, velocity_limits
from gelenk.kinematics.velocity.jacobian import condition_numbers
from gelenk.kinematics.velocity.linear_inverse import Decomposition, InverseRule, Inversion, decompose
from gelenk.kinematics.velocity.subspaces import rounding
from gelenk.kinematics.velocity.task_space import TaskSpace, jacobians_with_terms, structure
from gelenk.kinematics.velocity.velocity import TipMotion, tip_motion
from gelenk.operations.chains import check_numbers, check_worked, head, task_of
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.singularities import singularity_info
from gelenk.operations.velocity_call import (
    RATES,
    TIP,
    null_motion_of_call,
    positions_and_rates,
    requested_field,
    rule_of_call,
    targets_of_call,
)
from gelenk.operations.velocity_clearance import Clearances, clearances_of
from gelenk.operations.velocity_steps import worked_inversions, worked_motions
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


@dataclass(frozen=True, slots=True, eq=False)
class _Question:
    """A checked request: configurations, known rates, the directions that count, and the clearance if it counts."""

    robot: RobotModel
    chain: Chain
    call: VelocityRequest
    qs: Array
    rates: Array
    space: TaskSpace
    clearances: Clearances | None

    @property
    def climb(self) -> Array | None:
        """Gradients of the clearance; shape (N, n)."""
        return None if self.clearances is None else self.clearances.gradients


def run(loaded: LoadedRobot, call: VelocityRequest, limits: Limits) -> Outcome:
    """Compute the tip's twists and their derivatives from joint rates, or joint rates from those of the tip."""
    robot = loaded.robot
    chain = robot.chain(call.base_frame, call.tip_frame)
    qs, rates = positions_and_rates(chain, call)
    field = requested_field(call, len(rates))
    if call.respect_limits:
        check_limits(chain, qs)
    space = TaskSpace(task_of(call.task), call.characteristic_length, call.reference)
    _check_size(call, len(qs), len(chain), limits)
    check_worked(call, len(qs))
    question = _Question(robot, chain, call, qs, rates, space, clearances_of(loaded, chain, call, qs))
    if field is None:
        return _forward_outcome(question, tip_motion(robot, chain, qs, rates, call.reference))
    rule = rule_of_call(chain, call, field, len(space))
    targets = targets_of_call(call, field, space, len(qs))
    null_motion = null_motion_of_call(chain, call, qs, field, space, question.climb)
    found = inverse_motion(robot, chain, qs, rates, targets, rule, space=space, null_motion=null_motion)
    return _inverse_outcome(question, field, found)


def is_heavy(call: VelocityRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    slow = (call.joint_snaps, call.tip_accelerations, call.tip_jerks, call.null_space, call.scene, call.min_clearance)
    detailed = call.steps or call.singularity_reports
    return detailed or any(part is not None for part in slow) or len(call.joint_positions) > _QUICK


def _check_size(call: VelocityRequest, count: int, joints: int, limits: Limits) -> None:
    if call.singularity_reports and count > MAX_REPORTS:
        raise TooLarge("configurations with whole singularity reports", count, MAX_REPORTS)
    matrices = 6 * joints * len(RATES) if call.jacobian_derivatives else 0
    check_numbers(count * (50 + joints + matrices + (100 + 10 * joints) * call.singularity_reports), limits)


def _forward_outcome(question: _Question, motion: TipMotion) -> Outcome:
    chain, call, space, derivatives = question.chain, question.call, question.space, motion.derivatives

    def content() -> dict[str, Any]:
        moved = {name: np.ascontiguousarray(each) for name, each in zip(_DERIVATIVES, derivatives, strict=False)}
        if motion.spatial_accelerations is not None:
            moved["spatial_accelerations"] = np.ascontiguousarray(motion.spatial_accelerations)
        Js, terms = jacobians_with_terms(chain, question.qs, call.reference)
        rule = InverseRule(rank_tolerance=call.rank_tolerance)
        parts = decompose(Js[:, space.rows], rule, space.scales, rounding(terms))
        answer = _answer(question, moved, _results(question, question.rates[0], parts), motion)
        return answer | worked_motions(call, space, question.rates, motion) if call.steps else answer

    def array() -> tuple[Array, dict[str, str]]:
        return (derivatives[0] if len(derivatives) == 1 else np.stack(derivatives, axis=1)), {}

    return Outcome(content, None if call.jacobian_derivatives or call.steps else array)


def _inverse_outcome(question: _Question, field: str, found: InverseMotion) -> Outcome:
    inversion = found.inversion
    unsolved = [i for i, status in enumerate(inversion.statuses) if status == "singular"]

    def content() -> dict[str, Any]:
        solutions: list[list[float] | None] = inversion.xs.tolist()
        for row in unsolved:
            solutions[row] = None
        speeds = question.rates[0] if len(question.rates) else inversion.xs
        results = _results(question, speeds, inversion.decomposition)
        for row, result in enumerate(results):
            result.update(_verdict(question, found, row))
        steps = _worked(question, field, found, results) if question.call.steps else {}
        return steps | _answer(question, {RATES[TIP[field]]: solutions}, results, found.motion)

    def array() -> tuple[Array, dict[str, str]]:
        named = ",".join(map(str, unsolved[:_ROWS_NAMED]))
        return inversion.xs, {"Gelenk-Unsolved": str(len(unsolved)), "Gelenk-Unsolved-Rows": named}

    return Outcome(content, None if question.call.jacobian_derivatives or question.call.steps else array)


def _worked(question: _Question, field: str, found: InverseMotion, results: list[dict[str, Any]]) -> dict[str, Any]:
    """Add the matrices of each inversion to its result, and return the steps."""
    call, space, qs = question.call, question.space, question.qs
    wanted = targets_of_call(call, field, space, len(qs))
    null_motion = null_motion_of_call(question.chain, call, qs, field, space, question.climb)
    nearest = None if question.clearances is None else question.clearances.worked
    solved = worked_inversions(question.chain, call, space, qs, question.rates, wanted, null_motion, found, nearest)
    for result, (matrices, _) in zip(results, solved, strict=True):
        result["derivation"] = matrices
    return {"steps": [steps for _, steps in solved]}


def _answer(
    question: _Question, found: dict[str, Any], results: list[dict[str, Any]], motion: TipMotion
) -> dict[str, Any]:
    answer = {
        **head(question.chain),
        "reference": question.call.reference,
        "task": question.space.task.directions,
        "rank_tolerance": question.call.rank_tolerance,
        **found,
        "results": results,
    }
    if question.call.jacobian_derivatives:
        answer["jacobian_derivatives"] = np.ascontiguousarray(motion.jacobians.swapaxes(0, 1))
    about = {} if question.clearances is None else question.clearances.about
    return answer | about | {"certificate": motion.certificate}


def _results(question: _Question, speeds: Array, parts: Decomposition) -> list[dict[str, Any]]:
    """Return the report of each configuration, common to all requests; speeds of shape (N, n)."""
    chain, call, space = question.chain, question.call, question.space
    limits = velocity_limits(question.robot, chain)
    highest = structure(chain, space.task, space.reference).rank
    conditions = condition_numbers(parts.sigmas, parts.ranks)
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
        if question.clearances is not None:
            results[row]["clearance"] = question.clearances.result(row, speeds[row])
        if call.singularity_reports:
            report = singularity_report(chain, question.qs[row], tolerance=call.rank_tolerance, space=space)
            results[row]["singularity_report"] = singularity_info(chain, report)
    return results


def _verdict(question: _Question, found: InverseMotion, row: int) -> dict[str, Any]:
    inversion, residual, rows = found.inversion, found.residuals[row], np.array(question.space.rows)
    status, damping = inversion.statuses[row], float(inversion.dampings[row])
    if status == "singular":
        return {"status": status, "reason": _no_inverse(question.call, inversion, row)}
    entry: dict[str, Any] = {
        "status": status,
        "residual": residual.tolist(),
        "residual_linear": float(np.linalg.norm(residual[rows < 3])),
        "residual_angular": float(np.linalg.norm(residual[rows >= 3])),
        "damping": damping,
    }
    if question.call.null_space is not None:
        entry["null_space_share"] = float(inversion.shares[row])
    if status == "approximate" and damping > 0.0:
        entry["reason"] = f"damping by {damping:.3g} keeps the joints slow at the price of this residual"
    elif status == "approximate":
        entry["reason"] = (
            "the tip cannot move like this: the residual is what no motion of the joints gives" + _fewer(question)
            if inversion.decomposition.ranks[row] < len(rows)
            else "the Jacobian is so nearly singular here that rounding of the fast joints is the residual"
        )
    return entry


def _fewer(question: _Question) -> str:
    """Say what an arm with fewer joints than directions can be asked instead."""
    joints, directions = len(question.chain), len(question.space)
    if joints >= directions:
        return ""
    few, many = counted(joints, "joint"), counted(directions, "direction")
    return f"; {few} cannot serve {many}: name those that count in `task`"


def _no_inverse(call: VelocityRequest, inversion: Inversion, row: int) -> str:
    rank, size = inversion.decomposition.ranks[row], inversion.xs.shape[1]
    if call.inverse == "exact" and rank < size:
        return (
            f"the Jacobian has rank {rank} with {counted(size, 'joint')}, so that it has no inverse: `damped` "
            "or `pseudo_inverse` give an answer here"
        )
    return "the Jacobian is so small here that the joints would be faster than any number says"
