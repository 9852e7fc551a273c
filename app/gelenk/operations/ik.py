"""Inverse kinematics of a robot."""

from typing import Any

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.contract.ik import MAX_STEPWISE, MAX_TARGETS, InverseRequest
from gelenk.ik.closed.closed_form import closed_form, is_looked_at, look_at
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.task import Task
from gelenk.ik.solve import solve, solve_quickly
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.operations.cells import cell_of, has_cell
from gelenk.operations.ik_answer import results_to_json, table, to_json, unsolved_headers
from gelenk.operations.ik_contacts import certify_table, contacts_of
from gelenk.operations.ik_plain import plain_outcome
from gelenk.operations.ik_request import PLAIN, QUICK_TARGETS, TargetLimits, has_table, parse, starts_of, task_of
from gelenk.operations.outcome import Limits, Outcome, RequestCounts, WarmUp
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import is_awaited
from gelenk.store.records import LoadedRobot

_SHARE_OF_TIME = 0.8
"""Share of a request's time for a search with a time limit: sending its result takes time too."""

at_once = plain_outcome


def run(loaded: LoadedRobot, call: InverseRequest, limits: Limits) -> Outcome:
    """Compute configurations that bring the tip to each target."""
    seconds = None if call.time_limit is None else min(call.time_limit, _SHARE_OF_TIME * limits.seconds)
    problem = parse(loaded.robot, call, _bounds(limits), seconds)
    found = cell_of(loaded, problem.chain, call)
    if found is None:
        return _outcome(problem, call, solve(problem))
    cell, warnings = found
    return _outcome(problem, call, solve(problem, cell), cell, warnings)


def attempt(loaded: LoadedRobot, call: InverseRequest, limits: Limits) -> Outcome | None:
    """Try the operation with a few starts; return None if they do not suffice."""
    problem = parse(loaded.robot, call, _bounds(limits))
    starts = starts_of(problem.chain, call.max_iterations)
    result = solve_quickly(problem, starts, by_form=call.method == "analytic")
    return None if result is None else _outcome(problem, call, result)


def _bounds(limits: Limits) -> TargetLimits:
    return TargetLimits(MAX_TARGETS, MAX_STEPWISE, limits.answer_numbers)


def is_heavy(call: InverseRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    one_by_search = call.__pydantic_fields_set__ <= PLAIN or (
        not has_cell(call)
        and call.method in {"auto", "analytic"}
        and call.elbow_angle is None
        and call.fixed_joints is None
        and call.solutions == "one"
        and not call.trace
        and not call.steps
        and call.objective is None
    )
    return is_awaited() or not one_by_search or len(call.targets) > QUICK_TARGETS


def _subject(loaded: LoadedRobot, call: InverseRequest) -> tuple[Chain, Task]:
    return loaded.robot.chain(call.base_frame, call.tip_frame), task_of(call)


WARM_UP: WarmUp[InverseRequest] = WarmUp(
    lambda loaded, call: is_looked_at(*_subject(loaded, call)),
    lambda loaded, call: closed_form(*_subject(loaded, call)),
    lambda loaded, call, found: look_at(*_subject(loaded, call), found),
)
"""The closed form of a chain, which takes some milliseconds to recognise."""


def _outcome(
    problem: TargetProblem,
    call: InverseRequest,
    result: InverseKinematics,
    cell: Cell | None = None,
    warnings: list[str] | None = None,
) -> Outcome:
    chain = problem.chain

    def content() -> dict[str, Any]:
        contacts = contacts_of(cell, result)
        about = contacts and (warnings, contacts.certificate)
        return to_json(chain, call, result.closed_form, results_to_json(problem, call, result, contacts), about)

    def array() -> tuple[Array, dict[str, str]]:
        rows = table(chain, result)
        certify_table(cell, result, rows)
        return rows, unsolved_headers(list(result.failures))

    return Outcome(
        content,
        array if has_table(call) else None,
        solved=lambda targets: RequestCounts(
            targets, result.verdicts, len(result.qs), int(np.add.reduce(result.iterations))
        ),
    )
