"""Reads the triangles of a mesh file, which may be hostile: within limits, and without opening any other file.

Call it in a process that can be killed: a reader of files can be made to take long.
"""

from io import BytesIO
from typing import Any

import numpy as np

from gelenk.collision.shapes.collada import MeshPart, read_collada
from gelenk.collision.shapes.msh import read_msh
from gelenk.errors import InvalidMesh, quoted
from gelenk.robot.arrays import Array

MAX_BYTES = 64 * 1024 * 1024
MAX_TRIANGLES = 1_000_000
MAX_EXTENT = 1e6
"""Largest coordinate allowed, [m]."""


def read_triangles(name: str, content: bytes) -> Array:
    """Return the corners of a mesh's triangles, shape (F, 3, 3), in its own axes; limits and errors of `read_parts`."""
    return np.concatenate([part.triangles for part in read_parts(name, content)])


def read_parts(name: str, content: bytes) -> list[MeshPart]:
    """Return a mesh's triangles in its own axes, in parts that look alike.

    STL (text or binary), OBJ, Collada and MuJoCo's MSH, by the end of the name. The numbers count as metres;
    Collada's unit is applied, as the studio and RViz do and Pinocchio does not, and its up axis is ignored, as all of
    them do.

    Raises:
        InvalidMesh: The file is broken, has no triangle, or exceeds a limit of this module.
    """
    if len(content) > MAX_BYTES:
        raise InvalidMesh(f"it has more than {MAX_BYTES} bytes", name)
    kind = name.lower().rpartition(".")[2]
    try:
        parts = read_collada(content, MAX_TRIANGLES) if kind == "dae" else [MeshPart(_read(kind, content))]
    except MemoryError:
        raise
    except Exception as error:  # A reader of broken files raises anything.
        reason = str(error) if type(error) is ValueError else type(error).__name__
        raise InvalidMesh(f"it cannot be read as {kind.upper()}: {quoted(reason)}", name) from error
    parts = [part for part in parts if len(part.triangles)]
    if not parts:
        raise InvalidMesh("it has no triangle", name)
    if not all(np.abs(part.triangles).max() <= MAX_EXTENT for part in parts):
        raise InvalidMesh(f"a coordinate is not a number, or beyond {MAX_EXTENT:g} m", name)
    return parts


def _read(kind: str, content: bytes) -> Array:
    if kind == "msh":
        return read_msh(content, MAX_TRIANGLES)
    import trimesh  # noqa: PLC0415 - only robots with meshes need it

    mesh: Any = trimesh.load_mesh(BytesIO(content), file_type=kind, process=False, skip_materials=True)
    if len(mesh.faces) > MAX_TRIANGLES:
        raise ValueError(f"it has more than {MAX_TRIANGLES} triangles")
    return np.asarray(mesh.vertices.view(np.ndarray)[mesh.faces], dtype=float)
