"""The convex pieces that a robot's links are made of where contacts are computed."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.contract.kinematics import Matrix


class CollisionBody(Answer):
    """A convex piece, fixed to a link."""

    name: str = Field(description="The link's, with a number where it has several pieces.")
    link: str = Field(description="Link with which it moves.")
    kind: Literal["sphere", "capsule", "cylinder", "box", "convex"] = Field(
        description="Capsules and cylinders are along z."
    )
    size: list[float] = Field(
        description="Of a sphere the radius, of a capsule or cylinder radius and length, a capsule's without its caps, "
        "of a box x, y, z, [m]; of others nothing."
    )
    points: list[list[float]] = Field(description="Of `convex` the corners of the hull, in the piece's axes, [m].")
    T_link_body: Matrix = Field(description="Pose of the piece in its link; 4 rows and columns, translation in [m].")
    excess: float | None = Field(
        description="Its volume over that of the part of a mesh that it contains, less one; no unit. Null where the "
        "mesh is not closed."
    )


class CollisionBodies(Answer):
    """All pieces of a robot, in the order of its links."""

    bodies: list[CollisionBody]
    warnings: list[str] = Field(description="Why some links have no body, or one not meant for contacts.")
