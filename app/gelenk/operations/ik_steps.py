"""The worked solutions of an inverse kinematics answer."""

from typing import Any

from gelenk.contract.ik import InverseRequest
from gelenk.course.inverse.agreement import SentSolutions, hand_steps, solver_step
from gelenk.course.inverse.arm import HandArm, hand_arm
from gelenk.course.inverse.contact import contact_step
from gelenk.course.steps import Step
from gelenk.dh.tables.from_chain import standard_table
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.language import language
from gelenk.operations.ik_contacts import FoundContacts
from gelenk.operations.trace_steps import worked_trace


def worked(
    problem: TargetProblem, call: InverseRequest, result: InverseKinematics, contacts: FoundContacts | None = None
) -> list[list[Step]]:
    """Return the worked solution of each target, in the language of the request."""
    arm = None if call.fixed_joints else _arm(problem)
    directions, firsts = frozenset(problem.task.directions), result.firsts.tolist()
    answers = []
    with language(call.language):
        for i, pose in enumerate(problem.targets.matrices()):
            rows = slice(firsts[i], firsts[i + 1])
            steps = arm and hand_steps(arm, SentSolutions(pose, directions, result.qs[rows]))
            answers.append(steps or [_otherwise(result, rows)])
        for i, path in enumerate(result.paths or ()):
            answers[i] += worked_trace(problem, i, path, given_step_size=call.step_size is not None)
        if contacts is not None:
            for i in range(len(answers)):
                own = contacts.of_solutions[firsts[i] : firsts[i + 1]] or [contacts.of_nearest.get(i, {})]
                answers[i] += _contact(own, call.min_clearance or 0.0)
    return answers


def _contact(own: list[dict[str, Any]], demanded: float) -> list[Step]:
    """Return the step about the contacts of a target's solutions, if anything can touch anything."""
    if not own[0].get("pair"):
        return []
    free = sum(not one.get("in_collision", True) for one in own)
    nearest = own[0]["pair"]["a"], own[0]["pair"]["b"]
    return [contact_step([one["clearance"] for one in own], nearest, demanded, free)]


def _otherwise(result: InverseKinematics, rows: slice) -> Step:
    form, codes = result.form, result.codes[rows].tolist()
    branches = [form.branch(code) if form and code >= 0 else {} for code in codes]
    return solver_step(result.closed_form, result.method, result.qs[rows], branches)


def _arm(problem: TargetProblem) -> HandArm | None:
    """Return the chain as a table; None where none describes it, or a row follows another joint."""
    chain = problem.chain
    table = standard_table(problem.robot.description, chain)
    if table is None or len(table.joints) != len(chain) or any(row.mimic is not None for row in table.joints):
        return None
    return hand_arm(table)
