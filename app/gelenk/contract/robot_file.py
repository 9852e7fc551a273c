"""The `robot.json` of a robot's folder."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.contract.collision_pairs import PairChoice
from gelenk.contract.common import ChainEnds, FrameName, Payload, optional

Text = Annotated[str, Field(max_length=2000)]
Label = Annotated[str, Field(max_length=100)]


class PackagedFile(Payload):
    """A file of an installed package."""

    package: Literal["example-robot-data"]
    path: str


class Controller(Payload):
    """How the maker's controller sees the robot: its frames, and the joint positions that its pendant shows.

    A joint's position is sign · shown + zero. Where `added` names another joint, what that one shows is first added to
    shown; where `subtracted` does, subtracted from it.
    """

    pose_format: Literal["ur", "kuka_abc", "abb", "fanuc_wpr"] = Field(description="The pendant's notation of poses.")
    base_frame: FrameName = Field(description="The frame that the controller gives poses in, its base.")
    tip_frame: FrameName = Field(description="The frame that it gives the pose of without a tool, its flange.")
    joint_signs: list[Literal[-1, 1]] = Field(description="Sense of each joint against the pendant's.", max_length=64)
    joint_zeros: list[float] = Field(description="Position of each joint where the pendant shows 0.", max_length=64)
    added: dict[str, str] = Field(
        default_factory=dict, description="By joint, the one whose pendant value adds to its own: of FANUC J3, J2."
    )
    subtracted: dict[str, str] = Field(
        default_factory=dict,
        description="By joint, the one whose pendant value is taken from its own: of an ABB whose J3 a linkage holds.",
    )


class RobotFile(Payload):
    """The `robot.json` of a robot's folder, written by the service or by hand."""

    description: Text = ""
    maker: Label | None = optional("Who builds the robot.")
    kind: Label | None = optional("What sort of robot it is, as catalogues group them.")
    closed_form: Label | None = optional("The closed form of the default chain, as `ik` names it.")
    payload: float | None = optional("Greatest load as the maker publishes it, [kg].")
    reach: float | None = optional("As the maker publishes it: mostly from the first axis to the wrist's centre, [m].")
    controller: Controller | None = optional("How the maker's controller sees it.")
    format: Literal["urdf", "dh"]
    model: str | PackagedFile = Field(description="The URDF or DH file, in this folder or in a package.")
    srdf: str | PackagedFile | None = optional("The SRDF, in this folder or in a package.")
    meshes: str | None = optional("Folder of the mesh files, in this folder.")
    urdf_folder: str = Field(default="", description="Where the URDF stood among the mesh files.")
    digest: str | None = optional("SHA-256 of the model and its meshes, of an uploaded robot.")
    owner: str | None = optional("Which client uploaded it; null where none did.")
    kept_bytes: int = Field(default=0, description="Of the model and its meshes, of an uploaded robot.")
    left_out: int = Field(default=0, description="Files of the archive, meshes or pictures, that nothing names.")
    findings: list[str] = Field(default_factory=list, description="What is odd in an upload besides its URDF.")
    default_chain: ChainEnds | None = None
    chains: dict[str, ChainEnds] = Field(default_factory=dict)
    collision_pairs: list[PairChoice] = Field(default_factory=list, description="As a person chose them.")
    licence: str | None = None
    source: str | None = None
