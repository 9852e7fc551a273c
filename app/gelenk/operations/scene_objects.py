"""Scenes of a request as the core's objects."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from io import BytesIO

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.scene import Obstacle, half_space
from gelenk.collision.shapes.clouds import cloud_bodies
from gelenk.collision.shapes.covers import covered_body
from gelenk.collision.shapes.height_maps import height_map_bodies
from gelenk.collision.shapes.meshes import read_triangles
from gelenk.collision.shapes.pieces import pieces_of
from gelenk.contract.scene import (
    Scene,
    SceneBox,
    SceneCylinder,
    SceneHalfSpace,
    SceneHeightMap,
    SceneMesh,
    SceneObject,
    ScenePoints,
    SceneSphere,
)
from gelenk.course.orientation.rotations import unit_axis
from gelenk.errors import InvalidField, InvalidPose, counted, quoted
from gelenk.robot.arrays import Array

MAX_PIECES = 20_000
"""Convex pieces of all objects of a scene."""
_TIGHT = 0.01
"""A hull whose excess is at most this deserves no note."""


@dataclass(frozen=True, slots=True)
class _Content:
    """A scene, which equals those of the same content."""

    identity: str
    scene: Scene = field(compare=False)


def obstacles_of(scene: Scene | str | None, root: str) -> tuple[Obstacle, ...]:
    """Return the objects of a scene, those at rest in the frame of the root; the same ones for the same content.

    Raises InvalidPose for an orientation that is none; InvalidMesh; InvalidField for a normal without direction, a
    file that is not stored with the scene, too many pieces, or a name, for which whoever calls gets the scene.
    """
    if scene is None:
        return ()
    if isinstance(scene, str):
        raise InvalidField("scene", f"the scene {quoted(scene)} is not here: give its objects")
    return _obstacles(_Content(scene.identity, scene), root)


@lru_cache(32)
def _obstacles(content: _Content, root: str) -> tuple[Obstacle, ...]:
    found: list[Obstacle] = []
    pieces = 0
    for i, one in enumerate(content.scene.objects):
        bodies, note = _bodies(one, f"scene/objects/{i}", one.attached_to or root, content.scene)
        found.append(Obstacle(one.name, bodies, one.attached_to, frozenset(one.touch_links), one.clearance, note))
        pieces += len(bodies)
        if pieces > MAX_PIECES:
            reason = f"with it the scene has {counted(pieces, 'convex piece')}; at most {MAX_PIECES} are allowed"
            raise InvalidField(f"scene/objects/{i}/shape", reason)
    return tuple(found)


def _bodies(one: SceneObject, place: str, link: str, scene: Scene) -> tuple[tuple[Body, ...], str | None]:
    """Return the pieces of an object, and a note if they are larger than it is."""
    name, T = one.name, _pose(one, f"{place}/pose")
    match one.shape:
        case SceneBox(size=[x, y, z]):
            return (covered_body(name, link, "box", (x, y, z), T),), None
        case SceneSphere(radius=radius):
            return (covered_body(name, link, "sphere", (radius,), T),), None
        case SceneCylinder(type=kind, radius=radius, length=length):
            return (covered_body(name, link, kind, (radius, length), T),), None
        case SceneHalfSpace(normal=normal, offset=offset):
            return (half_space(name, link, unit_axis(normal, f"{place}/shape/normal"), offset, T),), None
        case SceneMesh(file=file):
            hulls = pieces_of(read_triangles(file, scene.read(file)))
            names = [f"{name} {i + 1}" for i in range(len(hulls))] if len(hulls) > 1 else [name]
            bodies = (covered_body(own, link, "convex", (), T, *hull) for own, hull in zip(names, hulls, strict=True))
            return tuple(bodies), _about_hulls(name, [excess for _, excess in hulls])
        case ScenePoints(radius=radius) as cloud:
            points = _points(cloud, scene)
            some, excess = cloud_bodies(name, link, points, radius, T)
            return tuple(some), _about_boxes(name, len(points), excess)
        case SceneHeightMap(heights=rows, size=[x, y], base=base):
            heights = np.array(rows, dtype=float)
            low = heights.min() if base is None else base
            some, excess = height_map_bodies(name, link, heights, (x, y), float(low), T)
            return tuple(some), _about_terrain(name, excess)
    raise TypeError(type(one.shape))


def _points(cloud: ScenePoints, scene: Scene) -> Array:
    """Return the points of a cloud, shape (N, 3); its file has been checked before it was stored."""
    points = cloud.points if cloud.file is None else np.load(BytesIO(scene.read(cloud.file)), allow_pickle=False)
    return np.asarray(points, dtype=float)


def _about_hulls(name: str, excesses: Sequence[float]) -> str | None:
    if all(excess <= _TIGHT for excess in excesses):
        return None
    counts = f"{quoted(name)} counts as {counted(len(excesses), 'convex hull')} around what it is made of"
    if any(map(math.isnan, excesses)):
        return f"{counts}; its surface is not closed, so nothing is known of their excess"
    return f"{counts}, with at most {max(excesses):.0%} more volume than a connected part has"


def _about_boxes(name: str, points: int, excess: float) -> str | None:
    if not excess:
        return None
    counts = f"{quoted(name)} counts as boxes around its {counted(points, 'point')}"
    return f"{counts}; they reach at most {excess:.3g} m beyond the points' spheres"


def _about_terrain(name: str, excess: float) -> str | None:
    return f"{quoted(name)} counts as boxes that reach at most {excess:.3g} m above its surface" if excess else None


def _pose(one: SceneObject, place: str) -> Array:
    if one.pose is None:
        return np.eye(4)
    try:
        return one.pose.transform(np.eye(3))
    except InvalidPose as error:
        raise InvalidPose(error.reason, error.distance, place) from None
