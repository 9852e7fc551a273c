"""Scenes as payloads: what stands around a robot or hangs on it, where contacts are computed."""

from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from pydantic import Discriminator, Field, Tag, ValidationInfo, field_validator, model_validator

from gelenk.contract.common import Answer, FrameName, OnTheWire, Payload, Vectors, optional
from gelenk.contract.pose import Pose, Vector3
from gelenk.errors import InvalidField, InvalidPose, quoted
from gelenk.robot.arrays import Array

MAX_OBJECTS = 1000
MAX_POINTS = 1_000_000
MIN_SIZE, MAX_SIZE = 1e-4, 1e3
"""Between these a distance is accurate to a micrometre, [m]."""
MAX_FILES = 100
"""Files of one scene."""

Extent = Annotated[float, Field(ge=MIN_SIZE, le=MAX_SIZE)]
Height = Annotated[float, Field(ge=-MAX_SIZE, le=MAX_SIZE)]
SceneName = Annotated[
    str,
    Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$",
        description="1 to 64 letters, digits, `_`, `.` or `-`, the first one a letter or digit.",
        examples=["my_cell"],
    ),
]
MeshName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,99}\.([Ss][Tt][Ll]|[Oo][Bb][Jj]|[Dd][Aa][Ee])$")]
ArrayName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,99}\.npy$")]


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
    """A mesh, as convex hulls of the at most 16 parts that it is cut into."""

    type: Literal["mesh"] = Field(description="Which shape it is.")
    file: MeshName = Field(description="Name of the STL, OBJ or DAE file that is stored with the scene.")


class ScenePoints(Payload):
    """A cloud of points, each a small sphere; more than 10,000 are grouped into boxes around them."""

    type: Literal["points"] = Field(description="Which shape it is.")
    points: (
        Annotated[
            Vectors, OnTheWire(Annotated[list[Vector3], Field(min_length=1, max_length=MAX_POINTS, fail_fast=True)])
        ]
        | None
    ) = optional("Their positions, [m].")
    file: ArrayName | None = optional("Name of the npy file of shape (N, 3) with them, stored with the scene.")
    radius: Extent = Field(description="Of each, [m].")

    @model_validator(mode="after")
    def _one_source(self) -> "ScenePoints":
        if (self.points is None) == (self.file is None):
            raise ValueError("give exactly one of `points` and `file`")
        return self


class SceneHeightMap(Payload):
    """Terrain: solid from a base up to heights at the corners of a grid about z; it counts as at most 2,000 boxes."""

    type: Literal["height_map"] = Field(description="Which shape it is.")
    heights: Annotated[
        Vectors,
        OnTheWire(
            Annotated[
                list[Annotated[list[Height], Field(min_length=2, max_length=1000, fail_fast=True)]],
                Field(min_length=2, max_length=1000, fail_fast=True),
            ]
        ),
    ] = Field(description="Rows from the least y to the largest, each from the least x to the largest, [m].")
    size: Annotated[list[Extent], Field(min_length=2, max_length=2)] = Field(description="Along x and y, [m].")
    base: Height | None = optional("Down to where it is solid, [m]; to its lowest height if left out.")

    @model_validator(mode="after")
    def _one_length(self) -> "SceneHeightMap":
        for i, row in enumerate(self.heights):
            if len(row) != len(self.heights[0]):
                raise ValueError(f"`heights`: rows 0 and {i} have {len(self.heights[0])} and {len(row)} numbers")
        return self


