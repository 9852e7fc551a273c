"""Conversion of a DH table to URDF: request, answer, operation."""

from pydantic import Field

from gelenk.contract.common import Answer, Payload, RobotName
from gelenk.contract.dh import EXAMPLE_TABLE, DhTablePayload, TableCertificate
from gelenk.contract.endpoint import Endpoint


class ToUrdfRequest(Payload):
    """A table to be written as URDF."""

    name: RobotName
    dh: DhTablePayload


class ToUrdfAnswer(Answer):
    """The robot that a table describes."""

    urdf: str = Field(description="Links `base`, `frame_0`, `link_1`, …, `tool`; each DH frame is a link `frame_i`.")
    joint_names: list[str] = Field(description="The variables, base to tip: the order of a configuration.")
    certificate: TableCertificate = Field(description="The table's own product against the URDF through Pinocchio.")
    notes: list[str] = Field(description="What the URDF states and no table can: masses, and limits not given.")
    warnings: list[str] = Field(description="What the table leaves open, and how it was resolved.")


ENDPOINT = Endpoint(
    name="dh_to_urdf",
    path="v1/dh/to-urdf",
    tag="DH tables",
    request=ToUrdfRequest,
    answer=ToUrdfAnswer,
    summary="Table → URDF",
    description="""
    Writes a table as URDF, to 17 significant digits, with simple visual bodies.

    Both conventions, revolute and prismatic joints, base, tool, offsets and limits. The URDF is read back and
    recomputed through Pinocchio before it is sent. Masses are invented, and a velocity or effort that is not given
    is written as one that no joint reaches; `notes` say so.
    """,
    example={"name": "my_arm", "dh": EXAMPLE_TABLE},
)
