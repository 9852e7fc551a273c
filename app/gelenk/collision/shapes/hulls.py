"""Convex hulls of points; with few vertices, and then around the hull."""

from dataclasses import dataclass

import numpy as np

from gelenk.collision.shapes.quickhull import quickhull
from gelenk.collision.shapes.surfaces import distinct, used, volume_within
from gelenk.robot.arrays import Array, Indices

MAX_VERTICES = 128
_THINNEST = 1e-6
"""Least thickness of a hull, relative to its size: flatter ones are thickened, because no hull of them is found."""
_SHORTEST = 1e-9
"""Least size of a hull's box, [m]."""
_FACES = MAX_VERTICES // 2 + 2
"""Of a simplified hull: F faces meet in at most 2 F - 4 vertices."""
_FACES_A_ROUND = 16
_SLIVER = 1e-8
"""Area of a face, relative to the size, below which its direction is left to chance."""


@dataclass(frozen=True, slots=True)
class Hull:
    """A convex hull: vertices, shape (V, 3), indices of its triangles' corners, (F, 3), and volume, [m³]."""

    vertices: Array
    faces: Indices
    volume: float


def convex_hull(points: Array) -> Hull:
    """Return the hull of points, shape (N, 3); a flat one is thickened.

    Quickhull takes no flat points. Hence it gets them scaled along their principal axes to a size of one, which
    changes nothing of what is a vertex.
    """
    centre, axes, sizes = _box(points)
    scaled = (points - centre) @ axes / sizes
    for axis in np.flatnonzero(np.ptp(scaled, axis=0) < 0.5):
        step = np.eye(3)[axis] / 2
        scaled = np.concatenate((scaled - step, scaled + step))
    hull = used(scaled, quickhull(scaled))
    return Hull(hull.points * sizes @ axes.T + centre, hull.faces, volume_within(hull) * float(np.prod(sizes)))


def hull_triangles(points: Array) -> Array:
    """Return the triangles of the hull of points, shapes (…, 3) and (F, 3, 3), seen from outside.

    Raises:
        ValueError: They are flat.
    """
    points, _ = distinct(points.reshape(-1, 3))
    sizes = _box(points)[2]
    if sizes.min() <= max(_THINNEST * sizes.max(), _SHORTEST):
        raise ValueError("it is flat: its hull has no volume")
    return np.asarray(points[quickhull(points)])


def few_vertices(hull: Hull) -> Hull:
    """Return a hull around another, of at most `MAX_VERTICES`."""
    return hull if len(hull.vertices) <= MAX_VERTICES else convex_hull(_around(hull))


def _box(points: Array) -> tuple[Array, Array, Array]:
    """Return the centre, (3,), and the principal axes, columns, of points, and their sizes along these, not zero."""
    mean = points.mean(axis=0)
    axes = np.linalg.eigh((points - mean).T @ (points - mean))[1]
    along = (points - mean) @ axes
    least, most = along.min(axis=0), along.max(axis=0)
    sizes = most - least
    return axes @ (least + most) / 2 + mean, axes, np.maximum(sizes, max(_THINNEST * sizes.max(), _SHORTEST))


def _around(hull: Hull) -> Array:
    """Return the vertices of a polytope around a hull that has few of its faces, besides those of its box.

    Those are added of which the polytope's vertices are farthest. The plane of a face, a·x = 1, is a point a of the
    dual, and the dual's faces are the vertices.
    """
    mean = hull.vertices.mean(axis=0)
    _, axes, sizes = _box(hull.vertices)
    scaled = (hull.vertices - mean) @ axes / sizes
    first, second, third = np.moveaxis(scaled[hull.faces], 1, 0)
    normals = np.cross(second - first, third - first)
    is_plain = np.linalg.norm(normals, axis=1) > _SLIVER
    faces = normals[is_plain] / (normals * first)[is_plain].sum(axis=1, keepdims=True)
    box = np.concatenate((np.eye(3), -np.eye(3)))
    planes = np.concatenate((_touching(box, scaled), faces))
    chosen = np.arange(len(box))
    vertices = _dual_vertices(planes[chosen])
    while len(chosen) < _FACES:
        beyond = (vertices @ planes.T - 1.0) / np.linalg.norm(planes / sizes, axis=1)
        worst = beyond.argmax(axis=1)[np.argsort(-beyond.max(axis=1))]
        new = list(dict.fromkeys(worst.tolist()))[: min(_FACES_A_ROUND, _FACES - len(chosen))]
        planes[new] = _touching(planes[new], scaled)
        chosen = np.append(chosen, new)
        vertices = _dual_vertices(planes[chosen])
    return np.asarray(vertices * sizes @ axes.T + mean)


def _touching(planes: Array, points: Array) -> Array:
    """Return parallels to planes that have no point beyond them."""
    return np.asarray(planes / ((planes @ points.T).max(axis=1)[:, None] * (1.0 + 1e-9)))


def _dual_vertices(planes: Array) -> Array:
    corners = planes[quickhull(planes)]
    return np.asarray(np.linalg.solve(corners, np.ones((len(corners), 3, 1)))[:, :, 0])