Shape: TypeAlias = Annotated[
    SceneBox | SceneSphere | SceneCylinder | SceneHalfSpace | SceneMesh | ScenePoints | SceneHeightMap,
    Field(discriminator="type"),
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
        description="Links that may touch it. Those that the chain does not move relative to it may in any case.",
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

    def transforms(self) -> Array:
        """Return the pose T_frame_shape of each object; shape (N, 4, 4).

        Raises InvalidPose, with the object's place, if an orientation is no rotation; a position alone turns nothing.
        """
        poses = np.broadcast_to(np.eye(4), (len(self.objects), 4, 4)).copy()
        for i, one in enumerate(self.objects):
            if one.pose is not None:
                try:
                    poses[i] = one.pose.transform(np.eye(3))
                except InvalidPose as error:
                    raise InvalidPose(error.reason, error.distance, f"objects.{i}.pose") from None
        return poses

    @property
    def files(self) -> tuple[str, ...]:
        """Names of the files that its objects are read from."""
        named = (getattr(one.shape, "file", None) for one in self.objects)
        return tuple(dict.fromkeys(file for file in named if file is not None))

    @property
    def identity(self) -> str:
        """What scenes with the same objects and files have in common, and others do not."""
        return self.model_dump_json()

    def read(self, file: str) -> bytes:
        """Return the content of one of `files`; raises InvalidField, because only stored scenes have files."""
        raise InvalidField("scene", f"{quoted(file)} is not here: store the scene with its files, and name it instead")


class NamedScene(Scene):
    """A scene to store."""

    name: SceneName


class SceneForm(Payload):
    """The text field sent with the files of a scene."""

    scene: str = Field(description="The scene as JSON, as in the other form of the body.")


class SceneSummary(Answer):
    """A stored scene in the list."""

    name: str = Field(description="Name by which calls refer to it.")
    objects: int = Field(description="How many it has.")
    size: int = Field(description="Of the scene with its files, [bytes].")


class SceneList(Answer):
    """All stored scenes, by name."""

    scenes: list[SceneSummary]


class SceneFile(Answer):
    """A file of a stored scene."""

    name: str = Field(description="As the objects refer to it.")
    size: int = Field(description="Of the file, [bytes].")


class SceneInfo(Answer):
    """A stored scene."""

    name: str = Field(description="Name by which calls refer to it.")
    objects: list[SceneObject] = Field(description="As they were sent.")
    files: list[SceneFile] = Field(description="Meshes and point clouds, whose content was sent with it.")


EXAMPLE_SCENE: dict[str, Any] = {
    "name": "my_cell",
    "objects": [
        {
            "name": "table",
            "shape": {"type": "box", "size": [0.8, 1.2, 0.04]},
            "pose": {"position": [0.5, 0.0, -0.02]},
        },
        {"name": "wall", "shape": {"type": "half_space", "normal": [1.0, 0.0, 0.0], "offset": -0.4}},
    ],
}


def _form(value: Any) -> str:
    return "<name>" if isinstance(value, str) else "<object>"


SceneOrName = Annotated[
    Annotated[SceneName, Tag("<name>")] | Annotated[Scene, Tag("<object>")],
    Discriminator(_form),
    Field(description="What is around the robot: the name of a stored scene, or its objects."),
]

OtherJoints = Annotated[
    Annotated[dict[str, float], Field(max_length=128)] | None,
    Field(
        description="Where joints stand that the chain does not move, such as a gripper's, by name, [rad or m]; those "
        "left out at 0."
    ),
]
"""Positions of joints off the chain, as far as contacts depend on them."""


class InCell(Payload):
    """Asks that the robot stay clear of itself and of what is around it."""

    scene: SceneOrName | None = optional(
        "What the robot must not touch, beside itself: objects, or the name of a stored scene. If left out, and "
        "`min_clearance` too, contacts are not looked at."
    )
    min_clearance: float | None = optional(
        "Two that are at most this far apart count as in contact, [m]; it adds to what an object of the scene demands. "
        "0 if left out.",
        ge=0.0,
        le=MAX_SIZE,
    )
    other_joints: OtherJoints = None

    @field_validator("other_joints")
    @classmethod
    def _among_contacts(cls, value: dict[str, float] | None, info: ValidationInfo) -> dict[str, float] | None:
        if value is not None and all(info.data.get(name) is None for name in ("scene", "min_clearance")):
            raise ValueError("is about contacts, which count with a `scene` or a `min_clearance` only")
        return value
