"""The workspace of a robot as a job: samples in parts, then dexterity voxel by voxel, then a summary."""

import math
import pickle
from dataclasses import asdict, dataclass, fields, replace
from functools import lru_cache
from typing import Any, Literal, TypeAlias

import numpy as np
import orjson

from gelenk.errors import InvalidField
from gelenk.jobs.parts import Parts, packed, unpacked
from gelenk.jobs.run import Files, Run
from gelenk.jobs.runner import Work
from gelenk.jobs.store import write_result
from gelenk.kinematics.workspace.dexterity import Orientations, Over, excluded, orientations, shares
from gelenk.kinematics.workspace.sampling import Sampling
from gelenk.kinematics.workspace.survey import POINT_COLUMNS, VOXEL_COLUMNS, Survey, Workspace
from gelenk.kinematics.workspace.tip_motion import TipReach
from gelenk.kinematics.workspace.voxels import MAX_VOXELS, Grid, VoxelTable, merged
from gelenk.kinematics.workspace.workspace import PART, Plane, SampledPart, SamplingPlan, Wish, plan, sampled
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.description import Description
from gelenk.robot.robot import RobotModel

KIND = "workspace"
SUMMARY, ARRAY = "result.json", "result.npy"
_SAMPLES, _VOXELS = "samples", "voxels"
"""Names of the first stage of every workspace, and of the second stage of a dexterity map."""
MAX_POSES = 1_000_000
"""Largest number of poses that a job may pass to inverse kinematics: orientations times voxels."""

_POSES_AT_ONCE = 512
"""Number of poses per part: inverse kinematics takes about a tenth of a second."""
_COUNTED_PARTS = 8
"""Number of parts of the samples computed to estimate the number of voxels: some tenths of a second."""
_TOO_LOW = 1.25
"""Factor by which the estimated number of voxels may be too low."""
_SAMPLING_SHARE, _DONE = 0.05, 0.99
"""Progress when the samples of a dexterity map are computed, and when only the result remains to be written."""

Column: TypeAlias = Literal["x", "y", "z", "measure", "samples", "best_measure", "dexterity"]


