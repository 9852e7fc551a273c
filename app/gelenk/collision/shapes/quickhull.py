"""Quickhull (Barber, Dobkin and Huhdanpaa, 1996), called in its own library, which comes with Coal.

Coal's way there crashes wherever Quickhull has a warning to print, as about edges cut into many pieces, and refuses
vertices of many edges.
"""

import ctypes
import importlib.metadata
import os
from ctypes import POINTER, byref, c_char_p, c_int, c_size_t, c_uint, c_void_p
from functools import cache
from pathlib import Path

import numpy as np

from gelenk.robot.arrays import Array, Indices

_STATE = 1 << 16
"""Bytes for the library's state; it takes some eight thousand."""
_OPTIONS = b"qhull Qt i", b"qhull QJ i"
"""Triangles, and the numbers of their corners as text; without merging of faces, of points moved by 1e-11 of them."""


def quickhull(points: Array) -> Indices:
    """Return the triangles of the hull of points, (N, 3), as the numbers of their corners, (F, 3), outside seen alike.

    The points must not be flat; those so near to the hull that rounding cannot tell count as inside.

    Raises:
        ValueError: There is no hull, because they are flat.
    """
    points = np.ascontiguousarray(points, dtype=float)
    for options in _OPTIONS:
        text = _text(points, options)
        if text is not None:
            return np.array(text.split()[1:], dtype=np.int64).reshape(-1, 3)
    raise ValueError("the points are flat")


def _text(points: Array, options: bytes) -> bytes | None:
    """Return what Quickhull writes about points, None if it fails; its warnings go nowhere."""
    qhull, libc = _qhull(), _libc()
    state, written, length = ctypes.create_string_buffer(_STATE), c_void_p(), c_size_t()
    output, nowhere = libc.open_memstream(byref(written), byref(length)), libc.fopen(os.fsencode(os.devnull), b"w")
    qhull.qh_zero(state, nowhere)
    failed = qhull.qh_new_qhull(state, 3, len(points), points.ctypes.data, 0, options, output, nowhere)
    qhull.qh_freeqhull(state, 0)
    qhull.qh_memfreeshort(state, byref(c_int()), byref(c_int()))
    libc.fclose(output)
    libc.fclose(nowhere)
    content = ctypes.string_at(written, length.value)
    libc.free(written)
    return None if failed else content


@cache
def _qhull() -> ctypes.CDLL:
    folder = Path(str(importlib.metadata.distribution("cmeel-qhull").locate_file("cmeel.prefix/lib")))
    library = ctypes.CDLL(str(next(path for path in sorted(folder.glob("libqhull_r*")) if path.suffix != ".a")))
    library.qh_zero.argtypes = c_char_p, c_void_p
    library.qh_new_qhull.argtypes = c_char_p, c_int, c_int, c_void_p, c_uint, c_char_p, c_void_p, c_void_p
    library.qh_freeqhull.argtypes = c_char_p, c_uint
    library.qh_memfreeshort.argtypes = c_char_p, POINTER(c_int), POINTER(c_int)
    return library


@cache
def _libc() -> ctypes.CDLL:
    library = ctypes.CDLL(None)
    library.fopen.restype = library.open_memstream.restype = c_void_p
    library.open_memstream.argtypes = c_void_p, c_void_p
    library.fclose.argtypes = library.free.argtypes = (c_void_p,)
    return library
