"""Clouds of points as convex pieces: a sphere around each point, or, of many points, a box around those of a cell."""

import math
from collections.abc import Iterator

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.shapes.covers import NO_POINTS, covered_body
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.poses import transform

MAX_PIECES = 10_000
_DEPTH = 20
"""How often cells are halved at most."""


def cloud_bodies(name: str, link: str, points: Array, radius: float, T_link_cloud: Array) -> tuple[list[Body], float]:
    """Return pieces that contain a sphere around each point, at most `MAX_PIECES`.

    Args:
        name: Of the object.
        link: In whose frame it is placed.
        points: Centres of the spheres in the cloud's frame; shape (N, 3), [m].
        radius: Of each sphere, [m].
        T_link_cloud: Pose of the cloud in the link; shape (4, 4).

    Returns:
        The pieces, and how far at most a point of one is from every sphere, [m]; 0 where they are the spheres.
    """
    if len(points) <= MAX_PIECES:
        poses = (T_link_cloud @ transform(point, np.eye(3)) for point in points)
        return [covered_body(f"{name} {i}", link, "sphere", (radius,), T) for i, T in enumerate(poses, 1)], 0.0
    lows, highs = _boxes(points, _cells(points))
    # From a point of a box to the nearest of the points in it is at most the diagonal, and to its own box a corner.
    excess = float(np.linalg.norm(highs - lows, axis=1).max()) + (math.sqrt(3.0) - 1.0) * radius
    return list(box_bodies(name, link, lows - radius, highs + radius, T_link_cloud)), excess


def _cells(points: Array) -> Indices:
    """Number the cells of the finest grid of 2^k cells a side of which few enough hold points; shape (N,)."""
    low, extent = points.min(axis=0), float(np.ptp(points, axis=0).max())
    finest = np.minimum((points - low) / (extent or 1.0) * 2**_DEPTH, 2**_DEPTH - 1).astype(np.int64)
    found = np.zeros(len(points), dtype=np.int64)
    for depth in range(1, _DEPTH + 1):
        x, y, z = (finest >> (_DEPTH - depth)).T
        cells = np.unique(x << 2 * _DEPTH | y << _DEPTH | z, return_inverse=True)[1]
        if cells.max() >= MAX_PIECES:
            break
        found = cells
    return found


def _boxes(points: Array, cells: Indices) -> tuple[Array, Array]:
    """Return the least and the largest coordinates of the points in each cell; shape (C, 3)."""
    order = np.argsort(cells)
    starts = np.flatnonzero(np.diff(cells[order], prepend=-1))
    return np.minimum.reduceat(points[order], starts), np.maximum.reduceat(points[order], starts)


def box_bodies(name: str, link: str, lows: Array, highs: Array, T_link_cloud: Array) -> Iterator[Body]:
    """Yield boxes, each covered by one sphere: finer covers would take longer to find than they save."""
    for i, (low, high) in enumerate(zip(lows, highs, strict=True), 1):
        size, T = high - low, T_link_cloud @ transform((low + high) / 2, np.eye(3))
        sphere = np.append(T[:3, 3], np.linalg.norm(size) / 2 * (1.0 + 1e-9))
        yield Body(f"{name} {i}", link, "box", tuple(size.tolist()), NO_POINTS, T, sphere[None])
