"""The workspace of a robot as a job: samples in parts, then dexterity voxel by voxel, then a summary."""

import pickle
from dataclasses import asdict, fields, replace
from functools import lru_cache
from typing import Any, Literal, TypeAlias

import numpy as np
import orjson

from gelenk.collision.cell import Cell
from gelenk.jobs.parts import Parts, packed, unpacked
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work
from gelenk.jobs.store import write_result
from gelenk.jobs.workspace_request import WorkspaceWork
from gelenk.kinematics.workspace.dexterity import Orientations, shares
from gelenk.kinematics.workspace.sampling import Sampling
from gelenk.kinematics.workspace.survey import Measures, Survey, Workspace
from gelenk.kinematics.workspace.voxels import Grid, VoxelTable
from gelenk.kinematics.workspace.workspace import PART, SampledPart, SamplingPlan, sampled
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

KIND = "workspace"
SUMMARY, ARRAY = "result.json", "result.npy"
_SAMPLES, _VOXELS = "samples", "voxels"
"""Names of the first stage of every workspace, and of the second stage of a dexterity map."""

_POSES_AT_ONCE = 512
"""Number of poses per part: inverse kinematics takes about a tenth of a second."""
_SAMPLING_SHARE, _DONE = 0.05, 0.99
"""Progress when the samples of a dexterity map are computed, and when only the result remains to be written."""

Column: TypeAlias = Literal["x", "y", "z", "measure", "samples", "best_measure", "dexterity"]


def work_of(request: WorkspaceWork) -> Work:
    """Return the function that runs a request as a job."""

    def work(run: Run) -> Files:
        end = _DONE if request.orientations is None else _SAMPLING_SHARE
        run.map(_SAMPLES, _sampled, lambda k: (request.plan, k), request.plan.parts, (0.0, end), PART)
        found = run.apart(_put_together, (request, run.parts, run.job.robot_digest))
        return {} if found is None else _files(request, found, _dexterity(run, request, found), run.job.robot_digest)

    return work


def _put_together(job: tuple[WorkspaceWork, Parts, str | None]) -> Workspace | None:
    """Combine the parts and write the result files, in a process of its own; of a dexterity map return them instead."""
    request, parts, digest = job
    survey = Survey(request.plan)
    for part in parts.of(_SAMPLES, request.plan.parts):
        survey.add(_part(part))
    robot = RobotModel(request.description, (request.chain.base_frame, request.chain.tip_frame))
    cell = None if request.cell_of is None else request.cell_of(robot, request.chain)
    found = survey.result(robot, request.chain, cell)
    if request.orientations is not None:
        return found
    for name, content in _files(request, found, None, digest).items():
        write_result(parts.folder, name, content)
    return None


def _files(request: WorkspaceWork, found: Workspace, dexterity: Array | None, robot_digest: str | None) -> Files:
    table = found.points if found.points is not None else found.voxel_rows(request.plan)
    array = table if dexterity is None else np.column_stack((table, dexterity))
    content = _summary(request, found, dexterity) | {"robot_digest": robot_digest}
    summary = orjson.dumps(content, option=orjson.OPT_SERIALIZE_NUMPY)
    return {
        ARRAY: lambda target: np.lib.format.write_array(target, array, allow_pickle=False),
        SUMMARY: lambda target: target.write(summary),
    }


