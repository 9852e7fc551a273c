"""What is wrong with files of an upload that serves all the same: only contacts need what is in a mesh or an SRDF."""

import time
from collections.abc import Mapping
from pathlib import PurePosixPath

from gelenk.collision.link_pairs import disabled_pairs
from gelenk.collision.shapes.meshes import MAX_BYTES, read_triangles
from gelenk.errors import InvalidMesh, InvalidUrdf
from gelenk.store.folders import Content, pieces
from gelenk.store.meshes import MESH_SUFFIXES

_SECONDS = 3.0
"""After this no further mesh is opened."""
_MOST = 12
"""Meshes that are named; of more only the number is said."""


def findings(meshes: Mapping[str, Content], srdf: bytes | None) -> list[str]:
    """Return a sentence for each broken mesh, and for a broken SRDF."""
    found, end = [], time.monotonic() + _SECONDS
    for path, content in meshes.items():
        if PurePosixPath(path).suffix.lower() not in MESH_SUFFIXES:
            continue
        if time.monotonic() > end:
            found.append("not all meshes were opened, because that takes long")
            break
        try:
            read_triangles(path, _beginning(content))
        except InvalidMesh as error:
            found.append(f"{error}; nothing can be said about contacts")
    if len(found) > _MOST:
        found[_MOST:] = [f"{len(found) - _MOST} more meshes cannot be read"]
    if srdf is not None:
        try:
            disabled_pairs(srdf)
        except InvalidUrdf as error:
            found.append(f"the SRDF is not read: {error}")
    return found


def _beginning(content: Content) -> bytes:
    """Return a content, or so much of it that it is clearly too long."""
    taken = bytearray()
    for piece in pieces(content):
        taken += piece
        if len(taken) > MAX_BYTES:
            break
    return bytes(taken)
