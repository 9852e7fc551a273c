"""Robots as listed, described and uploaded."""

from typing import Annotated, Any, Literal

from pydantic import Field, Json, model_validator

from gelenk.contract.common import Answer, ChainEnds, FrameName, Payload, RobotName, Strict, optional
from gelenk.contract.dh import DhTablePayload
from gelenk.contract.pose import Pose
from gelenk.contract.robot_file import Controller, Text
from gelenk.contract.screws import ScrewsPayload


class BoxShape(Answer):
    """A box about its centre."""

    type: Literal["box"] = Field(default="box", description="Which shape it is.")
    size: list[float] = Field(description="Along x, y and z, [m].")


class CylinderShape(Answer):
    """A cylinder along z about its centre."""

    type: Literal["cylinder"] = Field(default="cylinder", description="Which shape it is.")
    radius: float = Field(description="Of the cylinder, [m].")
    length: float = Field(description="Along z, [m].")


class LinkShape(Answer):
    """A shape to draw for a link without a visual."""

    link: str = Field(description="The link it belongs to.")
    shape: BoxShape | CylinderShape = Field(discriminator="type", description="The shape, in its own axes.")
    pose: Pose = Field(description="Of the shape's centre in the link.")


Arguments = Annotated[
    dict[Annotated[str, Field(max_length=128)], bool | int | float | Annotated[str, Field(max_length=1000)]],
    Field(max_length=100),
]
"""Values of a xacro's arguments, by name."""


def as_text(arguments: Arguments | None) -> dict[str, str]:
    """Return the arguments as xacro takes them: `true` for true, 7 for 7."""
    given = (arguments or {}).items()
    return {name: str(value).lower() if isinstance(value, bool) else str(value) for name, value in given}


class RobotReplacement(Payload):
    """A robot as URDF text, as a DH table or as a product of exponentials: exactly one of them."""

    urdf: str | None = optional("A URDF as text; or a xacro or MJCF that includes no file.")
    arguments: Arguments | None = optional("Values of a xacro's arguments by name, texts or numbers.")
    dh: DhTablePayload | None = optional("The robot as a Denavit-Hartenberg table.")
    screws: ScrewsPayload | None = optional("The robot as a product of exponentials; it is stored as the URDF of it.")
    description: Text = Field(default="", description="One sentence for human readers.")
    strict: Strict = False
    default_chain: ChainEnds | None = optional(
        "Chain used by calls that name none; root link → leaf with the longest movable chain if left out."
    )

    @model_validator(mode="after")
    def _one_description(self) -> "RobotReplacement":
        if sum(given is not None for given in (self.urdf, self.dh, self.screws)) != 1:
            raise ValueError("give exactly one of `urdf`, `dh` and `screws`")
        if self.arguments and self.urdf is None:
            raise ValueError("`arguments` are those of a xacro, which is given as `urdf`")
        return self


class NewRobot(RobotReplacement):
    """A robot to add, under a name."""

    name: RobotName


class ArchiveReplacement(Payload):
    """The text fields sent with an archive."""

    description: Text = Field(default="", description="One sentence for human readers.")
    strict: Annotated[Strict, Field(strict=False)] = False
    file: str | None = optional("Path in the archive of the URDF, xacro or MJCF; only needed if several can be meant.")
    arguments: Json[Arguments] | None = optional("Values of a xacro's arguments: a JSON object of texts and numbers.")
    base_frame: FrameName | None = optional("Base frame of the default chain; requires `tip_frame`.")
    tip_frame: FrameName | None = optional("Tip frame of the default chain; requires `base_frame`.")

    @model_validator(mode="after")
    def _both_ends(self) -> "ArchiveReplacement":
        if (self.base_frame is None) != (self.tip_frame is None):
            raise ValueError("`base_frame` and `tip_frame` of the default chain go together")
        return self

    def ends(self) -> ChainEnds | None:
        """Return the default chain, if one is given."""
        if self.base_frame is None or self.tip_frame is None:
            return None
        return ChainEnds(base_frame=self.base_frame, tip_frame=self.tip_frame)


class NewArchive(ArchiveReplacement):
    """An archive with the name of the robot to add."""

    name: RobotName


