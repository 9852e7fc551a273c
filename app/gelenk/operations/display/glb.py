"""Writes GLB, glTF 2.0 in one file: points as 16-bit numbers, normals as bytes (KHR_mesh_quantization)."""

from collections.abc import Iterable
from dataclasses import dataclass
from struct import pack
from typing import Any

import numpy as np
import orjson

from gelenk.robot.arrays import Array, Indices

_BYTE, _UNSIGNED_SHORT, _UNSIGNED_INT = 5120, 5123, 5125
_VERTICES, _TRIANGLES = 34962, 34963
STEPS = 65535
"""Number of steps of a grid along the longest side of what is on it."""
_SMALLEST = 1e-9
_EXTENSION = ["KHR_mesh_quantization"]


@dataclass(frozen=True, slots=True)
class Colour:
    """How a part looks: linear red, green and blue that it reflects, and that it emits, each from 0 to 1."""

    base: tuple[float, ...]
    emitted: tuple[float, ...] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class DrawnPart:
    """What has one colour, None where the file names none.

    Attributes:
        points: On the grid of the file, shape (V, 3), as unsigned 16-bit numbers.
        normals: One for each point, shape (V, 3), as signed bytes.
        triangles: Numbers of points, shape (F, 3).
    """

    colour: Colour | None
    points: Array
    normals: Array
    triangles: Indices


def grid(points: Array) -> tuple[Array, float]:
    """Return the corner (3,) and the step of the grid that points (N, 3) are rounded to, in their unit."""
    corner = points.min(axis=0)
    side = float(np.ptp(points, axis=0).max())
    return corner, max(side, _SMALLEST) / STEPS


def glb(parts: Iterable[DrawnPart], corner: Array, step: float) -> bytes:
    """Return the file of parts that are on this grid."""
    file = _File()
    primitives = [file.add(part) for part in parts]
    content = {
        "asset": {"version": "2.0", "generator": "Gelenk"},
        "extensionsUsed": _EXTENSION,
        "extensionsRequired": _EXTENSION,
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": corner.tolist(), "scale": [step] * 3}],
        "meshes": [{"primitives": primitives}],
        **({"materials": file.materials} if file.materials else {}),
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{"byteLength": len(file.content)}],
    }
    text = orjson.dumps(content)
    text += b" " * (-len(text) % 4)
    length = 12 + 8 + len(text) + 8 + len(file.content)
    head = pack("<4sII", b"glTF", 2, length) + pack("<I4s", len(text), b"JSON")
    return head + text + pack("<I4s", len(file.content), b"BIN\0") + bytes(file.content)


class _File:
    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self.materials: list[dict[str, Any]] = []

    def add(self, part: DrawnPart) -> dict[str, Any]:
        """Add a part's arrays and colour, and return its primitive."""
        bounds = {"min": part.points.min(axis=0).tolist(), "max": part.points.max(axis=0).tolist()}
        places = self._vertices(np.asarray(part.points, dtype="<u2"), _UNSIGNED_SHORT, bounds)
        normals = self._vertices(np.asarray(part.normals, dtype=np.int8), _BYTE, {"normalized": True})
        few = len(part.points) <= STEPS
        kind, type_ = ("<u2", _UNSIGNED_SHORT) if few else ("<u4", _UNSIGNED_INT)
        self._view(part.triangles.astype(kind).tobytes(), target=_TRIANGLES)
        triangles = self._accessor(type_, part.triangles.size, "SCALAR")
        found: dict[str, Any] = {"attributes": {"POSITION": places, "NORMAL": normals}, "indices": triangles}
        if part.colour is not None:
            reflected = {"baseColorFactor": [*part.colour.base, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.6}
            self.materials.append({"pbrMetallicRoughness": reflected, "emissiveFactor": list(part.colour.emitted)})
            found["material"] = len(self.materials) - 1
        return found

    def _vertices(self, values: Array, type_: int, more: dict[str, Any]) -> int:
        """Add an attribute, each of its rows on a multiple of four bytes."""
        rows = np.zeros((len(values), 4), dtype=values.dtype)
        rows[:, :3] = values
        self._view(rows.tobytes(), target=_VERTICES, byteStride=rows.strides[0])
        return self._accessor(type_, len(values), "VEC3", more)

    def _view(self, content: bytes, **more: int) -> None:
        self.views.append({"buffer": 0, "byteOffset": len(self.content), "byteLength": len(content), **more})
        self.content += content + b"\0" * (-len(content) % 4)

    def _accessor(self, type_: int, count: int, shape: str, more: dict[str, Any] | None = None) -> int:
        view = len(self.views) - 1
        self.accessors.append(
            {"bufferView": view, "componentType": type_, "count": count, "type": shape, **(more or {})}
        )
        return len(self.accessors) - 1
