"""Spheres that cover a convex piece: whatever they do not touch, the piece does not touch either."""

import math

import numpy as np

from gelenk.collision.bodies import Body, PieceKind
from gelenk.collision.shapes.balls import ball_around
from gelenk.collision.shapes.hulls import convex_hull
from gelenk.collision.shapes.surfaces import Surface, cut
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
    hull = convex_hull(corners)
    axes = np.linalg.eigh(np.cov(hull.vertices.T))[1]
    enough = _ROUND * float(np.ptp(hull.vertices @ axes, axis=0).min()) / 2
    parts = [(ball_around(hull.vertices), Surface(hull.vertices, hull.faces))]
    while len(parts) < MAX_SPHERES:
        largest = max(range(len(parts)), key=lambda i: parts[i][0][3])
        if parts[largest][0][3] <= enough:
            break
        parts += [(ball_around(half.points), half) for half in _halves(parts.pop(largest)[1])]
    return np.array([sphere for sphere, _ in parts])


def _halves(surface: Surface) -> tuple[Surface, Surface]:
    """Cut what is left of a polytope's surface across its longest side, in the middle.

    The faces of the cuts need not be closed: all their corners are on the surface.
    """
    points = surface.points - surface.points.mean(axis=0)
    axis = np.linalg.eigh(points.T @ points)[1][:, 2]
    heights = surface.points @ axis
    return cut(surface, axis, float(heights.min() + heights.max()) / 2)
