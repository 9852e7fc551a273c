"""What of a robot can touch anything: the convex pieces of its links, and which pairs of links are looked at."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import TypeAlias

import numpy as np

from gelenk.collision.bodies import Body, PieceKind
from gelenk.collision.link_pairs import find_pairs
from gelenk.collision.pairs import LinkPair
from gelenk.collision.shapes.cover_excess import excess_of_cover, protrusion
from gelenk.collision.shapes.covers import NO_POINTS, covered_body
from gelenk.collision.shapes.meshes import read_triangles
from gelenk.collision.shapes.pieces import pieces_of
from gelenk.errors import listed, meshes_are
from gelenk.robot.arrays import Array
from gelenk.robot.description import Description, Link, Shape
from gelenk.robot.notations import placement

_Pieces: TypeAlias = Callable[[str], list[tuple[Array, float]] | None]
MeshReader: TypeAlias = Callable[[str], bytes | None]
"""Returns the content of a mesh that a description names; None if the file is missing."""


@dataclass(frozen=True, slots=True)
class RobotBodies:
    """Bodies of a robot's links, in the order of the description.

    Attributes:
        bodies: The convex pieces.
        pairs: Each pair of links that have bodies, active or not.
        warnings: Why some links have no body, or one that was not meant for this; one sentence each.
    """

    bodies: tuple[Body, ...]
    pairs: tuple[LinkPair, ...]
    warnings: tuple[str, ...]


def find_bodies(
    description: Description, read_mesh: MeshReader, disabled: Sequence[tuple[str, str]] = (), has_own: bool = True
) -> RobotBodies:
    """Find the bodies of all links, and the pairs of links that can touch.

    Args:
        description: The robot.
        read_mesh: Reads its mesh files.
        disabled: Pairs that an SRDF tells not to look at.
        has_own: Whether links without collision shapes deserve a warning that their visuals are taken.

    Raises:
        InvalidMesh: A mesh file cannot be read.
    """
    pieces = cache(lambda mesh: _mesh_pieces(mesh, read_mesh(mesh)))
    shapes = {link.name: _shapes(link, pieces) for link in description.links}
    bodies = tuple(body for link, some in shapes.items() for body in _bodies(link, some, pieces))
    warnings = list(_about_visuals([link for link in description.links if shapes[link.name]], shapes, has_own))
    named = {shape.mesh for some in shapes.values() for shape in some if shape.mesh is not None}
    missing = tuple(sorted(mesh for mesh in named if pieces(mesh) is None))
    if missing:
        warnings.append(f"without a body: {meshes_are(missing)} missing")
    if not bodies:
        warnings.append("no link has a body: nothing of this robot can touch anything")
    return RobotBodies(bodies, find_pairs(description, bodies, disabled), tuple(warnings))


def _shapes(link: Link, pieces_of: _Pieces) -> list[Shape]:
    """Return the shapes meant for contacts, or else those that are shown; rather ones of which no mesh is missing."""
    meant, shown = ([shape for shape in link.shapes if shape.role == role] for role in ("collision", "visual"))
    some = [shapes for shapes in (meant, shown) if shapes]
    whole = (shapes for shapes in some if all(one.mesh is None or pieces_of(one.mesh) is not None for one in shapes))
    return next(whole, some[0] if some else [])


def _about_visuals(links: Sequence[Link], shapes: dict[str, list[Shape]], has_own: bool) -> Iterator[str]:
    """Yield why the visual shapes of some links are taken."""
    visual = [link for link in links if shapes[link.name][0].role == "visual"]
    replaced = tuple(link.name for link in visual if any(shape.role == "collision" for shape in link.shapes))
    others = tuple(link.name for link in visual if link.name not in replaced)
    if others and has_own:
        yield f"no collision shapes: the visual ones are the bodies of {listed(others)}"
    if replaced:
        yield f"collision meshes are missing: the visual shapes are the bodies of {listed(replaced)}"


def _mesh_pieces(mesh: str, content: bytes | None) -> list[tuple[Array, float]] | None:
    return None if content is None else pieces_of(read_triangles(mesh, content))


def _bodies(link: str, shapes: Sequence[Shape], pieces_of: _Pieces) -> Iterator[Body]:
    placed = [piece for shape in shapes for piece in _placed(shape, pieces_of)]
    for number, (kind, size, points, excess, T) in enumerate(placed, 1):
        name = f"{link} {number}" if len(placed) > 1 else link
        body = covered_body(name, link, kind, size, T, points, excess)
        yield replace(body, cover_excess=excess_of_cover(body), protrusion=protrusion(body))


def _placed(shape: Shape, pieces_of: _Pieces) -> Iterator[tuple[PieceKind, tuple[float, ...], Array, float, Array]]:
    """Yield kind, size, points, excess and pose of each convex piece of a shape."""
    T = placement(shape.origin.xyz, shape.origin.rpy)
    if shape.kind != "mesh":
        yield shape.kind, shape.size, NO_POINTS, 0.0, T
        return
    for points, excess in pieces_of(shape.mesh or "") or []:
        yield "convex", (), points * np.array(shape.size), excess, T
