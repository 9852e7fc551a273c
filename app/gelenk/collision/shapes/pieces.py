"""Convex pieces of a mesh: hulls of its connected parts, and of what planes cut concave ones into.

The greedy cuts are those of Mamou and Ghorbel, "A simple and efficient approach for 3D mesh approximate convex
decomposition", 2009, and of V-HACD after it, but on the surface itself: nothing is sampled, so all of it is in a piece.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gelenk.collision.shapes.hulls import Hull, convex_hull, few_vertices
from gelenk.collision.shapes.surfaces import Surface, crossings, cut, enclosed_volume, parts_of, surface_of
from gelenk.robot.arrays import Array, Indices

MAX_PIECES = 16
"""Of a mesh; one of more connected parts is cut as if it were a single one."""
_WORTH = 0.05
"""Share of the volume of a mesh's hulls that a cut must save."""
_SMALLEST = 1e-24
"""Not worth a cut, whatever it saves, [m³]: what is so small may be a single point."""
_THIN = 1e-9
"""Extent along an axis, relative to the largest, up to which no plane across it is tried."""
_SLABS, _LEVELS = 8, 1e5
"""Planes are tried in so many slabs along each axis, at heights of which so many are told apart."""
_NORMALS = 32
"""Of how many of the largest triangles the directions are tried as axes."""
_ALIKE, _ACROSS = 0.999, 0.02
"""Directions are the same from this cosine on, and at right angles up to this one."""
_EDGES = ((0, 1, 2), (2, 0, 1), (1, 2, 0))
"""Two axes, and that of the edges of a box where sides across the two meet."""
_DIRECTIONS = np.array([*np.eye(3), *(np.eye(3)[i] + sign * np.eye(3)[j] for i, j, _ in _EDGES for sign in (1, -1))])
"""Across the sides of a box, and across its edges."""


@dataclass(frozen=True, eq=False)
class _Chunk:
    """A connected part of a mesh, or what planes left of it; the number of the part, and its axes as rows."""

    number: int
    surface: Surface
    axes: Array

    @cached_property
    def hull(self) -> Hull:
        return convex_hull(self.surface.points)

    @cached_property
    def halves(self) -> tuple["_Chunk", "_Chunk"]:
        """Both sides of the plane that seems to save most."""
        return self._cut(*_best_plane(self.surface, self.axes))

    @cached_property
    def middles(self) -> tuple["_Chunk", "_Chunk"]:
        """Both sides of the plane across the middle of its longest side."""
        along = self.surface.points @ self.axes.T
        axis = np.ptp(along, axis=0).argmax()
        return self._cut(self.axes[axis], (along[:, axis].min() + along[:, axis].max()) / 2)

    def _cut(self, normal: Array, offset: float) -> tuple["_Chunk", "_Chunk"]:
        below, above = cut(self.surface, normal, offset)
        return _Chunk(self.number, below, self.axes), _Chunk(self.number, above, self.axes)

    @cached_property
    def saved(self) -> float:
        """The volume that halving it saves, [m³]."""
        return self.hull.volume - sum(half.hull.volume for half in self.halves)

    @cached_property
    def saved_later(self) -> float:
        """The volume that halving it in the middle, and both halves again, saves, [m³]: of a ring only this does."""
        return self.hull.volume - sum(half.hull.volume - half.saved for half in self.middles)


def pieces_of(triangles: Array) -> list[tuple[Array, float]]:
    """Return the vertices of convex pieces around a mesh's triangles, shape (F, 3, 3), and the excess of each.

    At most `MAX_PIECES`, of shape (V, 3). The excess is the volume of all pieces of a connected part over that of the
    part, less one; NaN where its triangles do not enclose one.
    """
    whole = surface_of(triangles)
    surfaces = parts_of(whole)
    if len(surfaces) > MAX_PIECES:
        surfaces = [whole]
    enclosed = [enclosed_volume(surface) for surface in surfaces]
    parts = _decomposed([_Chunk(number, surface, _axes(surface)) for number, surface in enumerate(surfaces)], enclosed)
    hulls = [few_vertices(part.hull) for part in parts]
    volumes = np.bincount([part.number for part in parts], [hull.volume for hull in hulls])
    excess = [
        volume / space - 1.0 if space > 0.0 else math.nan for volume, space in zip(volumes, enclosed, strict=True)
    ]
    return [(hull.vertices, float(excess[part.number])) for part, hull in zip(parts, hulls, strict=True)]


def _decomposed(parts: list[_Chunk], enclosed: list[float]) -> list[_Chunk]:
    """Halve the part where that saves most, as long as it is worth it; `enclosed` bounds what it can save."""
    worth = _WORTH * sum(part.hull.volume for part in parts) + _SMALLEST
    done = [part for part, space in zip(parts, enclosed, strict=True) if part.hull.volume - space < worth]
    waiting = [part for part in parts if part not in done]
    while waiting and len(done) + len(waiting) < MAX_PIECES:
        best = max(waiting, key=lambda part: part.saved)
        halves = best.halves
        if best.saved < worth:
            best = max(waiting, key=lambda part: part.saved_later)
            halves = best.middles
            if best.saved_later < 3.0 * worth:
                break
        waiting.remove(best)
        for half in halves:
            (waiting if half.hull.volume > worth else done).append(half)
    return done + waiting


