"""The small GLB file of a robot's mesh: made once, in a process that can be killed, and then read from disk."""

import gzip
import hashlib
from functools import cache
from pathlib import Path

import numpy as np

from gelenk.collision.shapes import meshes as readers
from gelenk.collision.shapes.meshes import MAX_BYTES, read_parts
from gelenk.errors import InvalidMesh
from gelenk.operations.display.colours import colour_of
from gelenk.operations.display.glb import STEPS, Colour, DrawnPart, glb, grid
from gelenk.operations.display.normals import shaded
from gelenk.operations.display.simplify import simplified
from gelenk.robot.arrays import Array, Indices
from gelenk.store import derived
from gelenk.store.records import LoadedRobot, stamp_of

_KEPT = 4000
"""Number of files that stay on disk, the last made ones."""
_TOLERANCE = 1e-3
"""How far a surface may be from that of the file, relative to the longest side of its box."""
_MANY = 50_000
"""Number of triangles above which points are first rounded to a grid as coarse as the tolerance, to save time."""
_MOST_SIMPLIFIED = 200_000
"""Number of triangles above which no more is done than that: it would take longer than a request may."""
_COARSE = 64
"""Steps of the file's grid in one of that grid."""


def stored_file(loaded: LoadedRobot, file: Path) -> Path | None:
    """Return where the small file of a mesh is, or will be, compressed; None where nothing is stored.

    Its name changes with the mesh and with the code that makes it.
    """
    digest = hashlib.sha256(repr((_code(), file.name, stamp_of(file))).encode()).hexdigest()
    return None if loaded.derived is None else loaded.derived / f"{digest}.glb.gz"


def made(loaded: LoadedRobot, file: Path) -> bytes:
    """Return the small file of a mesh, compressed, and store it; empty if only the mesh itself shows what it is."""
    with gzip.open(file) if file.suffix == ".gz" else file.open("rb") as content:
        small = small_mesh(file.name.removesuffix(".gz"), content.read(MAX_BYTES + 1))
    packed = gzip.compress(small, mtime=0) if small else b""
    target = stored_file(loaded, file)
    if target is not None:
        derived.keep(target, packed, "*.glb.gz", _KEPT)
    return packed


def small_mesh(name: str, content: bytes) -> bytes:
    """Return a mesh file as GLB; empty if it is broken, or has more than colours."""
    try:
        parts = [(colour_of(part.effect), part.triangles) for part in read_parts(name, content)]
    except (InvalidMesh, ValueError):  # `NotPlain` too
        return b""
    corner, step = grid(np.concatenate([triangles.reshape(-1, 3) for _, triangles in parts]))
    alike: dict[Colour | None, list[Array]] = {}
    for colour, triangles in parts:
        alike.setdefault(colour, []).append(triangles)
    found = [_part(colour, (np.concatenate(some) - corner) / step) for colour, some in alike.items()]
    shown = [part for part in found if part is not None]
    return glb(shown, corner, step) if shown else b""


def _part(colour: Colour | None, triangles: Array) -> DrawnPart | None:
    """Return what has one colour, from its triangles on the grid, shape (F, 3, 3); None if none has an area there."""
    is_large = len(triangles) > _MANY
    points, corners = _joined(_COARSE * np.rint(triangles / _COARSE) if is_large else triangles)
    if not len(corners):
        return None
    if len(corners) <= _MOST_SIMPLIFIED:
        side = float(np.ptp(points, axis=0).max())
        points, corners = simplified(points, corners, _TOLERANCE * side)
    points, corners = _joined(points[corners])
    if not len(corners):
        return None
    of, normals, corners = shaded(points, corners)
    return DrawnPart(colour, points[of].astype(np.uint16), normals, corners)


def _joined(triangles: Array) -> tuple[Array, Indices]:
    """Return the points of triangles (F, 3, 3) rounded to the grid, each once, and triangles with three of them."""
    rounded = np.rint(triangles.reshape(-1, 3)).clip(0, STEPS).astype(np.int64)
    keys, corners = np.unique(rounded @ np.array([1 << 32, 1 << 16, 1]), return_inverse=True)
    points = np.column_stack([keys >> 32, keys >> 16 & 65535, keys & 65535]).astype(float)
    corners = corners.reshape(-1, 3)
    return points, corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]


@cache
def _code() -> str:
    own, reader = Path(__file__).parent, Path(readers.__file__).parent
    return derived.code_digest([*own.glob("*.py"), *reader.glob("*.py")])
