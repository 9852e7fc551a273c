"""Reads the triangles of a mesh file, which may be hostile: within limits, and without opening any other file.

Call it in a process that can be killed: a reader of files can be made to take long.
"""

import re
from array import array
from collections.abc import Callable

import numpy as np

from gelenk.collision.shapes.collada import fans, read_collada
from gelenk.errors import InvalidMesh, quoted
from gelenk.robot.arrays import Array

MAX_BYTES = 64 * 1024 * 1024
MAX_TRIANGLES = 1_000_000
MAX_EXTENT = 1e6
"""Largest coordinate allowed, [m]."""
_HEADER = 84
"""Length of what stands before the triangles of a binary STL: 80 bytes of anything, and their number."""
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_triangles(name: str, content: bytes) -> Array:
    """Return the corners of a mesh's triangles, shape (F, 3, 3), in its own axes.

    STL (text or binary), OBJ and Collada, by the end of the name. The numbers count as metres; Collada's unit is
    applied, as the studio and RViz do and Pinocchio does not, and its up axis is ignored, as all of them do.

    Raises:
        InvalidMesh: The file is broken, has no triangle, or exceeds a limit of this module.
    """
    if len(content) > MAX_BYTES:
        raise InvalidMesh(f"it has more than {MAX_BYTES} bytes", name)
    kind = name.lower().rpartition(".")[2]
    if kind not in _READERS:
        raise InvalidMesh("its name does not end in one of stl, obj, dae", name)
    try:
        triangles = _READERS[kind](content)
    except MemoryError:
        raise
    except Exception as error:  # A reader of broken files raises anything.
        reason = str(error) if type(error) is ValueError else type(error).__name__
        raise InvalidMesh(f"it cannot be read as {kind.upper()}: {quoted(reason)}", name) from error
    if not len(triangles):
        raise InvalidMesh("it has no triangle", name)
    if not np.abs(triangles).max() <= MAX_EXTENT:
        raise InvalidMesh(f"a coordinate is not a number, or beyond {MAX_EXTENT:g} m", name)
    return triangles


def _stl(content: bytes) -> Array:
    """Return triangles of a binary STL, else of one in words; either may begin with `solid`."""
    count = int.from_bytes(content[80:84], "little")
    if len(content) == _HEADER + count * _FACET.itemsize or not content[:80].lstrip().lower().startswith(b"solid"):
        _check_count(count)
        if len(content) < _HEADER + count * _FACET.itemsize:
            raise ValueError("it ends before its last triangle")
        return np.frombuffer(content, _FACET, count, _HEADER)["corners"].astype(float)
    corners = re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", content, re.IGNORECASE)
    _check_count(len(corners) // 3)
    return np.array(corners).reshape(-1, 3, 3).astype(float)


def _obj(content: bytes) -> Array:
    """Return the triangles of an OBJ; polygons are cut into fans, which stay within their hull."""
    points, corners, counts = array("d"), array("q"), array("q")
    for line in content.replace(b"\\\n", b" ").splitlines():
        match line.split():
            case [b"v", x, y, z, *_]:
                points.extend((float(x), float(y), float(z)))
            case [b"f", *named]:
                given = [int(name.partition(b"/")[0]) for name in named]
                corners.extend(number - 1 if number > 0 else len(points) // 3 + number for number in given)
                counts.append(len(given))
    _check_count(len(corners) - 2 * len(counts))
    numbers = np.array(corners, dtype=np.int64)
    if numbers.size and not 0 <= numbers.min() <= numbers.max() < len(points) // 3:
        raise ValueError("a face has a corner that is not there")
    return np.array(points).reshape(-1, 3)[numbers[fans(np.array(counts, dtype=np.int64))]]


def _check_count(count: int) -> None:
    if count > MAX_TRIANGLES:
        raise ValueError(f"it has more than {MAX_TRIANGLES} triangles")


_READERS: dict[str, Callable[[bytes], Array]] = {
    "stl": _stl,
    "obj": _obj,
    "dae": lambda content: read_collada(content, MAX_TRIANGLES),
}