class RobotSummary(Answer):
    """A robot in the list."""

    name: str = Field(description="Name by which the robot is requested.")
    description: str = Field(description="One sentence for human readers; may be empty.")
    maker: str | None = Field(description="Who builds it; null if unknown, as of an upload.")
    kind: str | None = Field(description="Such as `collaborative arm`; null if unknown, as of an upload.")
    closed_form: str | None = Field(
        description="The geometry behind the closed form of the default chain's inverse kinematics; null if there is "
        "none for the full pose, and of an upload, for which `ik` tells."
    )
    source: Literal["catalogue", "uploaded"] = Field(
        description="Whether the robot is part of the service's catalogue."
    )
    format: Literal["urdf", "dh"] = Field(description="Format of its description.")
    default_chain: ChainEnds


class RobotList(Answer):
    """All robots, the catalogue's first, each part by name."""

    robots: list[RobotSummary]


class LimitsInfo(Answer):
    """Limits of a joint; null where there is none."""

    lower: float | None = Field(description="Least position; null where there is none, [rad or m].")
    upper: float | None = Field(description="Greatest position; null where there is none, [rad or m].")
    velocity: float | None = Field(description="Greatest speed; null where none is given, [rad/s or m/s].")
    effort: float | None = Field(description="Greatest torque or force; null where none is given, [N m or N].")


class MimicInfo(Answer):
    """The joint's position is `multiplier` · position of `joint` + `offset`."""

    joint: str = Field(description="The joint that this one follows.")
    multiplier: float = Field(description="Of the leader's position, [rad or m] per [rad or m].")
    offset: float = Field(description="Added to the multiple, [rad or m].")


class JointInfo(Answer):
    """A joint of a robot."""

    name: str = Field(description="Of the joint.")
    type: Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"] = Field(
        description="Type of joint."
    )
    parent: str = Field(description="The link nearer to the root.")
    child: str = Field(description="The link that the joint moves.")
    origin: Pose = Field(description="Pose of the joint's frame in the parent link, at position zero.")
    axis: list[float] | None = Field(description="Unit vector in the joint's frame; null where a joint has none.")
    limits: LimitsInfo
    mimic: MimicInfo | None


class MeshInfo(Answer):
    """A mesh file that the description names."""

    reference: str = Field(description="As the description writes it.")
    path: str | None = Field(description="Below `…/meshes/`; null where the file is missing.")


class RobotInfo(RobotSummary):
    """Everything about a robot but its poses."""

    payload: float | None = Field(description="Greatest load as the maker publishes it; null if unknown, [kg].")
    reach: float | None = Field(
        description="As the maker publishes it, mostly from the first axis to the wrist's centre; null if unknown, [m]."
    )
    controller: Controller | None = Field(description="How the maker's controller sees the robot; null if unknown.")
    chains: dict[str, ChainEnds] = Field(description="Named chains, such as the arms of a two-armed robot.")
    root: str = Field(description="The link without a parent.")
    joints: list[JointInfo]
    joint_names: list[str] = Field(description="The default chain's joints, base to tip: the order of a configuration.")
    dh: DhTablePayload | None = optional("The table, of a robot that was given as one.")
    degrees_of_freedom: int = Field(description="Joints of the whole robot with a position of their own.")
    links: list[str] = Field(description="Their names.")
    frames: list[str] = Field(description="Names of the frames that calls may use.")
    leaf_tips: list[str] = Field(description="Links without children.")
    meshes: list[MeshInfo]
    skeleton: list[LinkShape] = Field(
        description="Shapes to draw of links without a visual, or whose meshes are missing: rods between the joints, "
        "and bodies of these. They have no mass and no collision; a DH table has its own visuals."
    )
    licence: str | None = Field(description="Licence of the description; null if unknown.")
    provenance: str | None = Field(description="Where the description comes from.")
    warnings: list[str] = Field(description="Oddities of the description that were accepted.")


EXAMPLE_DH: dict[str, Any] = {
    "name": "my_planar_arm",
    "description": "Two links of 1 m and 0.7 m in a plane",
    "dh": {
        "convention": "standard",
        "joints": [
            {"name": "shoulder", "type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0},
            {"name": "elbow", "type": "revolute", "a": 0.7, "alpha": 0.0, "d": 0.0, "theta": 0.0},
        ],
    },
}
