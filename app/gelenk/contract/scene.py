"""Scenes as payloads: what stands around a robot or hangs on it, where contacts are computed."""

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag, model_validator

from gelenk.contract.common import FrameName, OnTheWire, Payload, RobotName, Vectors, optional
from gelenk.contract.pose import Pose, Vector3
from gelenk.errors import quoted

MAX_OBJECTS = 1000
MAX_POINTS = 1_000_000
MIN_SIZE, MAX_SIZE = 1e-4, 1e3
"""Between these a distance is accurate to a micrometre, [m]."""

Extent = Annotated[float, Field(ge=MIN_SIZE, le=MAX_SIZE)]


class SceneBox(Payload):
    """A box about its centre."""

    type: Literal["box"] = Field(description="Which shape it is.")
    size: Annotated[list[Extent], Field(min_length=3, max_length=3)] = Field(description="Along x, y and z, [m].")


class SceneSphere(Payload):
    """A sphere about its centre."""

    type: Literal["sphere"] = Field(description="Which shape it is.")
    radius: Extent = Field(description="Of the sphere, [m].")


class SceneCylinder(Payload):
    """A cylinder or capsule along z about its centre."""

    type: Literal["cylinder", "capsule"] = Field(description="Which shape it is.")
    radius: Extent = Field(description="About z, [m].")
    length: Extent = Field(description="Along z, of a capsule without its two half-spheres, [m].")


class SceneHalfSpace(Payload):
    """All points x with normal · x ≤ offset: a floor, a wall."""

    type: Literal["half_space"] = Field(description="Which shape it is.")
    normal: Vector3 = Field(description="Direction out of it, of any length but 0, no unit.")
    offset: float = Field(default=0.0, ge=-MAX_SIZE, le=MAX_SIZE, description="Of its surface along the normal, [m].")


class SceneMesh(Payload):
    """A mesh, as the convex hulls of its parts."""

    type: Literal["mesh"] = Field(description="Which shape it is.")
    file: Annotated[str, Field(min_length=1, max_length=256)] = Field(description="Name of the file sent with it.")


class ScenePoints(Payload):
    """A cloud of points, each a small sphere."""

    type: Literal["points"] = Field(description="Which shape it is.")
    points: Annotated[
        Vectors, OnTheWire(Annotated[list[Vector3], Field(min_length=1, max_length=MAX_POINTS, fail_fast=True)])
    ] = Field(description="Their positions, [m].")
    radius: Extent = Field(description="Of each, [m].")


Shape: TypeAlias = Annotated[
    SceneBox | SceneSphere | SceneCylinder | SceneHalfSpace | SceneMesh | ScenePoints, Field(discriminator="type")
]


class SceneObject(Payload):
    """An object of a scene, at rest or attached to the robot."""

    name: Annotated[str, Field(min_length=1, max_length=128)] = Field(description="Unique in the scene.")
    shape: Shape = Field(description="Its shape, in its own axes.")
    pose: Pose | None = optional(
        "Of the shape in the robot's root frame, or in the frame it is attached to; that frame itself if left out."
    )
    attached_to: FrameName | None = optional("Frame of the robot with which it moves; it is at rest if left out.")
    touch_links: list[FrameName] = Field(
        default_factory=list,
        max_length=256,
        description="Links that may touch it. The link it is attached to may, and so may links that never move if it "
        "is at rest.",
    )
    clearance: float = Field(
        default=0.0, ge=0.0, le=MAX_SIZE, description="What comes nearer to it than this counts as in contact, [m]."
    )


class Scene(Payload):
    """Objects around a robot."""

    objects: Annotated[list[SceneObject], Field(max_length=MAX_OBJECTS)] = Field(description="The objects.")

    @model_validator(mode="after")
    def _unique_names(self) -> "Scene":
        names = [one.name for one in self.objects]
        for i, name in enumerate(names):
            if (first := names.index(name)) != i:
                raise ValueError(f"`objects`: entries {first} and {i} are both named {quoted(name)}; names are unique")
        return self


class NamedScene(Scene):
    """A scene to store."""

    name: RobotName


def _form(value: Any) -> str:
    return "<name>" if isinstance(value, str) else "<object>"


SceneOrName = Annotated[
    Annotated[RobotName, Tag("<name>")] | Annotated[Scene, Tag("<object>")],
    Discriminator(_form),
    Field(description="What is around the robot: the name of a stored scene, or its objects."),
]
