"""A request for a workspace, checked and planned, so that errors are reported before a job is created."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.contract.workspace import SlicePlane, WorkspaceRequest
from gelenk.errors import InvalidField
from gelenk.kinematics.workspace.dexterity import Orientations, excluded, orientations
from gelenk.kinematics.workspace.survey import POINT_COLUMNS, VOXEL_COLUMNS
from gelenk.kinematics.workspace.tip_motion import TipReach
from gelenk.kinematics.workspace.voxels import MAX_VOXELS, merged
from gelenk.kinematics.workspace.workspace import PART, Plane, SamplingPlan, Wish, plan, sampled
from gelenk.robot.chain import Chain
from gelenk.robot.description import Description
from gelenk.robot.robot import RobotModel

CellOf: TypeAlias = Callable[[RobotModel, Chain], Cell]

MAX_POSES = 1_000_000
"""Largest number of poses that a job may pass to inverse kinematics: orientations times voxels."""
_COUNTED_PARTS = 8
"""Number of parts of the samples computed to estimate the number of voxels: some tenths of a second."""
_TOO_LOW = 1.25
"""Factor by which the estimated number of voxels may be too low."""


@dataclass(frozen=True, slots=True)
class WorkspaceWork:
    """A checked request for a workspace, and the plan for computing it.

    `orientations` are those of a dexterity map, else None. If the chain cannot reach all of these in any region,
    `excluded` says why; see `dexterity.excluded`. `cell_of` returns the cell of the robot if contacts matter.
    """

    name: str
    description: Description
    chain: Chain
    wish: Wish
    plan: SamplingPlan
    orientations: Orientations | None
    excluded: str | None
    cell_of: CellOf | None

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of the result array."""
        if self.wish.kind == "cloud":
            return POINT_COLUMNS
        return VOXEL_COLUMNS if self.orientations is None else (*VOXEL_COLUMNS, "dexterity")


def workspace_work(
    name: str, robot: RobotModel, call: WorkspaceRequest, cell_of: CellOf | None = None, warnings: Sequence[str] = ()
) -> WorkspaceWork:
    """Check a request as far as that depends on the robot, and plan its computation; raises InvalidField.

    `cell_of` returns the cell in which contacts matter, and `warnings` say what to know of it.
    """
    chain = robot.chain(call.base_frame, call.tip_frame)
    wish = Wish(
        call.kind,
        call.samples,
        call.sequence,
        call.random_seed,
        call.voxel_size,
        None if call.task is None else tuple(call.task),
        None if call.plane is None else _plane(call.plane),
        {joint: (bounds[0], bounds[1]) for joint, bounds in call.joint_ranges.items()},
    )
    work, motion = plan(chain, wish)
    wanted = reason = None
    if call.kind == "dexterity":
        wanted = orientations(chain, motion, call.orientations_over, call.orientations)
        reason = excluded(motion, work.grid.dimensions, wanted.spread)
        notes = (*work.notes, *_spread_notes(motion, wish.plane, wanted), *([reason] if reason else []))
        work = replace(work, notes=notes)
    if cell_of is not None:
        work = replace(work, world=cell_of(robot, chain).world.flat, notes=(*work.notes, *warnings))
    return WorkspaceWork(name, replace(robot.description, warnings=()), chain, wish, work, wanted, reason, cell_of)


def _plane(plane: SlicePlane) -> Plane:
    length = math.hypot(*plane.normal)
    if length == 0.0:
        raise InvalidField("plane/normal", "a normal cannot have length zero")
    return Plane(np.array(plane.origin), np.array(plane.normal) / length, plane.thickness)


def _spread_notes(motion: TipReach, plane: Plane | None, wanted: Orientations) -> list[str]:
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
    if wanted.spread == "fixed":
        notes.append("the tip never turns: only this orientation is tested")
    elif wanted.spread == "turns":
        notes.append("the tip rotates about one direction only: only rotations about it are tested")
    return notes


def check_size(job: WorkspaceWork) -> None:
    """Raise InvalidField if the samples fall into too many voxels; it names what is allowed instead.

    Samples in contact count too: to find them takes long.
    """
    plan, rotations = replace(job.plan, world=None), 1 if job.orientations is None else len(job.orientations.rotations)
    most = MAX_VOXELS if job.orientations is None else min(MAX_VOXELS, MAX_POSES // rotations)
    if min(plan.sampling.count, plan.grid.most_cells(plan.extent)) <= most:
        return
    voxels = _voxels_met(plan)
    if voxels <= most:
        return
    sentence = f"the samples fall into some {voxels:,} voxels"
    if job.orientations is not None:
        sentence += f", at each of which {rotations} orientations are asked for"
    ways = [f"at most {most:,} `samples`"]
    if (size := plan.grid.least_size(plan.extent, most)) < plan.extent:
        ways.insert(0, f"voxels of {_rounded_up(size):g} m or more")
    if job.orientations is not None:
        ways.append("fewer `orientations`")
    raise InvalidField("voxel_size", f"{sentence}; at most {most:,} are allowed: ask for {' or '.join(ways)}")


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
