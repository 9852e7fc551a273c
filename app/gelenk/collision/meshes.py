"""Reads the triangles of a mesh file, which may be hostile: within limits, and without opening any other file.

Call it in a process that can be killed: a reader of files can be made to take long.
"""

from io import BytesIO
from typing import Any
from xml.sax import SAXException
from xml.sax.handler import ContentHandler
from xml.sax.xmlreader import AttributesImpl

import numpy as np
from defusedxml.common import DefusedXmlException
from defusedxml.sax import parseString

from gelenk.errors import InvalidMesh, counted
from gelenk.robot.arrays import Array

MAX_BYTES = 64 * 1024 * 1024
MAX_TRIANGLES = 1_000_000
MAX_EXTENT = 1e6
"""Largest coordinate allowed, [m]."""
_MAX_DEPTH = 64
_MAX_ELEMENTS = 200_000
_LEFT_OUT = frozenset({"instance_node", "instance_controller", "tristrips", "trifans"})
"""Collada's elements that the reader skips in silence: a body without them would have holes."""


def read_triangles(name: str, content: bytes) -> Array:
    """Return the corners of a mesh's triangles, shape (F, 3, 3), in its own axes.

    STL (text or binary), OBJ and Collada, by the end of the name. As in Pinocchio and the studio, the numbers count as
    metres; Collada's unit is applied, its up axis is not.

    Raises:
        InvalidMesh: The file is broken, has no triangle, or exceeds a limit of this module.
    """
    if len(content) > MAX_BYTES:
        raise InvalidMesh(f"it has {counted(len(content), 'byte')}; at most {MAX_BYTES} are allowed", name)
    kind = name.lower().rpartition(".")[2]
    unit = _collada_unit(name, content) if kind == "dae" else 1.0
    triangles = np.concatenate([np.empty((0, 3, 3)), *_read(name, kind, content)]) * unit
    if not len(triangles):
        raise InvalidMesh("it has no triangle", name)
    if not np.abs(triangles).max() <= MAX_EXTENT:
        raise InvalidMesh(f"a coordinate is not a number, or beyond {MAX_EXTENT:g} m", name)
    return triangles


def _read(name: str, kind: str, content: bytes) -> list[Array]:
    """Return the triangles of each part of a file, placed in its scene."""
    import trimesh  # noqa: PLC0415 - only robots with meshes need it

    try:
        scene: Any = trimesh.load_scene(BytesIO(content), file_type=kind, process=False, skip_materials=True)
        parts = [(scene.graph[node][0], scene.geometry[scene.graph[node][1]]) for node in scene.graph.nodes_geometry]
        count = sum(len(getattr(part, "faces", ())) for _, part in parts)
        if count <= MAX_TRIANGLES:
            corners = ((T, part.vertices.view(np.ndarray)[part.faces]) for T, part in parts if hasattr(part, "faces"))
            return [triangles @ T[:3, :3].T + T[:3, 3] for T, triangles in corners]
    except MemoryError:
        raise
    except Exception as error:  # A reader of broken files raises anything.
        raise InvalidMesh(f"it cannot be read as {kind.upper()}: {type(error).__name__}", name) from error
    raise InvalidMesh(f"it has {count} triangles; at most {MAX_TRIANGLES} are allowed", name)


def _collada_unit(name: str, content: bytes) -> float:
    """Return the size of a Collada file's unit, [m]; raises InvalidMesh for what the reader must not meet."""
    seen = _Collada(name)
    try:
        parseString(content, seen, forbid_dtd=True)
    except (SAXException, DefusedXmlException, ValueError, LookupError) as error:
        raise InvalidMesh(f"it is not well-formed XML, or has a DTD: {type(error).__name__}", name) from error
    if not 0.0 < seen.unit < np.inf:
        raise InvalidMesh("its unit is not a positive number", name)
    return seen.unit


class _Collada(ContentHandler):
    """Looks at a Collada file's elements before it is read."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self._name, self._depth, self._count, self.unit = name, 0, 0, 1.0

    def startElement(self, name: str, attrs: AttributesImpl) -> None:
        self._depth, self._count, tag = self._depth + 1, self._count + 1, name.rpartition(":")[2]
        if self._depth > _MAX_DEPTH or self._count > _MAX_ELEMENTS:
            limits = f"deeper than {_MAX_DEPTH}, or more than {_MAX_ELEMENTS}"
            raise InvalidMesh(f"its elements are nested {limits}", self._name)
        if tag in _LEFT_OUT:
            raise InvalidMesh(f"<{tag}> is not read: write its triangles themselves", self._name)
        if tag == "unit":
            self.unit = float(attrs.get("meter", "1"))

    def endElement(self, name: str) -> None:  # noqa: ARG002
        self._depth -= 1
