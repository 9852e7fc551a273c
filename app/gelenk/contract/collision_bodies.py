"""The convex pieces that a robot's links are made of where contacts are computed."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.contract.kinematics import Matrix


class SphereCover(Answer):
    """Spheres around a piece: what touches none of them does not touch the piece."""

    spheres: list[list[float]] = Field(
        description="Centre x, y, z in the link and radius of each, [m]: every point of the piece is in one of them."
    )
    excess: float | None = Field(
        description="Volume of all spheres together over that of the piece, less one, to about a thousandth of the "
        "spheres'; no unit. Null where the piece is flat."
    )
    protrusion: float = Field(description="Largest distance of a point of the spheres from the piece, [m].")


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
    cover: SphereCover = Field(description="Spheres around it, by which many a contact is ruled out.")


class CollisionBodies(Answer):
    """All pieces of a robot, in the order of its links."""

    bodies: list[CollisionBody]
    warnings: list[str] = Field(description="Why some links have no body, or one not meant for contacts.")