@dataclass(frozen=True, slots=True)
class WorkspaceWork:
    """A checked request for a workspace, and the plan for computing it.

    Attributes:
        name: Name of the robot.
        description: Description of the robot.
        chain: The chain.
        wish: The requested options.
        plan: Plan of the samples.
        asked: Orientations of a dexterity map, else None.
        excluded: Why the chain cannot reach all of these in any region, if so; see `dexterity.excluded`.
    """

    name: str
    description: Description
    chain: Chain
    wish: Wish
    plan: SamplingPlan
    asked: Orientations | None
    excluded: str | None

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of the result array."""
        if self.wish.kind == "cloud":
            return POINT_COLUMNS
        return VOXEL_COLUMNS if self.asked is None else (*VOXEL_COLUMNS, "dexterity")


def question(name: str, robot: RobotModel, chain: Chain, wish: Wish, over: Over, count: int) -> WorkspaceWork:
    """Check a request and plan its computation, so that errors are reported before a job is created.

    `over` and `count` say what the orientations of a dexterity map cover, and how many there are.

    Raises:
        InvalidField: A value is not allowed.
    """
    work, motion = plan(chain, wish)
    asked = reason = None
    if wish.kind == "dexterity":
        asked = orientations(chain, motion, over, count)
        reason = excluded(motion, work.grid.dimensions, asked.spread)
        notes = (*work.notes, *_spread_notes(motion, wish.plane, asked), *([reason] if reason else []))
        work = replace(work, notes=notes)
    return WorkspaceWork(name, replace(robot.description, warnings=()), chain, wish, work, asked, reason)


def _spread_notes(motion: TipReach, plane: Plane | None, asked: Orientations) -> list[str]:
    """Return notes on why a dexterity map may not be what users expect."""
    notes = []
    if motion.kept_to is not None:
        notes.append(
            f"orientations are asked for at the middles of the voxels, and these are beside the {motion.kept_to} that "
            "the tip keeps to: hardly any is reached, if one is at all"
        )
    elif plane is not None and 0 < motion.dimensions < 3 and motion.slice_notes(plane.normal):
        notes.append(
            "orientations are asked for at the middles of the voxels: none is reached where the plane's origin is not "
            "on what the tip keeps to"
        )
    if asked.spread == "fixed":
        notes.append("the tip never turns: only this orientation is tested")
    elif asked.spread == "turns":
        notes.append("the tip rotates about one direction only: only rotations about it are tested")
    return notes


def work_of(asked: WorkspaceWork) -> Work:
    """Return the function that runs a request as a job."""

    def work(run: Run) -> Files:
        end = _DONE if asked.asked is None else _SAMPLING_SHARE
        run.map(_SAMPLES, _sampled, lambda k: (asked.plan, k), asked.plan.parts, (0.0, end), PART)
        found = run.apart(_put_together, (asked, run.parts, run.job.robot_digest))
        return {} if found is None else _files(asked, found, _dexterity(run, asked, found), run.job.robot_digest)

    return work


def _put_together(job: tuple[WorkspaceWork, Parts, str | None]) -> Workspace | None:
    """Combine the parts and write the result files, in a process of its own; of a dexterity map return them instead."""
    asked, parts, digest = job
    survey = Survey(asked.plan)
    for part in parts.of(_SAMPLES, asked.plan.parts):
        survey.add(_part(part))
    found = survey.result(RobotModel(asked.description, (asked.chain.base_frame, asked.chain.tip_frame)), asked.chain)
    if asked.asked is not None:
        return found
    for name, content in _files(asked, found, None, digest).items():
        write_result(parts.folder, name, content)
    return None


def _files(asked: WorkspaceWork, found: Workspace, dexterity: Array | None, robot_digest: str | None) -> Files:
    table = found.points if found.points is not None else found.voxel_rows(asked.plan)
    array = table if dexterity is None else np.column_stack((table, dexterity))
    told = _summary(asked, found, dexterity) | {"robot_digest": robot_digest}
    summary = orjson.dumps(told, option=orjson.OPT_SERIALIZE_NUMPY)
    return {
        ARRAY: lambda target: np.lib.format.write_array(target, array, allow_pickle=False),
        SUMMARY: lambda target: target.write(summary),
    }


def check_size(asked: WorkspaceWork) -> None:
    """Check that the samples do not fall into too many voxels, before a job is created.

    Raises:
        InvalidField: They do; the message names a voxel size and a number of samples that are allowed.
    """
    plan, rotations = asked.plan, 1 if asked.asked is None else len(asked.asked.rotations)
    most = MAX_VOXELS if asked.asked is None else min(MAX_VOXELS, MAX_POSES // rotations)
    if min(plan.sampling.count, plan.grid.most_cells(plan.extent)) <= most:
        return
    voxels = _voxels_met(plan)
    if voxels <= most:
        return
    told = f"the samples fall into some {voxels:,} voxels"
    if asked.asked is not None:
        told += f", at each of which {rotations} orientations are asked for"
    ways = [f"at most {most:,} `samples`"]
    if (size := plan.grid.least_size(plan.extent, most)) < plan.extent:
        ways.insert(0, f"voxels of {_rounded_up(size):g} m or more")
    if asked.asked is not None:
        ways.append("fewer `orientations`")
    raise InvalidField("voxel_size", f"{told}; at most {most:,} are allowed: ask for {' or '.join(ways)}")


def _voxels_met(plan: SamplingPlan) -> int:
    """Count the voxels that the samples fall into; if there are many samples, estimate it from the first of them.

    Good–Turing: the probability that the next sample falls into a new voxel is the share of samples that are alone in
    theirs; it decreases later. Chao: the number of unseen voxels follows from the numbers of voxels with one and with
    two samples; this is too low if voxels are not equally likely, in trials by up to a fifth.
    """
    counted = min(plan.parts, _COUNTED_PARTS)
    table = merged([sampled((plan, k)).voxels for k in range(counted)])
    samples = min(plan.sampling.count, counted * PART)
    later, once, twice = plan.sampling.count - samples, *(int(np.sum(table.counts == k)) for k in (1, 2))
    if not later or not once:
        return len(table)
    unseen = once**2 / (2.0 * max(twice, 1))
    met = len(table) + unseen * (1.0 - (1.0 - once / (samples * unseen + once)) ** later)
    return math.ceil(min(len(table) + once / samples * later, _TOO_LOW * met))


def _rounded_up(length: float) -> float:
    """Round a length up to three significant digits."""
    step = 10.0 ** (math.floor(math.log10(length)) - 2)
    return float(f"{math.ceil(length / step) * step:.6g}")


def _dexterity(run: Run, asked: WorkspaceWork, found: Workspace) -> Array:
    """Compute the share of the orientations that are reached at the centre of each voxel; shape (M,)."""
    assert asked.asked is not None  # noqa: S101 - called for dexterity maps only
    centres = asked.plan.grid.centres(found.voxels.keys)
    pickled = pickle.dumps(asked)
    size = max(1, _POSES_AT_ONCE // len(asked.asked.rotations))

    def part(k: int) -> tuple[bytes, Array, Indices]:
        cells = slice(k * size, (k + 1) * size)
        return pickled, centres[cells], found.voxels.first[cells]

    count = -(-len(centres) // size)
    run.map(_VOXELS, _shares, part, count, (_SAMPLING_SHARE, _DONE), size)
    return np.concatenate([np.empty(0), *(unpacked(part)["shares"] for part in run.parts.of(_VOXELS, count))])


def _sampled(job: tuple[SamplingPlan, int]) -> bytes:
    """Compute a part of the samples and pack it, in a process of its own; see `sampled`."""
    part = sampled(job)
    return packed(
        numbers=(part.first, part.count, part.best),
        points=part.points,
        **asdict(part.voxels),
        box=(part.lower, part.upper),
        distances=part.distances,
        measures=part.measures,
    )


def _part(content: bytes) -> SampledPart:
    values = unpacked(content)
    first, count, best = values["numbers"].tolist()
    near, far = values["distances"].tolist()
    least, most, total = values["measures"].tolist()
    voxels = VoxelTable(*(values[entry.name] for entry in fields(VoxelTable)))
    lower, upper = values["box"]
    return SampledPart(
        first, values.get("points"), voxels, count, lower, upper, (near, far), (least, most, total), best
    )


def _shares(job: tuple[bytes, Array, Indices]) -> bytes:
    """Compute the dexterity at some voxels and pack it, in a process of its own; see `shares`."""
    pickled, centres, numbers = job
    robot, chain, sampling, spread = _unpacked(pickled)
    return packed(shares=shares(robot, chain, centres, sampling.chosen(numbers), spread))


@lru_cache(maxsize=2)
def _unpacked(pickled: bytes) -> tuple[RobotModel, Chain, Sampling, Orientations]:
    """Return the input of inverse kinematics; revolute joints without limits or a requested range stay unbounded."""
    asked: WorkspaceWork = pickle.loads(pickled)  # noqa: S301 - written by this service
    assert asked.asked is not None  # noqa: S101
    ends = asked.chain.base_frame, asked.chain.tip_frame
    robot = RobotModel(asked.description, ends)
    chain, sampling = robot.chain(*ends), asked.plan.sampling
    sliding = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    bound = np.array(
        [i in sliding or name in (asked.wish.ranges or {}) for i, name in enumerate(chain.joint_names)], dtype=bool
    )
    lower = np.where(bound, sampling.ranges.lower, chain.lower)
    upper = np.where(bound, sampling.ranges.upper, chain.upper)
    return robot, replace(chain, lower=lower, upper=upper), sampling, asked.asked


def _summary(asked: WorkspaceWork, found: Workspace, dexterity: Array | None) -> dict[str, Any]:
    chain, work, wish = asked.chain, asked.plan, asked.wish
    certificate = found.certificate
    return {
        "robot": asked.name,
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "kind": wish.kind,
        "samples": wish.samples,
        "samples_counted": found.count,
        "plane": None if wish.plane is None else asdict(wish.plane),
        "sequence": wish.sequence,
        "random_seed": wish.seed,
        "joint_ranges": np.column_stack((work.sampling.ranges.lower, work.sampling.ranges.upper)).tolist(),
        "bounding_box": None if found.bounds is None else dict(zip(("lower", "upper"), found.bounds, strict=True)),
        "reach": None if found.reach is None else dict(zip(("min", "max"), found.reach, strict=True)),
        "voxels": _voxels(work.grid, found),
        "measure": _measure(asked, found),
        "dexterity": None if dexterity is None else _dexterity_summary(asked, found, dexterity),
        "array": {
            "shape": [found.count if wish.kind == "cloud" else len(found.voxels), len(asked.columns)],
            "columns": asked.columns,
        },
        "notes": work.notes,
        "certificate": asdict(certificate.poses)
        | {"max_jacobian_error": certificate.max_jacobian_error, "max_measure_error": certificate.max_measure_error},
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


def _measure(asked: WorkspaceWork, found: Workspace) -> dict[str, Any]:
    work, measures = asked.plan, found.measures
    axes = (np.eye(3) if work.turn is None else work.turn).T
    directions = np.zeros((len(work.rows), 6))
    for k, row in enumerate(work.rows.tolist()):
        directions[k, 3 * (row // 3) : 3 * (row // 3) + 3] = axes[row % 3]
    content: dict[str, Any] = {"directions": directions.tolist()}
    names = ("min", "mean", "max", "position", "joint_positions")
    if measures is None:
        return content | dict.fromkeys(names)
    values = (measures.least, measures.mean, measures.most, measures.position, measures.joint_positions)
    return content | dict(zip(names, values, strict=True))


def _dexterity_summary(asked: WorkspaceWork, found: Workspace, values: Array) -> dict[str, Any]:
    assert asked.asked is not None  # noqa: S101
    grid, full = asked.plan.grid, found.voxels.keys[values == 1.0]
    counts = (0, 0, 0) if asked.excluded else (len(grid.inner(full)), len(full), len(grid.grown(full)))
    lower, volume, upper = (count * grid.cell for count in counts)
    return {
        "method": "inverse_kinematics",
        "spread": asked.asked.spread,
        "orientations": len(asked.asked.rotations),
        "mean_share": float(values.mean()) if len(values) else None,
        "max_share": float(values.max()) if len(values) else None,
        "reached_count": int(np.sum(values > 0.0)),
        "full_count": len(full),
        "full_volume": volume,
        "full_volume_bounds": (lower, min(upper, found.volume[1])),
        "excluded": asked.excluded,
    }
