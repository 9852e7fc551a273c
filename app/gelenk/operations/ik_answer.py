"""Answers of inverse kinematics, as JSON content and as tables."""

from collections.abc import Sequence
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
import orjson
from numpy.typing import NDArray

from gelenk.collision.contact.words import ContactCertificate
from gelenk.contract.ik import MAX_TRACE, InverseRequest
from gelenk.contract.pose import PoseFormat
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.words import IterationPath
from gelenk.ik.verdict.fixed import narrowed
from gelenk.ik.verdict.result import COLUMNS, COUNTED, InverseKinematics, UnsolvedTarget
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations.chains import head
from gelenk.operations.ik_contacts import FoundContacts
from gelenk.operations.ik_request import task_of
from gelenk.operations.ik_steps import worked
from gelenk.operations.pose_arrays import pose_list
from gelenk.operations.rows import json_list, objects
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses

_COLUMNS = attrgetter(*COLUMNS)
_ROWS_NAMED = 200
"""Maximum number of unsolved rows in a header: proxies allow headers of a few kilobytes."""

_MANY, _FEW = 64, 20
"""Number of results from which on encoding them by columns pays, if at most one in so many has failed."""
_SOLVED = b'{"status":"solved","solutions":[%b],"reason":null}'


def table(chain: Chain, result: InverseKinematics) -> Array:
    """Return one configuration per target, a solution or the nearest one; shape (N, n), [rad or m]."""
    rows = np.empty((len(result), len(chain)))
    solved = np.diff(result.firsts) > 0
    rows[solved] = result.qs
    for i, failure in result.failures.items():
        rows[i] = failure.nearest
    return rows


def unsolved_headers(unsolved: Sequence[int]) -> dict[str, str]:
    """Return the headers that mark rows of the table without a solution."""
    rows = ",".join(map(str, unsolved[:_ROWS_NAMED]))
    return {"Gelenk-Unsolved": str(len(unsolved)), "Gelenk-Unsolved-Rows": rows}


def to_json(
    chain: Chain,
    call: InverseRequest,
    closed_form: str | None,
    results: object,
    about: tuple[Sequence[str] | None, ContactCertificate] | None = None,
) -> dict[str, Any]:
    """Return the whole answer; the results come last, so that they can be written part by part.

    Of a cell `about` has the warnings, and the certificate.
    """
    answer = head(chain)
    answer["task"] = task_of(call).directions
    answer["closed_form"] = closed_form
    if about is not None:
        answer["warnings"], answer["certificate"] = about
    answer["results"] = results
    return answer


def results_to_json(
    problem: TargetProblem, call: InverseRequest, result: InverseKinematics, contacts: FoundContacts | None = None
) -> list[dict[str, Any]] | orjson.Fragment:
    """Return the result of each target."""
    is_worth_it = contacts is None and len(result) >= _MANY and len(result.failures) * _FEW <= len(result)
    if is_worth_it and (plain := plain_results(problem, call, result)) is not None:
        return plain.to_json()
    solutions, firsts = _solutions(result), result.firsts.tolist()
    if contacts is not None:
        for solution, contact in zip(solutions, contacts.of_solutions, strict=True):
            solution.update(contact)
    entries: list[dict[str, Any]] = [
        {"status": status, "solutions": solutions[firsts[i] : firsts[i + 1]], "reason": result.doubts.get(i)}
        for i, status in enumerate(result.statuses)
    ]
    if (proofs := result.complete) is not None:
        for i, complete in enumerate(proofs):
            entries[i].update(complete=complete, families=result.families.get(i, ()))
    if result.paths is not None:
        for i, path in enumerate(result.paths):
            entries[i].update(_path(path))
    for i, failure in result.failures.items():
        entries[i].update(_failure(problem.chain, call.pose_format, failure))
    if contacts is not None:
        for i, contact in contacts.of_nearest.items():
            entries[i]["nearest"].update(contact)
    if call.steps:
        for entry, steps in zip(entries, worked(problem, call, result, contacts), strict=True):
            entry["steps"] = steps
    return entries


