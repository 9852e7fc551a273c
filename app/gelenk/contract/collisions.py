"""Contacts of a robot with itself and a scene: request, answer, operation."""

from typing import Literal

from pydantic import Field

from gelenk.collision.contact.words import ContactCertificate
from gelenk.contract.common import Answer, ChainOptions, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import AboutChain
from gelenk.contract.options import BatchRequest
from gelenk.contract.scene import OtherJoints, SceneOrName


class CollisionOptions(ChainOptions):
    """What to say of each configuration."""

    clearance: bool = Field(default=False, description="Whether to compute how far the nearest pair is apart.")
    pairs: Literal["none", "first", "all"] = Field(
        default="first",
        description="`first`: one pair in contact, with `clearance` the deepest, or the nearest if none is. `all`: "
        "every pair in contact.",
    )


class CollisionRequest(BatchRequest, CollisionOptions):
    """Contacts at a batch of configurations."""

    scene: SceneOrName | None = optional("What is around the robot: objects, or the name of a stored scene.")
    other_joints: OtherJoints = None


class ContactPair(Answer):
    """Two links, or a link or attached object and an object."""

    a: str = Field(description="Name of the one.")
    b: str = Field(description="Name of the other.")
    distance: float = Field(
        description="Between the two, [m]. In contact negative: moved by as much along the line from `point_b` to "
        "`point_a` they are apart."
    )
    point_a: list[float] = Field(description="Of `a`, in contact its deepest point, in the root frame, [m].")
    point_b: list[float] = Field(description="Of `b`, in contact its deepest point, in the root frame, [m].")


class CollisionResult(Answer):
    """Contacts at one configuration."""

    in_collision: bool = Field(description="Whether a pair is in contact, or nearer than its object's clearance.")
    clearance: float | None = optional(
        "If requested: smallest distance of all pairs, less the clearance that an object demands, [m]; at most 0 in "
        "contact. Null if nothing can touch anything."
    )
    pairs: list[ContactPair] | None = optional("If requested: pairs in contact, deepest first, or the nearest one.")


class CollisionAnswer(AboutChain):
    """Contacts, one entry per configuration, in order."""

    root_frame: str = Field(description="Frame of the robot in which the scene and all points are.")
    results: list[CollisionResult] = Field(description="Contacts at each configuration.")
    warnings: list[str] = Field(
        description="What of the robot has no body, or not one meant for this; which objects count as larger than they "
        "are, and by how much."
    )
    certificate: ContactCertificate


ENDPOINT = RobotEndpoint(
    name="collisions",
    request=CollisionRequest,
    answer=CollisionAnswer,
    summary="Contacts and clearance",
    description="""
    Whether the robot touches itself or its surroundings at each configuration, where, and how far it is from it.

    Links are what their collision shapes are; a mesh counts as the convex hulls of what it is cut into, so it may be in
    contact a little early, never late. Links that are neighbours do not count, nor do two that the chain does not move
    relative to each other. Distances are exact to 1e-6 m, and so is the depth of a contact, but that of a point deep
    inside a cylinder: it takes the two apart, and may be more than the smallest that does. Every answer is recomputed
    by Pinocchio and Coal before it is sent (a sample of a large batch).
    """,
    options=CollisionOptions,
    npy_answer="Contacts as one array of shape (N, 2): 1 in contact, else 0; clearance, NaN if not requested.",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "scene": {
            "objects": [
                {
                    "name": "table",
                    "shape": {"type": "box", "size": [0.6, 1.2, 0.05]},
                    "pose": {"position": [0.6, 0.0, 0.2], "rpy": [0.0, 0.0, 0.0]},
                }
            ]
        },
        "clearance": True,
    },
)
