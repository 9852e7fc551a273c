"""Surfaces of triangles: their connected parts, the volume within, and both sides of a plane."""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled

_HASH = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
"""Odd numbers: points of the same coordinates have the same key, and others hardly ever."""
_XYZ = np.eye(3)


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """Triangles that share corners.

    Attributes:
        points: The corners, shape (V, 3), [m].
        faces: Numbers of each triangle's corners, shape (F, 3).
    """

    points: Array
    faces: Indices


def surface_of(triangles: Array) -> Surface:
    """Return the surface of triangles, shape (F, 3, 3): corners of the same coordinates are one."""
    points, numbers = distinct(triangles.reshape(-1, 3))
    return Surface(points, numbers.reshape(-1, 3))


def distinct(points: Array) -> tuple[Array, Indices]:
    """Return the points that differ, shape (V, 3), and which of them each of the points, (N, 3), is, (N,)."""
    points = np.ascontiguousarray(points + 0.0)  # There are two zeros.
    keys = (points.view(np.uint64) * _HASH).sum(axis=1)
    _, first, numbers = np.unique(keys, return_index=True, return_inverse=True)
    if np.array_equal(points[first][numbers], points):
        return points[first], numbers
    return np.unique(points, axis=0, return_inverse=True)


def parts_of(surface: Surface) -> list[Surface]:
    """Split a surface into parts that share no corner."""
    labels = _components(surface.faces.ravel())
    part = labels[surface.faces[:, 0]]
    order = np.argsort(part, kind="stable")
    groups = np.split(surface.faces[order], np.flatnonzero(np.diff(part[order])) + 1)
    return [used(surface.points, faces) for faces in groups]


@compiled
def _components(corners: Indices) -> Indices:
    """Label each corner by the smallest one that it is connected with, given those of triangles, (3F,); shape (V,).

    Rem's algorithm (Dijkstra, "A discipline of programming", 1976, ch. 23): labels lead down to the smallest.
    """
    labels = np.arange(corners.max() + 1)
    for i in range(len(corners)):
        a, b = corners[i], corners[i - i % 3]
        while labels[a] != labels[b]:
            if labels[a] > labels[b]:
                a, b = b, a
            labels[b], b = labels[a], labels[b]
    for i in range(len(labels)):
        labels[i] = labels[labels[i]]
    return labels


def cut(surface: Surface, normal: Array, offset: float) -> tuple[Surface, Surface]:
    """Return what is on either side of the plane normal · x = offset: triangles across it are cut there.

    First that below. A side may have no triangle; those in the plane are below.
    """
    heights = surface.points @ normal - offset
    is_up = heights > 0.0
    count = is_up[surface.faces].sum(axis=1)
    across = surface.faces[(count == 1) | (count == 2)]
    # The corner that is alone on its side comes first.
    lone = (is_up[across] == (is_up[across].sum(axis=1) == 1)[:, None]).argmax(axis=1)
    a, b, c = np.take_along_axis(across, (lone[:, None] + np.arange(3)) % 3, axis=1).T
    points = np.concatenate([surface.points, *(crossings(surface.points, heights, a, other) for other in (b, c))])
    ab, ac = len(surface.points) + np.arange(2 * len(a)).reshape(2, -1)
    tips, rests = (
        np.column_stack((a, ab, ac)),
        np.concatenate((np.column_stack((ab, b, c)), np.column_stack((ab, c, ac)))),
    )
    tip_up = is_up[a]
    rest_up = np.tile(~tip_up, 2)
    below = surface.faces[count == 0], tips[~tip_up], rests[~rest_up]
    above = surface.faces[count == 3], tips[tip_up], rests[rest_up]
    return used(points, np.concatenate(below)), used(points, np.concatenate(above))


def crossings(points: Array, heights: Array, a: Indices, b: Indices) -> Array:
    """Return where edges from a to b, points of heights of either sign, pass the height 0; shape (E, 3)."""
    share = heights[a] / (heights[a] - heights[b])
    return np.asarray(points[a] + share[:, None] * (points[b] - points[a]))


def used(points: Array, faces: Indices) -> Surface:
    """Return a surface of only those points that are corners."""
    is_used = np.zeros(len(points), dtype=bool)
    is_used[faces] = True
    return Surface(points[is_used], (np.cumsum(is_used) - 1)[faces])


def enclosed_volume(surface: Surface) -> float:
    """Return the volume within, [m³]; NaN unless it closes: each edge is passed once in either direction."""
    starts, ends = surface.faces.ravel(), np.roll(surface.faces, -1, axis=1).ravel()
    count = len(surface.points)
    if not np.array_equal(np.sort(starts * count + ends), np.sort(ends * count + starts)):
        return math.nan
    return volume_within(surface)


def volume_within(surface: Surface, axes: Array = _XYZ) -> float:
    """Return the volume within a surface, [m³].

    Args:
        surface: Closed, or open at flat ends only: below, and at sides parallel to the last axis.
        axes: Orthonormal, as rows, shape (3, 3).
    """
    x, y, z = (surface.points @ axes.T)[surface.faces].T
    areas = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    return abs(float(areas @ (z.mean(axis=0) - z.min()))) / 2.0
