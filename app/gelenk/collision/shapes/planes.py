"""Planes that cut a mesh in two where its concave parts are."""

import numpy as np

from gelenk.collision.shapes.surfaces import Surface
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled

_THIN = 1e-9
"""Extent along an axis, relative to the largest, up to which no plane across it is tried."""
_SLABS, _LEVELS = 8, 100_000
"""Planes are tried in so many slabs along each axis, at heights of which so many are told apart."""
_NORMALS = 32
"""Of how many of the largest triangles the directions are tried as axes."""
_ALIKE, _ACROSS = 0.999, 0.02
"""Directions are the same from this cosine on, and at right angles up to this one."""
_EDGES = ((0, 1, 2), (2, 0, 1), (1, 2, 0))
"""Two axes, and that of the edges of a box where sides across the two meet."""
_SIDES = np.array([*np.eye(3), *(np.eye(3)[i] + sign * np.eye(3)[j] for i, j, _ in _EDGES for sign in (1, -1))])
_DIRECTIONS = np.concatenate((_SIDES, -_SIDES))
"""Across the sides of a box, and across its edges; then the opposite ones."""


def flat_axes(surface: Surface) -> Array:
    """Return three axes at right angles, as rows, across which most of a surface's flat faces are."""
    first, second, third = np.moveaxis(surface.points[surface.faces], 1, 0)
    normals = np.cross(second - first, third - first)
    areas = np.linalg.norm(normals, axis=1)
    normals, areas = normals[areas > 0.0] / areas[areas > 0.0, None], areas[areas > 0.0]
    tried = np.concatenate((np.eye(3), normals[np.argsort(-areas)[:_NORMALS]]))
    alike = areas @ (np.abs(normals @ tried.T) > _ALIKE).astype(float)
    x = tried[np.argmax(alike)]
    slant = np.abs(tried @ x)
    y = tried[np.argmin(slant)] if slant.min() > _ACROSS else tried[np.argmax(np.where(slant < _ACROSS, alike, -1.0))]
    y = y - y @ x * x
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def best_plane(surface: Surface, axes: Array) -> tuple[int, float]:
    """Return the number of an axis, and the offset of the plane across it that leaves the least volume, roughly."""
    points = surface.points @ axes.T
    extents = np.ptp(points, axis=0)
    heights = points / np.maximum(extents, _THIN * extents.max()) @ _DIRECTIONS.T
    faces = np.ascontiguousarray(surface.faces)
    wide = np.flatnonzero(extents > _THIN * extents.max())
    _, offset, axis = min((*_best_across(points[:, axis].copy(), heights, faces), axis) for axis in wide)
    return int(axis), offset


def _best_across(along: Array, heights: Array, faces: Indices) -> tuple[float, float]:
    """Return the rough volume that the best plane across an axis leaves, and its offset."""
    offsets = _offsets(along)
    within, cuts = _reaches(along, np.searchsorted(offsets, along), heights, faces, offsets)
    below, above = np.maximum.accumulate(within)[:-1], np.maximum.accumulate(within[::-1])[-2::-1]
    left = _rough_volume(np.maximum(below, cuts)) + _rough_volume(np.maximum(above, cuts))
    best = int(np.argmin(left))
    return float(left[best]), float(offsets[best])


def _offsets(along: Array) -> Array:
    """Return where to try planes, ascending: in each slab just below and just above the height of most corners."""
    low, extent = along.min(), np.ptp(along)
    counts = np.bincount(np.round((along - low) / extent * _LEVELS).astype(int))[:_LEVELS]
    counts[[0, 1, -1]] = 0
    counts = counts.reshape(_SLABS, -1)
    down = np.where(counts.any(axis=1), counts[:, ::-1].argmax(axis=1) + 1.0, counts.shape[1] / 2)
    chosen = np.arange(1, _SLABS + 1) * counts.shape[1] - down
    return np.asarray(low + np.sort(np.concatenate((chosen - 1.0, chosen + 1.0))) / _LEVELS * extent)


@compiled
def _reaches(along: Array, slabs: Indices, heights: Array, faces: Indices, offsets: Array) -> tuple[Array, Array]:
    """Return how far a surface reaches in all directions between planes, (K + 1, D), and in each, (K, D).

    Args:
        along: The corners' coordinates across the planes, shape (V,).
        slabs: Between which planes they are: the first one not below, shape (V,).
        heights: Along the directions, shape (V, D).
        faces: Numbers of each triangle's corners, shape (F, 3).
        offsets: Of the planes, ascending, shape (K,).
    """
    count, directions = len(offsets), heights.shape[1]
    within, cuts = np.full((count + 1, directions), -np.inf), np.full((count, directions), -np.inf)
    for i in range(len(along)):
        for d in range(directions):
            within[slabs[i], d] = max(within[slabs[i], d], heights[i, d])
    for f in range(len(faces)):
        for corner in range(3):
            a, b = faces[f, corner - 1], faces[f, corner]
            if slabs[a] > slabs[b]:
                a, b = b, a
            for k in range(slabs[a], slabs[b]):
                share = (offsets[k] - along[a]) / (along[b] - along[a])
                for d in range(directions):
                    cuts[k, d] = max(cuts[k, d], heights[a, d] + share * (heights[b, d] - heights[a, d]))
    return within, cuts


def _rough_volume(reach: Array) -> Array:
    """Return the volume of a box whose edges are cut off, by how far it reaches in all directions; (N, 18) → (N,)."""
    most, least = reach[:, : len(_SIDES)], -reach[:, len(_SIDES) :]
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
