"""Conversion of a DH table to the other convention: request, answer, operation."""

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.contract.dh import EXAMPLE_TABLE, Convention, DhTablePayload, InColumns, TableCertificate, TableSteps
from gelenk.contract.endpoint import Endpoint


class ConvertRequest(InColumns):
    """A table, and the convention to write it in."""

    dh: DhTablePayload
    convention: Convention


class ConvertAnswer(Answer):
    """A table of the same chain in this convention."""

    dh: DhTablePayload = Field(description="A valid request's `dh`; base and tool left out where the identity.")
    joint_names: list[str] = Field(description="The variables, base to tip: the order of a configuration.")
    certificate: TableCertificate = Field(description="Both tables, as URDF, through Pinocchio.")
    steps: TableSteps


ENDPOINT = Endpoint(
    name="convert_dh",
    path="v1/dh/convert",
    tag="DH tables",
    request=ConvertRequest,
    answer=ConvertAnswer,
    summary="Standard ↔ modified",
    description="""
    Writes a Denavit-Hartenberg table in the other convention, standard (distal) or modified (Craig), exactly: α and a
    move by one row, base and tool absorb the rest. `steps` shows how.
    """,
    example={"dh": EXAMPLE_TABLE, "convention": "standard"},
)
