"""All configurations with the tip at poses turned about an axis of its own: in limits, regular, touching nothing."""

from dataclasses import dataclass

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.ik.closed.branch_kernels import BranchTable
from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.search import in_pieces
from gelenk.ik.verdict.fixed import widened
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.follow.ladder import Rungs
from gelenk.trajectory.tool.singularity import regular

_PIECE = 1024
"""Targets that one thread solves at a time."""


@dataclass(frozen=True, slots=True)
class TurnedCandidates:
    """Configurations of each rung, with the tip's turn, (M,), [rad], and the branch codes, (M,)."""

    rungs: Rungs
    turns: Array
    codes: Indices


@dataclass(frozen=True, slots=True)
class Clear:
    """What configurations are clear of: singularities, by the least σ of all joints of the arm, and contacts."""

    least: float
    cell: Cell | None = None

    def flags(self, form: ClosedForm, qs: Array) -> Flags:
        """Flag the clear ones of the configurations of a form; shape (N,)."""
        whole, qs = widened(form.chain, qs)
        clear = regular(whole.flat, qs, self.least)
        if self.cell is not None:
            clear[clear] = ~self.cell.touching(qs[clear])
        return clear


def candidates(form: ClosedForm, poses: Poses, axis: Array, turns: Array, clear: Clear) -> TurnedCandidates:
    """Return the configurations within the limits that are clear.

    Args:
        poses: One of each rung.
        axis: About which the tip turns, in its frame; shape (3,).
        turns: The angles to try, [rad]; shape (K,).
    """
    rows, count = np.arange(len(poses) * len(turns)), len(turns)
    turned = poses.rotations[:, None] @ rotations_from_vectors(turns[:, None] * axis)
    targets = Poses(np.repeat(poses.positions, count, axis=0), turned.reshape(-1, 3, 3))
    found: dict[int, tuple[Array, Indices, Indices]] = {}

    def solve(part: slice) -> None:
        each = Poses(targets.positions[part], targets.rotations[part])
        table = form.solve(each, mid_range(form.chain)[None])
        kept = clear.flags(form, table.qs)
        owners = np.repeat(rows[part], np.diff(table.firsts))
        found[part.start] = table.qs[kept], table.codes[kept], owners[kept]

    in_pieces(solve, len(rows), _PIECE, small=False)
    qs, codes, owners = (np.concatenate(each) for each in zip(*(found[k] for k in sorted(found)), strict=True))
    firsts = np.searchsorted(owners, count * np.arange(len(poses) + 1))
    return TurnedCandidates(Rungs(qs, firsts), turns[owners % count], codes)


def solved_near(form: ClosedForm, targets: Poses, qs: Array) -> tuple[BranchTable, Flags]:
    """Return the solution of each target nearest to a configuration, and which targets have one."""
    table = form.solve(targets, qs, most=1)
    return table, np.diff(table.firsts) > 0
