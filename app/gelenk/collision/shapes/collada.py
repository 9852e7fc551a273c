"""Reads the triangles of a Collada file, all of them: a shape left out would be a contact missed.

The common reader, pycollada, drops a shape whose texture is missing.
"""

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import NamedTuple, TypeAlias
from xml.etree.ElementTree import Element

import numpy as np
from defusedxml.ElementTree import fromstring

from gelenk.errors import counted
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import transform

_MAX_ELEMENTS = 500_000
_MAX_NODES = 10_000
_MAX_DEPTH = 64
_FACES = frozenset({"triangles", "polylist", "polygons", "trifans", "tristrips"})
_Find: TypeAlias = Callable[[str | None], Element]


class MeshPart(NamedTuple):
    """The corners of triangles, shape (F, 3, 3), [m], and the effect that they are shown with, None for none."""

    triangles: Array
    effect: Element | None = None


def read_collada(content: bytes, most: int) -> list[MeshPart]:
    """Return at most so many triangles, in parts that look alike; the up axis is ignored.

    Raises ValueError with a reason, or any other exception where the file contradicts itself.
    """
    if content.count(b"<") > 2 * _MAX_ELEMENTS:
        raise ValueError(f"it has more than {_MAX_ELEMENTS} elements")
    root = fromstring(content, forbid_dtd=True)
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    elements: dict[str | None, Element] = {element.get("id"): element for element in root.iter() if element.get("id")}

    def find(reference: str | None) -> Element:
        return elements[(reference or "").removeprefix("#")]

    shown = root.find("scene/instance_visual_scene")
    if shown is None:
        raise ValueError("it shows no scene")
    given = root.find("asset/unit")
    unit = 1.0 if given is None else float(given.get("meter", "1"))
    if not 0.0 < unit < np.inf:
        raise ValueError("its unit is not a positive number")
    parts: list[MeshPart] = []
    for shape, T in _placed(find(shown.get("url")), find):
        order = -1 if np.linalg.det(T[:3, :3]) < 0.0 else 1  # a mirrored triangle is seen from its other side
        for symbol, corners in _triangles(find(shape.get("url")), find):
            placed = (corners @ T[:3, :3].T + T[:3, 3])[:, ::order] * unit
            parts.append(MeshPart(placed, _effect(shape, symbol, find)))
        if sum(len(part.triangles) for part in parts) > most:
            raise ValueError(f"it has more than {counted(most, 'triangle')}")
    return parts


def _effect(shape: Element, symbol: str | None, find: _Find) -> Element | None:
    """Return the effect that a shown geometry binds to a symbol of its faces; None if the file does not say."""
    for bound in shape.iterfind("bind_material/technique_common/instance_material"):
        if bound.get("symbol") == symbol:
            with suppress(KeyError):
                effect = find(bound.get("target")).find("instance_effect")
                return None if effect is None else find(effect.get("url"))
    return None


def _placed(scene: Element, find: _Find) -> Iterator[tuple[Element, Array]]:
    """Yield the instance of each geometry that a scene shows, with its pose and scale, shape (4, 4)."""
    waiting, visited = [(scene, np.eye(4), 0)], 0
    while waiting:
        node, T, depth = waiting.pop()
        visited += 1
        if depth > _MAX_DEPTH or visited > _MAX_NODES:
            raise ValueError(f"its scene has more than {_MAX_NODES} nodes, or some deeper than {_MAX_DEPTH}")
        for child in node:
            match child.tag:
                case "node":
                    waiting.append((child, T, depth + 1))
                case "instance_node":
                    waiting.append((find(child.get("url")), T, depth + 1))
                case "instance_geometry":
                    yield child, T
                case "instance_controller" | "lookat" | "skew":
                    raise ValueError(f"<{child.tag}> is not read")
                case "matrix" | "translate" | "rotate" | "scale":
                    T = T @ _transform(child)


def _transform(element: Element) -> Array:
    numbers = _floats(element)
    match element.tag:
        case "matrix":
            return numbers.reshape(4, 4)
        case "translate":
            return transform(numbers, np.eye(3))
        case "scale":
            return transform(np.zeros(3), np.diag(numbers))
    axis = numbers[:3] / np.linalg.norm(numbers[:3])
    return transform(np.zeros(3), rotations_from_vectors(np.radians(numbers[3]) * axis[None])[0])


def _triangles(geometry: Element, find: _Find) -> Iterator[tuple[str | None, Array]]:
    """Yield a geometry's triangles, with the symbol of their material."""
    mesh = geometry.find("mesh")
    if mesh is None:
        raise ValueError("a geometry is no mesh")
    for faces in mesh:
        if faces.tag in _FACES:
            yield from ((faces.get("material"), triangles) for triangles in _faces(faces, find))


def _faces(faces: Element, find: _Find) -> Iterator[Array]:
    """Yield the triangles of one kind of faces; polygons are cut into fans, which stay within their hull."""
    if faces.find("ph") is not None:
        raise ValueError("polygons with holes are not read")
    inputs = {given.get("semantic"): given for given in faces.findall("input")}
    vertices = find(inputs["VERTEX"].get("source"))
    (position,) = (given for given in vertices.findall("input") if given.get("semantic") == "POSITION")
    points = _points(find(position.get("source")), find)
    offset = int(inputs["VERTEX"].get("offset", "0"))
    width = 1 + max(int(given.get("offset", "0")) for given in faces.findall("input"))
    corners = [_integers(listed).reshape(-1, width)[:, offset] for listed in faces.findall("p")]
    if any(some.size and some.min() < 0 for some in corners):
        raise ValueError("a corner has a negative number")
    match faces.tag:
        case "triangles":
            yield from (points[some.reshape(-1, 3)] for some in corners)
        case "tristrips":
            yield from (points[np.lib.stride_tricks.sliding_window_view(some, 3)] for some in corners)
        case "polylist":
            counted = faces.find("vcount")
            yield from (points[some[_fans(_integers(counted))]] for some in corners if counted is not None)
        case _:
            yield from (points[some[_fans(np.array([len(some)]))]] for some in corners)


def _points(source: Element, find: _Find) -> Array:
    """Return the points of a source, shape (N, 3)."""
    accessor = source.find("technique_common/accessor")
    if accessor is None:
        raise ValueError("a source has no accessor")
    numbers = _floats(find(accessor.get("source")))[int(accessor.get("offset", "0")) :]
    stride = int(accessor.get("stride", "1"))
    points: Array = numbers[: len(numbers) // stride * stride].reshape(-1, stride)[:, :3]
    return points


def _fans(counts: Indices) -> Indices:
    """Return indices of the corners of triangles that make up polygons of so many corners each; shape (F, 3)."""
    triangles = np.maximum(counts - 2, 0)
    first = np.repeat(np.cumsum(counts) - counts, triangles)
    step = np.arange(len(first)) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.column_stack((first, first + step + 1, first + step + 2))


def _floats(element: Element) -> Array:
    return np.array((element.text or "").split(), dtype=float)


def _integers(element: Element) -> Indices:
    return np.array((element.text or "").split(), dtype=np.int64)
