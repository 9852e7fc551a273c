"""Robots as listed, described and uploaded; and the `robot.json` of a folder."""

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from gelenk.contract.collision_pairs import PairChoice
from gelenk.contract.common import Answer, ChainEnds, FrameName, Payload, RobotName, Strict, optional
from gelenk.contract.dh import DhTablePayload
from gelenk.contract.pose import Pose


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


Text = Annotated[str, Field(max_length=2000)]


class PackagedFile(Payload):
    """A file of an installed package."""

    package: Literal["example-robot-data"]
    path: str


class RobotFile(Payload):
    """The `robot.json` of a robot's folder, written by the service or by hand."""

    description: Text = ""
    format: Literal["urdf", "dh"]
    model: str | PackagedFile = Field(description="The URDF or DH file, in this folder or in a package.")
    srdf: str | PackagedFile | None = optional("The SRDF, in this folder or in a package.")
    meshes: str | None = optional("Folder of the mesh files, in this folder.")
    urdf_folder: str = Field(default="", description="Where the URDF stood among the mesh files.")
    digest: str | None = optional("SHA-256 of the model and its meshes, of an uploaded robot.")
    owner: str | None = optional("Which client uploaded it; null where none did.")
    kept_bytes: int = Field(default=0, description="Of the model and its meshes, of an uploaded robot.")
    left_out: int = Field(default=0, description="Files of the archive, meshes or pictures, that nothing names.")
    findings: list[str] = Field(default_factory=list, description="What is wrong with meshes and SRDF of an upload.")
    default_chain: ChainEnds | None = None
    chains: dict[str, ChainEnds] = Field(default_factory=dict)
    collision_pairs: list[PairChoice] = Field(default_factory=list, description="As a person chose them.")
    licence: str | None = None
    source: str | None = None


class RobotReplacement(Payload):
    """A robot as URDF text or as a DH table: exactly one of the two."""

    urdf: str | None = optional("The URDF as text, xacro expanded.")
    dh: DhTablePayload | None = optional("The robot as a Denavit-Hartenberg table.")
    description: Text = Field(default="", description="One sentence for human readers.")
    strict: Strict = False
    default_chain: ChainEnds | None = optional(
        "Chain used by calls that name none; root link → leaf with the longest movable chain if left out."
    )

    @model_validator(mode="after")
    def _one_description(self) -> "RobotReplacement":
        if (self.urdf is None) == (self.dh is None):
            raise ValueError("give exactly one of `urdf` and `dh`")
        return self


class NewRobot(RobotReplacement):
    """A robot to add, under a name."""

    name: RobotName


class ArchiveReplacement(Payload):
    """The text fields sent with an archive."""

    description: Text = Field(default="", description="One sentence for human readers.")
    strict: Annotated[Strict, Field(strict=False)] = False
    file: str | None = optional("Path in the archive of the URDF that is meant; only needed if it holds several.")
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