def _axes(surface: Surface) -> Array:
    """Return three axes at right angles, as rows, across which most of a surface's flat faces are."""
    first, second, third = np.moveaxis(surface.points[surface.faces], 1, 0)
    normals = np.cross(second - first, third - first)
    areas = np.linalg.norm(normals, axis=1)
    normals, areas = normals[areas > 0.0] / areas[areas > 0.0, None], areas[areas > 0.0]
    tried = np.concatenate((np.eye(3), normals[np.argsort(-areas)[:_NORMALS]]))
    alike = areas @ (np.abs(normals @ tried.T) > _ALIKE)
    x = tried[np.argmax(alike)]
    slant = np.abs(tried @ x)
    y = tried[np.argmin(slant)] if slant.min() > _ACROSS else tried[np.argmax(np.where(slant < _ACROSS, alike, -1.0))]
    y = y - y @ x * x
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def _best_plane(surface: Surface, axes: Array) -> tuple[Array, float]:
    """Return normal and offset of the plane across an axis that leaves the least volume, roughly, on its two sides."""
    local = Surface(surface.points @ axes.T, surface.faces)
    extents = np.ptp(local.points, axis=0)
    heights = local.points / np.maximum(extents, _THIN * extents.max()) @ _DIRECTIONS.T
    found = [(*_best_across(local, heights, axis), axis) for axis in range(3) if extents[axis] > _THIN * extents.max()]
    _, offset, axis = min(found)
    return axes[axis], offset


def _best_across(surface: Surface, heights: Array, axis: int) -> tuple[float, float]:
    """Return the rough volume that the best plane across one axis leaves, and its offset."""
    along = surface.points[:, axis]
    order = np.argsort(along)
    offsets = _offsets(along)
    count = np.searchsorted(along[order], offsets, "right")
    below, above = _extents(heights[order], count - 1), _extents(heights[order[::-1]], len(along) - 1 - count)
    cuts = _cuts(surface, heights, along, offsets)
    sides = [_rough_volume(np.minimum(one[0], cuts[0]), np.maximum(one[1], cuts[1])) for one in (below, above)]
    left = sides[0] + sides[1]
    best = int(np.argmin(left))
    return float(left[best]), float(offsets[best])


def _offsets(along: Array) -> Array:
    """Return where to try planes: in each slab just below and just above the height of most corners, of a face."""
    low, extent = along.min(), np.ptp(along)
    levels, counts = np.unique(np.round((along - low) / extent * _LEVELS), return_counts=True)
    slabs = (levels * _SLABS / _LEVELS).astype(int)
    chosen = (np.arange(_SLABS) + 0.5) * _LEVELS / _SLABS
    order = [i for i in np.argsort(counts) if 1 < levels[i] < _LEVELS - 1]
    chosen[slabs[order]] = levels[order]
    return np.asarray(low + np.concatenate((chosen - 1.0, chosen + 1.0)) / _LEVELS * extent)


def _extents(heights: Array, last: Indices) -> tuple[Array, Array]:
    """Return the least and the greatest heights up to each of some rows; shape (K, 9)."""
    return np.minimum.accumulate(heights)[last], np.maximum.accumulate(heights)[last]


def _cuts(surface: Surface, heights: Array, along: Array, offsets: Array) -> tuple[Array, Array]:
    """Return the least and the greatest heights in each plane, where edges pass it; shape (K, 9)."""
    starts, ends = surface.faces.ravel(), np.roll(surface.faces, -1, axis=1).ravel()
    is_up = along[starts] <= along[ends]
    low, high = np.where(is_up, starts, ends), np.where(is_up, ends, starts)
    lower, upper = along[low], along[high]
    across = [(lower <= offset) & (offset < upper) for offset in offsets]
    found = [crossings(heights, along - offset, low[on], high[on]) for offset, on in zip(offsets, across, strict=True)]
    return np.array([some.min(0, initial=np.inf) for some in found]), np.array(
        [some.max(0, initial=-np.inf) for some in found]
    )


def _rough_volume(least: Array, most: Array) -> Array:
    """Return the volume of a box whose edges are cut off, given its extent along all directions; (N, 9) → (N,)."""
    widths = most - least
    volume: Array = widths[:, :3].prod(axis=1)
    for k, (i, j, along) in enumerate(_EDGES):
        alike, unlike = 3 + 2 * k, 4 + 2 * k
        off = (
            most[:, i] + most[:, j] - most[:, alike],
            least[:, alike] - least[:, i] - least[:, j],
            most[:, i] - least[:, j] - most[:, unlike],
            least[:, unlike] - least[:, i] + most[:, j],
        )
        volume -= sum(side**2 for side in off) / 2.0 * widths[:, along]
    return volume