class PlainResults(NamedTuple):
    """Results with one solution or none for each target, as arrays: a quarter of the bytes of their JSON.

    Attributes:
        rows: The table, see `table`; shape (N, n), [rad or m].
        errors: Position and orientation error of each solution; shape (2, M), [m] and [rad].
        counts: Iterations, restarts and number in `kinds` of each solution; shape (3, M).
        kinds: Methods with branches, as a JSON list of pairs.
        unsolved: Ascending indices of the targets without a solution; shape (K,).
        reasons: Their results, as a JSON list.
    """

    rows: Array
    errors: Array
    counts: NDArray[np.int32]
    kinds: NDArray[np.uint8]
    unsolved: Indices
    reasons: NDArray[np.uint8]

    def to_json(self) -> orjson.Fragment:
        """Encode the results, in a third of the time, without a Python object for each number."""
        kinds = [tuple(map(orjson.dumps, kind)) for kind in orjson.loads(self.kinds.tobytes())]
        iterations, restarts, numbers = self.counts
        methods, branches = zip(*map(kinds.__getitem__, numbers.tolist()), strict=True) if kinds else ((), ())
        columns: dict[str, Any] = {
            "joint_positions": np.delete(self.rows, self.unsolved, axis=0),
            "position_error": self.errors[0],
            "orientation_error": self.errors[1],
            "method": list(methods),
            "iterations": iterations,
            "restarts": restarts,
            "branch": list(branches),
        }
        pieces, start, reasons = [], 0, orjson.loads(self.reasons.tobytes())
        for before, i in enumerate([*self.unsolved.tolist(), len(self.rows)]):
            rows = slice(start - before, i - before)
            pieces.append(objects({name: column[rows] for name, column in columns.items()}, _SOLVED))
            pieces.append(orjson.dumps(reasons[before : before + 1]))
            start = i + 1
        return json_list(piece for piece in pieces if piece != b"[]")


def plain_results(problem: TargetProblem, call: InverseRequest, result: InverseKinematics) -> PlainResults | None:
    """Return the results as arrays; None if they hold more than a solution or a reason for each target."""
    has_elbow = result.form is not None and result.form.has_free_elbow
    if result.every or result.paths or call.steps or result.doubts or has_elbow or result.free.any():
        return None
    codes, numbers = np.unique(result.codes, return_inverse=True)
    kinds = [(_method(result, code), _branch(result, code)) for code in codes.tolist()]
    unsolved = sorted(result.failures)
    reasons = [_unsolved(problem.chain, call.pose_format, result.failures[i]) for i in unsolved]
    return PlainResults(
        table(problem.chain, result),
        np.array((result.position_errors, result.orientation_errors)),
        np.array((result.iterations, result.restarts, numbers), dtype=np.int32),
        np.frombuffer(orjson.dumps(kinds), np.uint8),
        np.array(unsolved, dtype=np.int64),
        np.frombuffer(orjson.dumps(reasons, option=orjson.OPT_SERIALIZE_NUMPY), np.uint8),
    )


def _unsolved(chain: Chain, pose_format: PoseFormat, failure: UnsolvedTarget) -> dict[str, Any]:
    return {"status": failure.status, "solutions": [], **_failure(chain, pose_format, failure)}


def _method(result: InverseKinematics, code: int) -> str:
    if result.form and code >= 0:
        return result.form.method
    return "continuation" if code == COUNTED else result.method


def _branch(result: InverseKinematics, code: int) -> dict[str, str | int] | None:
    return result.form.branch(code) if result.form and code >= 0 else None


def _solutions(result: InverseKinematics) -> list[dict[str, Any]]:
    """Return each solution with its method, its branch, and the joints that a singularity leaves free."""
    form, solutions = result.form, []
    rows = zip(*[column.tolist() for column in _COLUMNS(result)], strict=True)
    for q, position_error, orientation_error, iterations, restarts, code, free in rows:
        solution = {
            "joint_positions": q,
            "position_error": position_error,
            "orientation_error": orientation_error,
            "method": _method(result, code),
            "iterations": iterations,
            "restarts": restarts,
            "branch": _branch(result, code),
        }
        if form and code >= 0 and free:
            solution["free_joints"] = form.free_joints(free)
        solutions.append(solution)
    if form and form.has_free_elbow:
        angles = form.elbow_angles(narrowed(form.chain, result.qs)).tolist()
        for solution, angle in zip(solutions, angles, strict=True):
            solution["elbow_angle"] = angle
    return solutions


def _failure(chain: Chain, pose_format: PoseFormat, failure: UnsolvedTarget) -> dict[str, Any]:
    nearest = Poses(*chain_poses(chain.flat, failure.nearest[None]))
    entry: dict[str, Any] = {
        "reason": failure.reason,
        "nearest": {
            "joint_positions": failure.nearest.tolist(),
            "pose": pose_list(nearest, pose_format)[0],
            "position_error": failure.position_error,
            "orientation_error": failure.orientation_error,
        },
    }
    if failure.blocking_joints:
        entry["blocking_joints"] = failure.blocking_joints
    if failure.unserved_directions is not None:
        entry["unserved_directions"] = failure.unserved_directions.tolist()
    if failure.is_late:
        entry["stop_reason"] = "time_limit"
    return entry


def _path(path: IterationPath) -> dict[str, Any]:
    entry: dict[str, Any] = {"stop_reason": path.stop_reason}
    if path.trace is not None:
        every = max(1, -(-(len(path.trace) - 1) // (MAX_TRACE - 1)))
        if every > 1:
            entry["note"] = f"the trace reports 1 in {every} of {len(path.trace)} configurations, and the last"
        entry["trace"] = [*path.trace[:-1:every], *path.trace[-1:]]
    return entry
