"""Scenes of a request as the core's objects."""

from collections.abc import Iterator

import numpy as np

from gelenk.collision.bodies import Body
from gelenk.collision.scene import Obstacle, half_space, solid
from gelenk.contract.scene import (
    Scene,
    SceneBox,
    SceneCylinder,
    SceneHalfSpace,
    SceneMesh,
    SceneObject,
    ScenePoints,
    SceneSphere,
)
from gelenk.course.orientation.rotations import unit_axis
from gelenk.errors import InvalidField, InvalidPose, counted
from gelenk.robot.arrays import Array
from gelenk.robot.poses import transform

MAX_CLOUD = 10_000
"""Points of a cloud that are looked at one by one."""


def obstacles_of(scene: Scene, root: str) -> tuple[Obstacle, ...]:
    """Return the objects of a scene, those at rest in the frame of the root.

    Raises InvalidPose for an orientation that is none, InvalidField for a normal without direction, a shape from a file
    or a cloud of too many points.
    """
    return tuple(_obstacle(one, f"scene/objects/{i}", root) for i, one in enumerate(scene.objects))


def _obstacle(one: SceneObject, field: str, root: str) -> Obstacle:
    bodies = tuple(_bodies(one, field, one.attached_to or root))
    return Obstacle(one.name, bodies, one.attached_to, frozenset(one.touch_links), one.clearance)


def _bodies(one: SceneObject, field: str, link: str) -> Iterator[Body]:
    T = _pose(one, f"{field}/pose")
    match one.shape:
        case SceneBox(size=[x, y, z]):
            yield solid(one.name, link, "box", (x, y, z), T)
        case SceneSphere(radius=radius):
            yield solid(one.name, link, "sphere", (radius,), T)
        case SceneCylinder(type=kind, radius=radius, length=length):
            yield solid(one.name, link, kind, (radius, length), T)
        case SceneHalfSpace(normal=normal, offset=offset):
            yield half_space(one.name, link, unit_axis(normal, f"{field}/shape/normal"), offset, T)
        case ScenePoints(points=points, radius=radius) if points is not None:
            if len(points) > MAX_CLOUD:
                reason = f"{counted(len(points), 'point')}; at most {MAX_CLOUD} are allowed where contacts are computed"
                raise InvalidField(f"{field}/shape/points", reason)
            for point in np.array(points):
                yield solid(one.name, link, "sphere", (radius,), T @ transform(point, np.eye(3)))
        case SceneMesh() | ScenePoints():
            reason = "contacts with shapes from files are not computed; give boxes, cylinders, capsules or spheres"
            raise InvalidField(f"{field}/shape/file", reason)


def _pose(one: SceneObject, field: str) -> Array:
    if one.pose is None:
        return np.eye(4)
    try:
        return one.pose.transform(np.eye(3))
    except InvalidPose as error:
        raise InvalidPose(error.reason, error.distance, field) from None
