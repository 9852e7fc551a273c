"""Reads MSH, the binary mesh format of MuJoCo: four counts, then vertices, normals, texture coordinates and faces."""

import numpy as np

from gelenk.collision.shapes.hulls import hull_triangles
from gelenk.errors import counted
from gelenk.robot.arrays import Array

_COUNTS = 4
_LEAST_VERTICES = 4


def read_msh(content: bytes, max_triangles: int) -> Array:
    """Return the corners of the triangles, shape (F, 3, 3); without faces, those of the hull of the vertices.

    All numbers take four bytes, the least first: int32 counts and faces, float32 coordinates.

    Raises:
        ValueError: The counts do not fit each other or the content, a face has no such vertex, there are more
            triangles than allowed, or the vertices of a file without faces are flat.
    """
    if len(content) < 4 * _COUNTS:
        raise ValueError("it ends within its four counts")
    vertices, normals, texcoords, faces = np.frombuffer(content, "<i4", _COUNTS).tolist()
    if vertices < _LEAST_VERTICES or faces < 0 or not {normals, texcoords} <= {0, vertices}:
        raise ValueError(
            f"its counts are {vertices}, {normals}, {texcoords}, {faces}, but must be of at least {_LEAST_VERTICES} "
            "vertices, as many normals and texture coordinates or none, and faces"
        )
    if (faces or 2 * vertices) > max_triangles:
        raise ValueError(f"it has more than {counted(max_triangles, 'triangle')}")
    skipped = 4 * (3 * vertices + 3 * normals + 2 * texcoords)
    if len(content) != (size := 4 * _COUNTS + skipped + 12 * faces):
        raise ValueError(f"it has {len(content)} bytes, but its counts make {size}")
    points = np.frombuffer(content, "<f4", 3 * vertices, 4 * _COUNTS).reshape(-1, 3).astype(float)
    if not np.isfinite(points).all():
        raise ValueError("a coordinate is not finite")
    corners = np.frombuffer(content, "<i4", 3 * faces, 4 * _COUNTS + skipped).reshape(-1, 3)
    if not faces:
        return hull_triangles(points)
    if not 0 <= corners.min() <= corners.max() < vertices:
        raise ValueError(f"a face has a vertex beyond its {vertices}")
    return np.asarray(points[corners])
