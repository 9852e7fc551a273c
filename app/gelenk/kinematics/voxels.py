"""Cells of equal size that samples fall into: how often, how soon, and how manipulable the best of them is.

A table holds the cells that were met, and no others, so that its size is that of the workspace and not of a box around
it. Tables of parts of the samples merge into the table of all of them, whatever the order of the parts.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.model.arrays import Array, Indices
from gelenk.model.errors import TooLarge

MAX_VOXELS = 2_000_000
"""Cells of one table: 64 MB."""
MOST_ALONG_AXIS = 1 << 20
"""Cells to either side of the origin that a key of 21 bits an axis tells apart."""

_BITS = 21
_BALL = (1.0, 2.0, math.pi, 4.0 * math.pi / 3.0)
"""Volume of the unit ball by dimensions."""


@dataclass(frozen=True, slots=True)
class Grid:
    """Cells about the points origin + axes · (i, j, k) · size; along the last 3 - dimensions axes there is but one.

    Attributes:
        origin: Centre of cell (0, 0, 0); shape (3,), [m].
        axes: Unit vectors along the cells' edges, as columns; shape (3, 3).
        dimensions: Along how many of the axes the cells count: 3 in space, 2 in a plane.
        size: Edge of a cell, [m].
    """

    origin: Array
    axes: Array
    dimensions: int
    size: float

    @property
    def cell(self) -> float:
        """Volume of a cell, [m³], in a plane [m²], on a line [m]; a point has none."""
        return self.size**self.dimensions if self.dimensions else 0.0

    def most_cells(self, radius: float) -> float:
        """More cells than meet a ball about any point: those that do lie within one that is a cell's diagonal larger.

        Args:
            radius: Of the ball, [m].
        """
        return _BALL[self.dimensions] * (radius / self.size + math.sqrt(self.dimensions)) ** self.dimensions

    def least_size(self, radius: float, most: int) -> float:
        """The size at which `most_cells` comes to this, [m]; inf where that is too few for any size."""
        across = (most / _BALL[self.dimensions]) ** (1.0 / self.dimensions) - math.sqrt(self.dimensions)
        return radius / across if across > 0.0 else math.inf

    def keys(self, positions: Array) -> Indices:
        """The cell of each position, as one number; shape (N, 3) → (N,)."""
        places = (positions - self.origin) @ self.axes[:, : self.dimensions]
        indices = np.rint(places / self.size).astype(np.int64) + MOST_ALONG_AXIS
        keys = np.zeros(len(positions), dtype=np.int64)
        for axis in range(self.dimensions):
            keys |= indices[:, axis] << (_BITS * axis)
        return keys

    def centres(self, keys: Indices) -> Array:
        """The middle of each cell; shape (M,) → (M, 3), [m]."""
        mask = (1 << _BITS) - 1
        shifts = _BITS * np.arange(self.dimensions)
        indices = ((keys[:, None] >> shifts) & mask) - MOST_ALONG_AXIS
        centres: Array = self.origin + (indices * self.size) @ self.axes[:, : self.dimensions].T
        return centres

    def inner(self, keys: Indices) -> Indices:
        """The cells all of whose neighbours are there, also those across an edge or a corner; shape (M,) → (k,).

        Cells that meet a region have such ones only where they lie wholly inside it, if what it leaves out is nowhere
        thinner than two cells.
        """
        for step in self._steps():
            keys = keys[np.isin(keys - step, keys) & np.isin(keys + step, keys)]
        return keys

    def grown(self, keys: Indices) -> Indices:
        """The cells and all their neighbours, also those across an edge or a corner; shape (M,) → (k,)."""
        for step in self._steps():
            keys = np.unique(np.concatenate((keys - step, keys, keys + step)))
        return keys

    def _steps(self) -> list[int]:
        """The difference between the keys of neighbouring cells, along each axis."""
        return [1 << (_BITS * axis) for axis in range(self.dimensions)]


@dataclass(frozen=True, slots=True)
class VoxelTable:
    """The cells that samples have met, by ascending key.

    Attributes:
        keys: See `Grid.keys`; shape (M,).
        counts: How many samples each holds; shape (M,).
        best: The largest measure of these; shape (M,).
        first: The number of the first of them; shape (M,).
    """

    keys: Indices
    counts: Indices
    best: Array
    first: Indices

    def __len__(self) -> int:
        return len(self.keys)


_NONE = np.empty(0, dtype=np.int64)
NO_VOXELS = VoxelTable(_NONE, _NONE, np.empty(0), _NONE)


def voxel_table(keys: Indices, measures: Array, numbers: Indices) -> VoxelTable:
    """The cells of some samples.

    Args:
        keys: The cell of each; shape (N,).
        measures: Of each; shape (N,).
        numbers: Which sample each is; shape (N,).
    """
    return _reduced(keys, np.ones(len(keys), dtype=np.int64), measures, numbers)


def coarser(grid: Grid, table: VoxelTable) -> tuple[Grid, VoxelTable]:
    """The same samples in cells of twice the size; the grid's origin is no centre of one of these any more."""
    fields = sum(((1 << _BITS - 1) - 1) << (_BITS * axis) for axis in range(grid.dimensions))
    halved = _reduced((table.keys >> 1) & fields, table.counts, table.best, table.first)
    return replace(grid, size=2.0 * grid.size), halved


def merged(tables: Sequence[VoxelTable]) -> VoxelTable:
    """The cells of all samples of several tables.

    Raises:
        TooLarge: More than `MAX_VOXELS`.
    """
    table = _reduced(
        np.concatenate([table.keys for table in tables]),
        np.concatenate([table.counts for table in tables]),
        np.concatenate([table.best for table in tables]),
        np.concatenate([table.first for table in tables]),
    )
    if len(table) > MAX_VOXELS:
        raise TooLarge("voxels that samples fall into", len(table), MAX_VOXELS)
    return table


def _reduced(keys: Indices, counts: Indices, best: Array, first: Indices) -> VoxelTable:
    """One row a key: counts summed, the largest measure, the smallest number."""
    if len(keys) == 0:
        return NO_VOXELS
    order = np.argsort(keys)
    ordered = keys[order]
    starts = np.flatnonzero(np.concatenate(([True], ordered[1:] != ordered[:-1])))
    return VoxelTable(
        ordered[starts],
        np.add.reduceat(counts[order], starts),
        np.maximum.reduceat(best[order], starts),
        np.minimum.reduceat(first[order], starts),
    )
