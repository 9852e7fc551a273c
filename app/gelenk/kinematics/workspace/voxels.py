"""Cells of a regular grid that samples fall into: number of samples, first sample and best measure of each cell.

A table holds only the cells with samples, so its size depends on the workspace and not on a box around it. Tables of
parts of the samples merge into the table of all samples, in any order.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.errors import TooLarge
from gelenk.robot.arrays import Array, Indices

MAX_VOXELS = 2_000_000
"""Largest number of cells in a table: 64 MB."""
MOST_ALONG_AXIS = 1 << 20
"""Number of cells on either side of the origin that a key with 21 bits per axis can distinguish."""

_BITS = 21
_BALL = (1.0, 2.0, math.pi, 4.0 * math.pi / 3.0)
"""Volume of the unit ball in 0 to 3 dimensions."""


@dataclass(frozen=True, slots=True)
class Grid:
    """A grid of cells centred at origin + axes · (i, j, k) · size; one cell only along the last 3 - dimensions axes.

    Attributes:
        origin: Centre of cell (0, 0, 0); shape (3,), [m].
        axes: Unit vectors along the cells' edges, as columns; shape (3, 3).
        dimensions: Number of axes that are divided into cells: 3 in space, 2 in a plane.
        size: Edge length of a cell, [m].
    """

    origin: Array
    axes: Array
    dimensions: int
    size: float

    @property
    def cell(self) -> float:
        """Volume of a cell, [m³]; area in a plane, [m²]; length on a line, [m]; zero for a point."""
        return self.size**self.dimensions if self.dimensions else 0.0

    def most_cells(self, radius: float) -> float:
        """Bound the number of cells that meet a ball [m]: they all lie within a ball that is a cell diagonal larger."""
        return _BALL[self.dimensions] * (radius / self.size + math.sqrt(self.dimensions)) ** self.dimensions

    def least_size(self, radius: float, most: int) -> float:
        """Return the cell size at which `most_cells` equals `most`, [m]; inf if no size needs so few cells."""
        across = (most / _BALL[self.dimensions]) ** (1.0 / self.dimensions) - math.sqrt(self.dimensions)
        return radius / across if across > 0.0 else math.inf

    def keys(self, positions: Array) -> Indices:
        """Compute the key of the cell of each position; shape (N, 3) → (N,)."""
        places = (positions - self.origin) @ self.axes[:, : self.dimensions]
        indices = np.rint(places / self.size).astype(np.int64) + MOST_ALONG_AXIS
        keys = np.zeros(len(positions), dtype=np.int64)
        for axis in range(self.dimensions):
            keys |= indices[:, axis] << (_BITS * axis)
        return keys

    def centres(self, keys: Indices) -> Array:
        """Compute the centre of each cell; shape (M,) → (M, 3), [m]."""
        mask = (1 << _BITS) - 1
        shifts = _BITS * np.arange(self.dimensions)
        indices = ((keys[:, None] >> shifts) & mask) - MOST_ALONG_AXIS
        return np.asarray(self.origin + (indices * self.size) @ self.axes[:, : self.dimensions].T)

    def inner(self, keys: Indices) -> Indices:
        """Select the cells whose neighbours are all present, including edges and corners; shape (M,) → (k,).

        Among the cells that meet a region, the selected ones lie wholly inside it, provided that gaps in the region are
        nowhere thinner than two cells.
        """
        for step in self._steps():
            keys = keys[np.isin(keys - step, keys) & np.isin(keys + step, keys)]
        return keys

    def grown(self, keys: Indices) -> Indices:
        """Return the cells and all their neighbours, including edges and corners; shape (M,) → (k,)."""
        for step in self._steps():
            keys = np.unique(np.concatenate((keys - step, keys, keys + step)))
        return keys

    def _steps(self) -> list[int]:
        return [1 << (_BITS * axis) for axis in range(self.dimensions)]


@dataclass(frozen=True, slots=True)
class VoxelTable:
    """The cells that contain samples, in ascending order of their keys.

    Attributes:
        keys, counts: Keys of the cells, see `Grid.keys`, and number of samples in each; shape (M,) each.
        best, first: Largest measure and number of the first sample in each cell; shape (M,) each.
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
    """Collect the cells of N samples from their cells' keys, measures and numbers; shape (N,) each."""
    return _reduced(keys, np.ones(len(keys), dtype=np.int64), measures, numbers)


def coarser(grid: Grid, table: VoxelTable) -> tuple[Grid, VoxelTable]:
    """Merge cells into cells of twice the size; the grid's origin is then no longer the centre of a cell."""
    fields = sum(((1 << _BITS - 1) - 1) << (_BITS * axis) for axis in range(grid.dimensions))
    halved = _reduced((table.keys >> 1) & fields, table.counts, table.best, table.first)
    return replace(grid, size=2.0 * grid.size), halved


def merged(tables: Sequence[VoxelTable]) -> VoxelTable:
    """Merge several tables into one; raises TooLarge if it has more than `MAX_VOXELS` cells."""
    columns = zip(*((table.keys, table.counts, table.best, table.first) for table in tables), strict=True)
    table = _reduced(*map(np.concatenate, columns))
    if len(table) > MAX_VOXELS:
        raise TooLarge("voxels that samples fall into", len(table), MAX_VOXELS)
    return table


def _reduced(keys: Indices, counts: Indices, best: Array, first: Indices) -> VoxelTable:
    """Combine rows with the same key: sum of the counts, largest measure, smallest number."""
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
