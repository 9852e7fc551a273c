"""Conversion of a URDF to a DH table: request, answer, operation."""

from pydantic import Field

from gelenk.contract.common import Answer, ChainOptions, Strict
from gelenk.contract.dh import (
    EXAMPLE_URDF,
    Convention,
    DhTablePayload,
    InColumns,
    SnapTolerance,
    TableCertificate,
    TableSteps,
)
from gelenk.contract.endpoint import Endpoint


class FromUrdfOptions(ChainOptions, InColumns):
    """The chain of a robot, and options of its table."""

    convention: Convention = "standard"
    snap_tolerance: SnapTolerance = 0.0


class FromUrdfRequest(FromUrdfOptions):
    """A description with the chain to write as a table."""

    urdf: str = Field(description="The URDF as text, xacro expanded.")
    strict: Strict = False


class FromUrdfAnswer(Answer):
    """The table of a chain."""

    dh: DhTablePayload = Field(description="A valid request's `dh`; base and tool left out where the identity.")
    joint_names: list[str] = Field(description="The variables, those of the chain, base to tip.")
    base_frame: str = Field(description="Where the chain begins: the base of the table.")
    tip_frame: str = Field(description="Where it ends: the tool of the table.")
    certificate: TableCertificate = Field(description="The table's own product against the robot through Pinocchio.")
    notes: list[str] = Field(description="What was chosen where the convention leaves a choice.")
    warnings: list[str] = Field(description="Oddities of the description that were accepted.")
    steps: TableSteps


ENDPOINT = Endpoint(
    name="dh_from_urdf",
    path="v1/dh/from-urdf",
    tag="DH tables",
    request=FromUrdfRequest,
    answer=FromUrdfAnswer,
    summary="URDF → table",
    description="""
    Finds the table of any serial chain of a robot from the geometry of its axes.

    Axes in any direction, fixed joints between them, continuous, prismatic and mimic joints, and chains that lead
    up the tree are all supported: base and tool absorb what the rows cannot express. A table is not unique; `notes`
    lists what was chosen where the convention leaves a choice.

    With `steps` the exercise of the lecture: how each Denavit-Hartenberg frame is placed, whether its axes are skew,
    intersecting, parallel or on one line, its common normal, and how a, α, d and the offset of ϑ follow.

    The common normal of nearly parallel axes can be kilometres away, as where a description writes π as 3.1416.
    Where a length would be beyond ten times the reach, such axes are taken as parallel if that costs less than
    1e-5 m and 1e-4 rad: the first of `notes` names them and the cost. Otherwise it says why the length is so large.
    """,
    example={"urdf": EXAMPLE_URDF, "tip_frame": "hand", "snap_tolerance": 1e-5},
)
