"""How light falls on a mesh: round where its triangles meet at a small angle, with an edge where at a large one."""

import numpy as np

from gelenk.robot.arrays import Array, Indices

_CREASE = np.cos(np.radians(35.0))
_MOST_AROUND = 64
"""Largest number of triangles at a point for which they are compared with each other."""


def shaded(points: Array, triangles: Indices) -> tuple[Indices, Array, Indices]:
    """Return which point each vertex is (V,), its normal as signed bytes (V, 3), and triangles of vertices (F, 3).

    A point has a vertex for each of its normals. The normal of a corner is the mean of those of the triangles around
    its point that are nearly parallel to its own, weighted by their areas.
    """
    p, q, r = (points[triangles[:, corner]] for corner in range(3))
    areas = np.cross(q - p, r - p)
    units = areas / np.maximum(np.linalg.norm(areas, axis=1, keepdims=True), np.finfo(float).tiny)
    normals = _corner_normals(triangles.ravel(), areas, units)
    lengths = np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    quantised = np.rint(127 * normals / lengths).astype(np.int64)
    keys = ((triangles.ravel() * 256 + quantised[:, 0] + 128) * 256 + quantised[:, 1] + 128) * 256 + quantised[:, 2]
    _, first, vertices = np.unique(keys, return_index=True, return_inverse=True)
    return triangles.ravel()[first], quantised[first].astype(np.int8), vertices.reshape(-1, 3)


def _corner_normals(corners: Indices, areas: Array, units: Array) -> Array:
    """Return the normal of each corner (3 F, 3); the triangle of corner i is i // 3."""
    order = np.argsort(corners, kind="stable")
    around = np.bincount(corners)
    starts = np.cumsum(around) - around
    normals = areas[np.arange(len(corners)) // 3].copy()
    some = np.flatnonzero(around[corners] <= _MOST_AROUND)
    counts = around[corners[some]]
    mine = np.repeat(some, counts)
    step = np.arange(len(mine)) - np.repeat(np.cumsum(counts) - counts, counts)
    other = order[np.repeat(starts[corners[some]], counts) + step] // 3
    near = (units[mine // 3] * units[other]).sum(axis=1) > _CREASE
    for axis in range(3):
        sums = np.bincount(mine[near], areas[other[near], axis], len(corners))
        normals[some, axis] = sums[some]
    return normals
