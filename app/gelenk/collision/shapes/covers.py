"""Spheres that cover a convex piece: whatever they do not touch, the piece does not touch either."""

import math

import numpy as np

from gelenk.collision.bodies import Body, PieceKind
from gelenk.collision.shapes.hulls import convex_hull
from gelenk.robot.arrays import Array

MAX_SPHERES = 16
_SIDES = 16
"""Of the prism around a cylinder."""
_ROUND = 1.75
"""A sphere is not divided whose radius is at most this multiple of half the piece's thickness; a cube's is 1.73."""


NO_POINTS = np.empty((0, 3))


def covered_body(
    name: str,
    link: str,
    kind: PieceKind,
    size: tuple[float, ...],
    T_link_body: Array,
    points: Array = NO_POINTS,
    excess: float = 0.0,
) -> Body:
    """Return a piece with the spheres that cover it; the arguments are those of `Body`."""
    spheres = cover(kind, size, points)
    spheres[:, :3] = spheres[:, :3] @ T_link_body[:3, :3].T + T_link_body[:3, 3]
    return Body(name, link, kind, size, points, T_link_body, spheres, excess)


def cover(kind: PieceKind, size: tuple[float, ...], points: Array) -> Array:
    """Return spheres x, y, z, radius that cover a piece, in its frame; shape (K, 4), K ≤ `MAX_SPHERES`, [m].

    A half-space has none. A polytope is halved again and again across its longest side; each part is the hull of its
    corners, and so within any sphere around them.
    """
    match kind:
        case "half_space":
            return np.empty((0, 4))
        case "sphere":
            return np.array([[0.0, 0.0, 0.0, size[0]]])
        case "capsule":
            return _along_capsule(*size)
        case "cylinder":
            return _of_polytope(_prism(*size))
        case "box":
            return _of_polytope(_prism_of(np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * size[:2] / 2, size[2]))
        case _:
            return _of_polytope(points)


def _along_capsule(radius: float, length: float) -> Array:
    """Return spheres on the axis of a capsule, each reaching half-way to the next at the capsule's radius."""
    count = min(MAX_SPHERES, 1 + math.ceil(length / radius))
    heights = np.linspace(-length / 2, length / 2, count)
    step = length / (count - 1) if count > 1 else 0.0
    return np.column_stack((np.zeros((count, 2)), heights, np.full(count, math.hypot(radius, step / 2))))


def _prism(radius: float, length: float) -> Array:
    angles = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    around = radius / math.cos(math.pi / _SIDES)
    return _prism_of(around * np.column_stack((np.cos(angles), np.sin(angles))), length)


def _prism_of(polygon: Array, length: float) -> Array:
    ends = [np.column_stack((polygon, np.full(len(polygon), z))) for z in (-length / 2, length / 2)]
    return np.concatenate(ends)


def _of_polytope(corners: Array) -> Array:
    """Halve the part with the largest sphere until there are enough, or all are about as wide as the piece is thick."""
    axes = np.linalg.eigh(np.cov(corners.T))[1]
    enough = _ROUND * float(np.ptp(corners @ axes, axis=0).min()) / 2
    parts = [(_sphere(corners), corners)]
    while len(parts) < MAX_SPHERES:
        largest = max(range(len(parts)), key=lambda i: parts[i][0][3])
        if parts[largest][0][3] <= enough:
            break
        parts += [(_sphere(half), half) for half in _halves(parts.pop(largest)[1])]
    return np.array([sphere for sphere, _ in parts])


def _halves(corners: Array) -> tuple[Array, Array]:
    """Cut the hull of corners across its longest side, in the middle; both parts again as corners.

    Every segment between corners of the two sides is cut, which gives all corners of the cut, and points inside it.
    """
    mean = corners.mean(axis=0)
    axis = np.linalg.eigh((corners - mean).T @ (corners - mean))[1][:, 2]
    heights = corners @ axis
    heights = heights - (heights.min() + heights.max()) / 2
    below, above = np.flatnonzero(heights < 0.0), np.flatnonzero(heights >= 0.0)
    share = (heights[above] / (heights[above] - heights[below, None]))[:, :, None]
    cut = (share * corners[below, None] + (1.0 - share) * corners[above]).reshape(-1, 3)
    lower, upper = (convex_hull(np.concatenate((corners[side], cut))).vertices for side in (below, above))
    return lower, upper


def _sphere(corners: Array) -> Array:
    """Return a sphere around corners, little larger than the smallest: its centre steps to the farthest of them.

    Bădoiu and Clarkson, "Smaller core-sets for balls", 2003.
    """
    centre = (corners.min(axis=0) + corners.max(axis=0)) / 2
    for step in range(2, 40):
        far = corners[np.argmax(((corners - centre) ** 2).sum(axis=1))]
        centre = centre + (far - centre) / step
    radius = math.sqrt(((corners - centre) ** 2).sum(axis=1).max())
    return np.array([*centre, radius * (1.0 + 1e-9)])
