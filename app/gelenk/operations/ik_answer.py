"""Answers of inverse kinematics, as JSON content and as tables."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from gelenk.contract.ik import MAX_TRACE, InverseRequest
from gelenk.contract.pose import PoseFormat
from gelenk.ik.verdict.fixed import narrowed
from gelenk.ik.verdict.result import COUNTED, InverseKinematics, IterationPath, SolutionBranches, UnsolvedTarget
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations.ik_request import task_of
from gelenk.operations.pose_arrays import pose_list
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses

_ROWS_NAMED = 200
"""Maximum number of unsolved rows in a header: proxies allow headers of a few kilobytes."""


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


def told(chain: Chain, call: InverseRequest, closed_form: str | None, results: list[Any]) -> dict[str, Any]:
    """Return the whole answer; the results come last, so that they can be written part by part."""
    return {
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "task": task_of(call).directions,
        "closed_form": closed_form,
        "results": results,
    }


def closed_form_of(result: InverseKinematics) -> str | None:
    """Return the name of the closed form, or of the method for six joints without one; None if neither was used."""
    return None if result.branches is None else result.branches.name


def told_results(chain: Chain, pose_format: PoseFormat, result: InverseKinematics) -> list[dict[str, Any]]:
    """Return the result of each target."""
    solutions = [
        {
            "joint_positions": q,
            "position_error": position_error,
            "orientation_error": orientation_error,
            "method": result.method,
            "iterations": iterations,
            "restarts": restarts,
            "branch": None,
        }
        for q, position_error, orientation_error, iterations, restarts in zip(
            result.qs.tolist(),
            result.position_errors.tolist(),
            result.orientation_errors.tolist(),
            result.iterations.tolist(),
            result.restarts.tolist(),
            strict=True,
        )
    ]
    if result.branches is not None:
        _name_branches(solutions, result.branches, result.qs)
    firsts = result.firsts.tolist()
    entries: list[dict[str, Any]] = [
        {"status": status, "solutions": solutions[firsts[i] : firsts[i + 1]], "reason": None}
        for i, status in enumerate(result.statuses)
    ]
    if result.complete is not None:
        for entry, complete in zip(entries, result.complete, strict=True):
            entry["complete"], entry["families"] = complete, []
    for i, families in result.families.items():
        entries[i]["families"] = [
            {
                "free_joints": family.free_joints,
                "relation": family.relation,
                "text": family.text,
                "sweep": family.sweep.tolist(),
            }
            for family in families
        ]
    for i, doubt in result.doubts.items():
        entries[i]["reason"] = doubt
    if result.paths is not None:
        for entry, path in zip(entries, result.paths, strict=True):
            entry.update(_path(path))
    for i, failure in result.failures.items():
        entries[i].update(_failure(chain, pose_format, failure))
    return entries


def _name_branches(solutions: list[dict[str, Any]], branches: SolutionBranches, qs: Array) -> None:
    """Add to each solution its method, its branch, and the joints that a singularity leaves free."""
    form = branches.form
    for solution, code, free in zip(solutions, branches.codes.tolist(), branches.free.tolist(), strict=True):
        if code == COUNTED:
            solution["method"] = "continuation"
        elif form and code >= 0:
            solution["method"], solution["branch"] = form.method, form.branch(code)
            if free:
                solution["free_joints"] = form.free_joints(free)
    if form and form.has_free_elbow:
        for solution, angle in zip(solutions, form.elbow_angles(narrowed(form.chain, qs)).tolist(), strict=True):
            solution["elbow_angle"] = angle


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
        entry["trace"] = [
            {
                "error": iterate.error,
                "min_singular_value": iterate.min_singular_value,
                "step_length": iterate.step_length,
                "method": iterate.method,
                "joint_positions": iterate.joint_positions.tolist(),
            }
            for iterate in [*path.trace[:-1:every], *path.trace[-1:]]
        ]
    return entry
