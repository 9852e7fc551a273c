"""The workspace of any chain, by samples of its joint space within the limits.

A `Plan` holds all that a part of the samples is computed from, so that parts may go to any number of processes. What
of the tip's positions is requested, a cloud or cells of a grid, is gathered part by part; `Survey` puts the parts
together.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.kinematics.ik.words import DIRECTIONS, Direction
from gelenk.kinematics.kernels import chain_measures
from gelenk.kinematics.sampling import Sampling, Sequence, joint_ranges
from gelenk.kinematics.tip_motion import Motion, plane_axes, turned
from gelenk.kinematics.voxels import MOST_ALONG_AXIS, Grid, VoxelTable, voxel_table
from gelenk.model.arrays import Array, Flags, Indices
from gelenk.model.chain import Chain, FlatChain
from gelenk.model.errors import InvalidField

Kind: TypeAlias = Literal["cloud", "grid", "dexterity"]

PART = 65_536
"""Samples that are computed at once: some hundredths of a second."""

_CELLS = {"cloud": 40, "grid": 40, "dexterity": 14}
"""Cells along the longest side, unless their size is given."""


@dataclass(frozen=True, slots=True)
class Plane:
    """A slice of space: what is no further than half the thickness from a plane.

    Attributes:
        origin: A point of it, in the base; shape (3,), [m].
        normal: Unit vector; shape (3,).
        thickness: [m].
    """

    origin: Array
    normal: Array
    thickness: float

    def holds(self, positions: Array) -> Flags:
        """Which positions lie in it; shape (N, 3) → (N,)."""
        flags: Flags = np.abs((positions - self.origin) @ self.normal) <= 0.5 * self.thickness
        return flags


@dataclass(frozen=True, slots=True)
class Wish:
    """The request for a workspace.

    Attributes:
        kind: What the result is an array of.
        samples: How many configurations.
        sequence: See `Sampling`.
        seed: Likewise.
        voxel_size: Edge of a cell, [m]; a share of the workspace's longest side where None.
        directions: Rows of the Jacobian that the measure counts; None for the translation, as far as the tip moves.
        plane: To what positions are restricted.
        ranges: Between what bounds some variables are sampled, instead of their limits.
    """

    kind: Kind = "cloud"
    samples: int = 100_000
    sequence: Sequence = "random"
    seed: int = 0
    voxel_size: float | None = None
    directions: tuple[Direction, ...] | None = None
    plane: Plane | None = None
    ranges: Mapping[str, tuple[float, float]] | None = None


@dataclass(frozen=True, slots=True)
class Plan:
    """The input from which another process computes a part of the samples.

    Attributes:
        flat: The chain, turned so that the rows that count are rows of its Jacobian.
        turn: The rotation that takes its positions back to the base, where it was turned; shape (3, 3).
        rows: Rows of the Jacobian that the measure counts.
        sampling: The configurations.
        plane: To what positions are restricted.
        grid: The cells.
        is_singular: Whether the measure is zero wherever the chain is; what is computed is rounding then.
        keeps_points: Whether the positions themselves are wanted.
        extent: No position is further from the base's origin, [m].
        notes: What was assumed and what is special about the chain, one sentence each.
    """

    flat: FlatChain
    turn: Array | None
    rows: Indices
    sampling: Sampling
    plane: Plane | None
    grid: Grid
    is_singular: bool
    keeps_points: bool
    extent: float
    notes: tuple[str, ...]

    @property
    def parts(self) -> int:
        """How many parts the samples come in."""
        return -(-self.sampling.count // PART)

    def measured(self, qs: Array) -> tuple[Array, Array]:
        """Positions in the base, shape (N, 3), [m], and measures, shape (N,)."""
        positions, _, measures = chain_measures(self.flat, qs, self.rows)
        if self.is_singular:
            # Also where there are no rows or joints: Yoshikawa's product of nothing would be one.
            measures = np.zeros(len(qs))
        return (positions if self.turn is None else positions @ self.turn.T), measures


def plan(chain: Chain, wish: Wish) -> tuple[Plan, Motion]:
    """How a workspace is computed, and how the chain's tip moves.

    Raises:
        InvalidField: A range or the size of the voxels cannot be taken.
    """
    ranges = joint_ranges(chain, wish.ranges or {})
    sampling = Sampling(ranges, wish.samples, wish.sequence, wish.seed)
    motion = Motion(chain, sampling)
    flat, turn = chain.flat, None
    if wish.directions is not None:
        rows = [DIRECTIONS.index(direction) for direction in wish.directions]
    elif motion.rows is not None:
        rows = motion.rows
    else:
        flat, turn, rows = turned(chain.flat, motion.axes), motion.axes, list(range(motion.dimensions))
    return Plan(
        flat,
        turn,
        np.array(rows, dtype=np.int64),
        sampling,
        wish.plane,
        _grid(motion, wish),
        motion.is_singular(rows, turn),
        wish.kind == "cloud",
        motion.farthest,
        (*ranges.notes, *motion.notes(), *(() if wish.plane is None else motion.slice_notes(wish.plane.normal))),
    ), motion


def _grid(motion: Motion, wish: Wish) -> Grid:
    """Cells in space, or in the plane that is requested or that the tip stays in.

    Raises:
        InvalidField: So many along an axis that they cannot be distinguished.
    """
    if wish.plane is not None and motion.dimensions:
        origin, axes, dimensions = wish.plane.origin, plane_axes(wish.plane.normal), 2
    elif motion.dimensions == 3:
        origin, axes, dimensions = np.zeros(3), np.eye(3), 3
    else:
        dimensions = motion.dimensions
        still = motion.axes[:, dimensions:]
        origin, axes = still @ (still.T @ motion.positions[0]), motion.axes
    places = (motion.positions - origin) @ axes[:, :dimensions]
    size = wish.voxel_size
    if size is None:
        longest = float(np.ptp(places, axis=0).max(initial=0.0))
        size = _rounded(longest / _CELLS[wish.kind]) if longest > 1e-9 else 1e-3
    if dimensions and size > motion.farthest:
        allowed = f"at most {motion.farthest:.3g} m, which is how far this chain reaches"
        raise InvalidField("voxel_size", f"a voxel of {size:.3g} m is larger than the arm: {allowed}, can be taken")
    least = (motion.farthest + float(np.linalg.norm(origin))) / (MOST_ALONG_AXIS - 2)
    if size <= least:
        raise InvalidField("voxel_size", f"{size:.3g} m is too small for this chain: more than {least:.3g} m is needed")
    return Grid(origin, axes, dimensions, size)


def _rounded(length: float) -> float:
    """Two digits of a length."""
    return float(f"{length:.1e}")


@dataclass(frozen=True, slots=True)
class Part:
    """The results of some of the samples.

    Attributes:
        first: The number of the first of them.
        points: Of each that counts its position and measure, where wanted; shape (k, 4), [m].
        voxels: The cells that they fall into.
        count: How many count.
        lower: Smallest coordinates; shape (3,), [m], inf where none counts.
        upper: Largest coordinates likewise, -inf where none counts.
        distances: Smallest and largest distance from the base's origin, [m].
        measures: Smallest, largest and sum of the measures.
        best: The number of the sample of the largest.
    """

    first: int
    points: Array | None
    voxels: VoxelTable
    count: int
    lower: Array
    upper: Array
    distances: tuple[float, float]
    measures: tuple[float, float, float]
    best: int


def sampled(job: tuple[Plan, int]) -> Part:
    """Part number k of a plan; both as one argument, for a process of its own."""
    work, k = job
    first = k * PART
    qs = work.sampling.configurations(first, min(PART, work.sampling.count - first))
    positions, measures = work.measured(qs)
    numbers = np.arange(first, first + len(qs))
    if work.plane is not None:
        inside = work.plane.holds(positions)
        positions, measures, numbers = positions[inside], measures[inside], numbers[inside]
    distances = np.sqrt(np.einsum("ij,ij->i", positions, positions))
    best = int(np.argmax(measures)) if len(measures) else 0
    return Part(
        first,
        np.column_stack((positions, measures)) if work.keeps_points else None,
        voxel_table(work.grid.keys(positions), measures, numbers),
        len(positions),
        positions.min(axis=0, initial=np.inf),
        positions.max(axis=0, initial=-np.inf),
        (float(distances.min(initial=np.inf)), float(distances.max(initial=-np.inf))),
        (float(measures.min(initial=np.inf)), float(measures.max(initial=-np.inf)), float(measures.sum())),
        int(numbers[best]) if len(numbers) else -1,
    )
