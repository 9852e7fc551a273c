"""The workspace of any chain, from samples of its joint space within the limits.

A `SamplingPlan` holds all the input of a part of the samples, so any number of processes can compute parts. Each part
collects a point cloud or the cells of a grid from the tip's positions; `Survey` combines the parts.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.collision.contact.kernels import first_contacts
from gelenk.collision.contact.room import FlatWorld
from gelenk.errors import InvalidField
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.kinematics.simd.kernels import chain_measures
from gelenk.kinematics.workspace.sampling import Sampling, Sequence, joint_ranges
from gelenk.kinematics.workspace.tip_motion import TipReach, plane_axes, turned
from gelenk.kinematics.workspace.voxels import MOST_ALONG_AXIS, Grid, VoxelTable, voxel_table
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain, FlatChain

Kind: TypeAlias = Literal["cloud", "grid", "dexterity"]

PART = 65_536
"""Number of samples per part, computed in some hundredths of a second."""

_CELLS = {"cloud": 40, "grid": 40, "dexterity": 14}
"""Number of cells along the longest side, unless their size is given."""


@dataclass(frozen=True, slots=True)
class Plane:
    """A slice of space: all points within half the thickness of a plane.

    Attributes:
        origin, normal: A point of the plane, [m], and its unit normal, in the base frame; shape (3,) each.
        thickness: Thickness of the slice, [m].
    """

    origin: Array
    normal: Array
    thickness: float

    def holds(self, positions: Array) -> Flags:
        """Return which positions lie in the slice; shape (N, 3) → (N,)."""
        return np.asarray(np.abs((positions - self.origin) @ self.normal) <= 0.5 * self.thickness)


@dataclass(frozen=True, slots=True)
class Wish:
    """A request for a workspace.

    Attributes:
        sequence, seed: See `Sampling`.
        voxel_size: Edge length of a cell, [m]; None for a fixed share of the workspace's longest side.
        directions: Directions in the manipulability measure; None for the translations in which the tip moves.
        plane: Slice to which positions are restricted, if any.
        ranges: Sampling bounds of some variables, instead of their limits.
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
class SamplingPlan:
    """The input from which any process can compute a part of the samples.

    Attributes:
        flat: The chain, rotated if necessary so that the measure uses whole rows of its Jacobian.
        turn: Rotation that takes the chain's positions back to the base; shape (3, 3). None if not rotated.
        rows: Rows of the Jacobian in the measure.
        is_singular: Whether the measure is zero at every configuration, so that computed values are rounding.
        keeps_points: Whether to keep the positions themselves.
        extent: Upper bound of the tip's distance from the base's origin, [m].
        notes: Assumptions, and special properties of the chain, one sentence each.
        world: What may not touch; samples in contact do not count. None where contacts do not matter.
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
    world: FlatWorld | None = None

    @property
    def parts(self) -> int:
        """Number of parts of the samples."""
        return -(-self.sampling.count // PART)

    def measured(self, qs: Array) -> tuple[Array, Array]:
        """Compute positions in the base frame, shape (N, 3), [m], and measures, shape (N,)."""
        positions, _, measures = chain_measures(self.flat, qs, self.rows)
        if self.is_singular:
            # Also without rows or joints, where Yoshikawa's empty product would be one.
            measures = np.zeros(len(qs))
        return (positions if self.turn is None else positions @ self.turn.T), measures


def plan(chain: Chain, wish: Wish) -> tuple[SamplingPlan, TipReach]:
    """Return the plan, and how the chain's tip moves; raises InvalidField for a range or voxel size not allowed."""
    ranges = joint_ranges(chain, wish.ranges or {})
    sampling = Sampling(ranges, wish.samples, wish.sequence, wish.seed)
    motion = TipReach(chain, sampling)
    flat, turn = chain.flat, None
    if wish.directions is not None:
        rows = [DIRECTIONS.index(direction) for direction in wish.directions]
    elif motion.rows is not None:
        rows = motion.rows
    else:
        flat, turn, rows = turned(chain.flat, motion.axes), motion.axes, list(range(motion.dimensions))
    return SamplingPlan(
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


def _grid(motion: TipReach, wish: Wish) -> Grid:
    """Cells in space, in the requested plane, or in the plane or line that the tip stays in."""
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
        size = float(f"{longest / _CELLS[wish.kind]:.1e}") if longest > 1e-9 else 1e-3
    if dimensions and size > motion.farthest:
        allowed = f"at most {motion.farthest:.3g} m, which is how far this chain reaches"
        raise InvalidField("voxel_size", f"a voxel of {size:.3g} m is larger than the arm: use {allowed}")
    least = (motion.farthest + float(np.linalg.norm(origin))) / (MOST_ALONG_AXIS - 2)
    if size <= least:
        raise InvalidField("voxel_size", f"{size:.3g} m is too small for this chain: more than {least:.3g} m is needed")
    return Grid(origin, axes, dimensions, size)


@dataclass(frozen=True, slots=True)
class SampledPart:
    """The results of some of the samples.

    Attributes:
        points: Position [m] and measure of each sample that counts; shape (k, 4). None if not requested.
        free: Number of samples that are not in contact; all where contacts do not matter.
        count: Number of samples that count.
        lower, upper: Smallest and largest coordinates; shape (3,), [m]. inf and -inf if no sample counts.
        distances: Smallest and largest distance from the base's origin, [m].
        measures: Smallest, largest and sum of the measures.
        best: Number of the sample with the largest measure; -1 if no sample counts.
    """

    first: int
    points: Array | None
    voxels: VoxelTable
    free: int
    count: int
    lower: Array
    upper: Array
    distances: tuple[float, float]
    measures: tuple[float, float, float]
    best: int


def sampled(job: tuple[SamplingPlan, int]) -> SampledPart:
    """Compute part k of a plan; both come as one argument, for process pools."""
    work, k = job
    first = k * PART
    qs = work.sampling.configurations(first, min(PART, work.sampling.count - first))
    numbers = np.arange(first, first + len(qs))
    if work.world is not None:
        is_free = first_contacts(work.world, qs) < 0
        qs, numbers = qs[is_free], numbers[is_free]
    positions, measures = work.measured(qs)
    if work.plane is not None:
        inside = work.plane.holds(positions)
        positions, measures, numbers = positions[inside], measures[inside], numbers[inside]
    distances = np.sqrt(np.einsum("ij,ij->i", positions, positions))
    best = int(np.argmax(measures)) if len(measures) else 0
    return SampledPart(
        first,
        np.column_stack((positions, measures)) if work.keeps_points else None,
        voxel_table(work.grid.keys(positions), measures, numbers),
        len(qs),
        len(positions),
        positions.min(axis=0, initial=np.inf),
        positions.max(axis=0, initial=-np.inf),
        (float(distances.min(initial=np.inf)), float(distances.max(initial=-np.inf))),
        (float(measures.min(initial=np.inf)), float(measures.max(initial=-np.inf)), float(measures.sum())),
        int(numbers[best]) if len(numbers) else -1,
    )
