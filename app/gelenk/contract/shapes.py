"""Shapes to draw, as payloads."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer
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
