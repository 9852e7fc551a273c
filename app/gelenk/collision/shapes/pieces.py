"""Convex pieces of a mesh: hulls of its connected parts, and of what planes cut concave ones into.

The greedy cuts are those of Mamou and Ghorbel, "A simple and efficient approach for 3D mesh approximate convex
decomposition", 2009, and of V-HACD after it, but on the surface itself: nothing is sampled, so all of it is in a piece.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from gelenk.collision.shapes.hulls import Hull, convex_hull, few_vertices
from gelenk.collision.shapes.planes import best_plane, flat_axes
from gelenk.collision.shapes.surfaces import Surface, cut, enclosed_volume, parts_of, surface_of, volume_within
from gelenk.robot.arrays import Array, Flags

MAX_PIECES = 16
"""Of a mesh; one of more connected parts is cut as if it were a single one."""
_WORTH = 0.05
"""Share of the volume of a mesh's hulls that a cut must save."""
_SMALLEST = 1e-24
"""Not worth a cut, whatever it saves, [m³]: what is so small may be a single point."""


@dataclass(frozen=True, eq=False)
class _Chunk:
    """A connected part of a mesh, or what planes left of it.

    Attributes:
        number: Of the part.
        surface: What is left of it.
        axes: Of the planes, as rows.
        is_open: Whether it is open at its low and at its high end along each axis, shape (3, 2).
    """

    number: int
    surface: Surface
    axes: Array
    is_open: Flags

    @cached_property
    def hull(self) -> Hull:
        return convex_hull(self.surface.points)

    @cached_property
    def could_save(self) -> float:
        """The most that cuts can save, [m³]: what of the hull is not known to be within the surface."""
        closed = np.flatnonzero(~self.is_open.all(axis=1))
        if not len(closed):
            return self.hull.volume
        up = np.roll(self.axes, 2 - closed[0], axis=0) * (-1.0 if self.is_open[closed[0], 1] else 1.0)
        return self.hull.volume - volume_within(self.surface, up)

    @cached_property
    def halves(self) -> tuple["_Chunk", "_Chunk"]:
        """Both sides of the plane that seems to save most."""
        return self._cut(*best_plane(self.surface, self.axes))

    @cached_property
    def middles(self) -> tuple["_Chunk", "_Chunk"]:
        """Both sides of the plane across the middle of its longest side."""
        along = self.surface.points @ self.axes.T
        axis = int(np.ptp(along, axis=0).argmax())
        return self._cut(axis, (along[:, axis].min() + along[:, axis].max()) / 2)

    def _cut(self, axis: int, offset: float) -> tuple["_Chunk", "_Chunk"]:
        below, above = cut(self.surface, self.axes[axis], offset)
        is_low, is_high = self.is_open.copy(), self.is_open.copy()
        is_low[axis, 1] = is_high[axis, 0] = True
        return replace(self, surface=below, is_open=is_low), replace(self, surface=above, is_open=is_high)

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
    ends = [np.full((3, 2), math.isnan(space)) for space in enclosed]
    numbered = enumerate(zip(surfaces, ends, strict=True))
    parts = _decomposed([_Chunk(number, surface, flat_axes(surface), end) for number, (surface, end) in numbered])
    hulls = [few_vertices(part.hull) for part in parts]
    volumes = np.bincount([part.number for part in parts], [hull.volume for hull in hulls])
    excess = [
        volume / space - 1.0 if space > 0.0 else math.nan for volume, space in zip(volumes, enclosed, strict=True)
    ]
    return [(hull.vertices, float(excess[part.number])) for part, hull in zip(parts, hulls, strict=True)]


def _decomposed(parts: list[_Chunk]) -> list[_Chunk]:
    """Halve the part where that saves most, as long as it is worth it."""
    worth = _WORTH * sum(part.hull.volume for part in parts) + _SMALLEST
    while len(parts) < MAX_PIECES and (waiting := [part for part in parts if part.could_save > worth]):
        best = max(waiting, key=lambda part: part.saved)
        halves = best.halves
        if best.saved < worth:
            best = max(waiting, key=lambda part: part.saved_later if part.could_save > 3.0 * worth else 0.0)
            halves = best.middles
            if best.saved_later < 3.0 * worth:
                break
        parts = [part for part in parts if part is not best] + [*halves]
    return parts
