"""The picture of a table: request, answer, operation."""

from typing import Annotated, Any

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.contract.dh import Convention, DhTablePayload
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.kinematics import Configuration
from gelenk.contract.options import InLanguage


class DhPictureRequest(InLanguage):
    """A table, and the configuration in which it is drawn."""

    dh: DhTablePayload
    joint_positions: Annotated[
        list[Configuration],
        Field(
            max_length=1,
            description="At most one configuration, [rad] or [m]; if left out, one in which every joint has moved a "
            "little from zero, so that each ϑ_i can be seen.",
        ),
    ] = []  # noqa: RUF012


class DrawnFrame(Answer):
    """A frame of the table, in the axes of the base."""

    name: str = Field(description="Its index i; `B` is the base and `E` the tool, where they are frames of their own.")
    origin: list[float] = Field(description="O_i, [m].")
    x_axis: list[float] = Field(description="x_i, along the common normal; no unit.")
    z_axis: list[float] = Field(description="z_i, a joint axis; no unit.")


class DhPictureAnswer(Answer):
    """What the picture shows."""

    joint_names: list[str] = Field(description="The variables, base to tip.")
    joint_positions: list[float] = Field(description="The configuration that is drawn, [rad or m].")
    frames: list[DrawnFrame]


class ClassicPicture(InLanguage):
    """How the two links of the lecture are drawn."""

    convention: Convention = "standard"


def two_links(convention: str) -> dict[str, Any]:
    """Return the request for the picture of the lecture: two links on which no parameter is zero."""
    rows = [(0.6, 0.6, 0.4), (0.5, -0.6, 0.35)]
    if convention == "modified":
        rows.insert(0, (0.0, 0.0, 0.2))
    joints = [{"type": "revolute", "a": a, "alpha": alpha, "d": d, "theta": 0.0} for a, alpha, d in rows]
    return {"dh": {"convention": convention, "joints": joints}, "joint_positions": [[0.6] * len(rows)]}


ENDPOINT = Endpoint(
    name="dh_picture",
    path="v1/dh/picture",
    tag="DH tables",
    request=DhPictureRequest,
    answer=DhPictureAnswer,
    summary="Table → picture of its frames",
    description="""
    Draws the Denavit-Hartenberg frames of a table on its links, as a lecturer would.

    Axes x_i and z_i with their names, the common normals a_i and offsets d_i that are not zero, the twists α_i and the
    angles ϑ_i as arcs, revolute joints as cylinders and prismatic ones as boxes; the table is below. What belongs to
    an x axis has one colour, what belongs to a z axis another. SVG unless `Accept` says `image/png`,
    `application/pdf`, or `application/json` for the frames as numbers.
    """,
    picture="The frames of the table, and the table below.",
    is_picture=True,
    example=two_links("standard"),
)