def _dexterity(run: Run, request: WorkspaceWork, found: Workspace) -> Array:
    """Compute the share of the orientations that are reached at the centre of each voxel; shape (M,)."""
    assert request.orientations is not None  # noqa: S101 - called for dexterity maps only
    centres = request.plan.grid.centres(found.voxels.keys)
    pickled = pickle.dumps(request)
    size = max(1, _POSES_AT_ONCE // len(request.orientations.rotations))

    def part(k: int) -> tuple[bytes, Array, Indices]:
        cells = slice(k * size, (k + 1) * size)
        return pickled, centres[cells], found.voxels.first[cells]

    count = -(-len(centres) // size)
    run.map(_VOXELS, _shares, part, count, (_SAMPLING_SHARE, _DONE), size)
    return np.concatenate([np.empty(0), *(unpacked(part, "shares")["shares"] for part in run.parts.of(_VOXELS, count))])


def _sampled(job: tuple[SamplingPlan, int]) -> bytes:
    """Compute a part of the samples and pack it, in a process of its own; see `sampled`."""
    part = sampled(job)
    return packed(
        numbers=(part.first, part.free, part.count, part.best),
        points=part.points,
        **asdict(part.voxels),
        box=(part.lower, part.upper),
        distances=part.distances,
        measures=part.measures,
    )


def _part(content: bytes) -> SampledPart:
    values = unpacked(content)
    first, free, count, best = values["numbers"].tolist()
    near, far = values["distances"].tolist()
    least, most, total = values["measures"].tolist()
    voxels = VoxelTable(*(values[entry.name] for entry in fields(VoxelTable)))
    lower, upper = values["box"]
    return SampledPart(
        first, values.get("points"), voxels, free, count, lower, upper, (near, far), (least, most, total), best
    )


def _shares(job: tuple[bytes, Array, Indices]) -> bytes:
    """Compute the dexterity at some voxels and pack it, in a process of its own; see `shares`."""
    pickled, centres, numbers = job
    robot, chain, sampling, spread, cell = _unpacked(pickled)
    return packed(shares=shares(robot, chain, centres, sampling.chosen(numbers), spread, cell))


@lru_cache(maxsize=2)
def _unpacked(pickled: bytes) -> tuple[RobotModel, Chain, Sampling, Orientations, Cell | None]:
    """Return the input of inverse kinematics; revolute joints without limits or a requested range stay unbounded."""
    request: WorkspaceWork = pickle.loads(pickled)  # noqa: S301 - written by this service
    assert request.orientations is not None  # noqa: S101 - as in `_dexterity`
    ends = request.chain.base_frame, request.chain.tip_frame
    robot = RobotModel(request.description, ends)
    chain, sampling = robot.chain(*ends), request.plan.sampling
    sliding = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    bound = np.array(
        [i in sliding or name in (request.wish.ranges or {}) for i, name in enumerate(chain.joint_names)], dtype=bool
    )
    lower = np.where(bound, sampling.ranges.lower, chain.lower)
    upper = np.where(bound, sampling.ranges.upper, chain.upper)
    chain = replace(chain, lower=lower, upper=upper)
    cell = None if request.cell_of is None else request.cell_of(robot, chain)
    return robot, chain, sampling, request.orientations, cell


def _summary(request: WorkspaceWork, found: Workspace, dexterity: Array | None) -> dict[str, Any]:
    chain, work, wish = request.chain, request.plan, request.wish
    return {
        "robot": request.name,
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "kind": wish.kind,
        "samples": wish.samples,
        **({} if found.contacts is None else {"samples_free": found.free, "contact_certificate": found.contacts}),
        "samples_counted": found.count,
        "plane": None if wish.plane is None else asdict(wish.plane),
        "sequence": wish.sequence,
        "random_seed": wish.seed,
        "joint_ranges": np.column_stack((work.sampling.ranges.lower, work.sampling.ranges.upper)).tolist(),
        "bounding_box": None if found.bounds is None else dict(zip(("lower", "upper"), found.bounds, strict=True)),
        "reach": None if found.reach is None else dict(zip(("min", "max"), found.reach, strict=True)),
        "voxels": _voxels(work.grid, found),
        "measure": _measure(request, found),
        "dexterity": None if dexterity is None else _dexterity_summary(request, found, dexterity),
        "array": {
            "shape": [found.count if wish.kind == "cloud" else len(found.voxels), len(request.columns)],
            "columns": request.columns,
        },
        "notes": work.notes,
        "certificate": found.certificate,
    }


def _voxels(grid: Grid, found: Workspace) -> dict[str, Any]:
    count = len(found.voxels)
    return {
        "size": grid.size,
        "dimensions": grid.dimensions,
        "origin": grid.origin,
        "axes": grid.axes.T.tolist(),
        "count": count,
        "inner_count": found.inner,
        "volume": count * grid.cell,
        "inner_volume": found.inner * grid.cell,
        "volume_bounds": found.volume,
        "late_share": found.late,
    }


def _measure(request: WorkspaceWork, found: Workspace) -> dict[str, Any]:
    work, measures = request.plan, found.measures
    axes = (np.eye(3) if work.turn is None else work.turn).T
    directions = np.zeros((len(work.rows), 6))
    for k, row in enumerate(work.rows.tolist()):
        directions[k, 3 * (row // 3) : 3 * (row // 3) + 3] = axes[row % 3]
    values = dict.fromkeys(field.name for field in fields(Measures)) if measures is None else asdict(measures)
    return {"directions": directions.tolist(), **values}


def _dexterity_summary(request: WorkspaceWork, found: Workspace, values: Array) -> dict[str, Any]:
    assert request.orientations is not None  # noqa: S101 - as in `_dexterity`
    grid, full = request.plan.grid, found.voxels.keys[values == 1.0]
    counts = (0, 0, 0) if request.excluded else (len(grid.inner(full)), len(full), len(grid.grown(full)))
    lower, volume, upper = (count * grid.cell for count in counts)
    return {
        "method": "inverse_kinematics",
        "spread": request.orientations.spread,
        "orientations": len(request.orientations.rotations),
        "mean_share": float(values.mean()) if len(values) else None,
        "max_share": float(values.max()) if len(values) else None,
        "reached_count": int(np.sum(values > 0.0)),
        "full_count": len(full),
        "full_volume": volume,
        "full_volume_bounds": (lower, min(upper, found.volume[1])),
        "excluded": request.excluded,
    }
