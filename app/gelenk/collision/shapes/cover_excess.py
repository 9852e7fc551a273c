"""How much the spheres that cover a piece add to it: volume, and how far they stand out."""

import math

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.shapes.hulls import convex_hull
from gelenk.robot.arrays import Array

_RAYS = 64
_FLAT = 1e-4
"""Volume of a piece relative to its spheres' below which their ratio says nothing."""


def excess_of_cover(body: Body) -> float:
    """Return the volume of the spheres of a bounded piece over its own, less one; NaN of a flat piece.

    That of several spheres is known to about a thousandth.
    """
    inside, covered = volume_of(body), volume_of_union(body.spheres)
    return max(0.0, covered / inside - 1.0) if inside > _FLAT * covered else math.nan


def protrusion(body: Body) -> float:
    """Return the largest distance of a point of its spheres from a bounded piece, [m].

    In a direction u a sphere (c, r) reaches u·c + r, and the piece as far as its support function h(u). The distance of
    a point from a convex piece is the largest u·p - h(u), hence that of the sphere's points r + max (u·c - h(u)), which
    is r and the signed distance of the centre.
    """
    centres = (body.spheres[:, :3] - body.T_link_body[:3, 3]) @ body.T_link_body[:3, :3]
    return max(0.0, float((body.spheres[:, 3] + _signed_distances(body, centres)).max()))


def volume_of(body: Body) -> float:
    """Return the volume of a bounded piece, [m³]."""
    match body.kind, body.size:
        case "sphere", (r,):
            return _volume_of_sphere(r)
        case "capsule", (r, length):
            return math.pi * r**2 * (length + 4.0 / 3.0 * r)
        case "cylinder", (r, length):
            return math.pi * r**2 * length
        case "box", sizes:
            return math.prod(sizes)
        case _:
            return convex_hull(body.points).volume


def volume_of_union(spheres: Array) -> float:
    """Return the volume of spheres x, y, z, radius, shape (K, 4), along parallels to z through a grid, [m³].

    To about a thousandth; of a single one it is exact.
    """
    if len(spheres) == 1:
        return _volume_of_sphere(float(spheres[0, 3]))
    low, high = (spheres[:, :2] - spheres[:, 3:]).min(axis=0), (spheres[:, :2] + spheres[:, 3:]).max(axis=0)
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    x, y = (low + steps[:, None] * (high - low)).T
    apart = (x[:, None, None] - spheres[:, 0]) ** 2 + (y[:, None] - spheres[:, 1]) ** 2
    half = np.sqrt(np.maximum(spheres[:, 3] ** 2 - apart, 0.0)).reshape(-1, len(spheres))
    order = np.argsort(spheres[:, 2] - half, axis=1)
    starts = np.take_along_axis(spheres[:, 2] - half, order, axis=1)
    ends = np.maximum.accumulate(np.take_along_axis(spheres[:, 2] + half, order, axis=1), axis=1)
    before = np.column_stack((starts[:, 0], ends[:, :-1]))
    return float(np.maximum(ends - np.maximum(starts, before), 0.0).sum() * np.prod((high - low) / _RAYS))


def _volume_of_sphere(radius: float) -> float:
    return 4.0 / 3.0 * math.pi * radius**3


def _signed_distances(body: Body, centres: Array) -> Array:
    """Return how far points in the hull of a piece's cover are outside of it, negative inside; (K, 3) → (K,), [m]."""
    around = 0.0
    match body.kind, body.size:
        case "convex", _:
            return _beyond_faces(body.points, centres)
        case "cylinder", (r, length):
            beyond = np.column_stack((np.hypot(centres[:, 0], centres[:, 1]) - r, np.abs(centres[:, 2]) - length / 2))
        case "box", sizes:
            beyond = np.abs(centres) - np.array(sizes) / 2
        case _, (around, *length_):
            beyond = np.abs(centres) - [0.0, 0.0, sum(length_) / 2]
    return np.asarray(np.minimum(beyond.max(axis=1), 0.0) + np.linalg.norm(np.maximum(beyond, 0.0), axis=1) - around)


def _beyond_faces(points: Array, centres: Array) -> Array:
    """Return the signed distances of points inside of a hull: from the plane of its nearest face.

    Faces may be turned inwards. A plane that is of no face, on either side, is not nearer than the nearest.
    """
    hull = convex_hull(points)
    first, second, third = np.moveaxis(hull.vertices[hull.faces], 1, 0)
    normals = np.cross(second - first, third - first)
    normals = normals[normals.any(axis=1)]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.concatenate((normals, -normals))
    return np.asarray((centres @ normals.T - (points @ normals.T).max(axis=0)).max(axis=1))
