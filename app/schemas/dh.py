"""Denavit-Hartenberg tables on the wire."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from app.model.arrays import Array
from app.model.dh import MAX_JOINTS, DhJoint, DhTable
from app.model.errors import InvalidPose
from app.schemas.common import Payload
from app.schemas.pose import Pose

JointName = Annotated[str, Field(min_length=1, max_length=128, pattern=r"^[^\x00-\x1f\x7f-\x9f]+$")]


class DhJointRow(Payload):
    """A row of the table; the joint's variable adds to `theta` (revolute) or to `d` (prismatic)."""

    name: JointName | None = Field(None, description="Unique in the table; `joint_1`, `joint_2`, … if left out.")
    type: Literal["revolute", "prismatic"] = Field(
        description="Whether the joint turns about or slides along its axis."
    )
    a: float = Field(description="Length of the common normal, [m].")
    alpha: float = Field(description="Twist about the common normal, [rad].")
    d: float = Field(description="Offset along the joint axis, [m].")
    theta: float = Field(description="Angle about the joint axis, [rad].")
    lower: float | None = Field(None, description="Lower limit of the variable, [rad or m]; -π or -1 m if left out.")
    upper: float | None = Field(None, description="Upper limit of the variable, [rad or m]; π or 1 m if left out.")
    velocity: float | None = Field(None, ge=0, description="Velocity limit, [rad/s or m/s].")
    effort: float | None = Field(None, ge=0, description="Effort limit, [Nm or N].")


class DhTablePayload(Payload):
    """A Denavit-Hartenberg table: T_base_tool = base · A_1 ⋯ A_n · tool.

    `standard` (distal): A_i = Rz(θ_i) Tz(d_i) Tx(a_i) Rx(α_i).
    `modified` (Craig): A_i = Rx(α_i) Tx(a_i) Rz(θ_i) Tz(d_i).
    """

    convention: Literal["standard", "modified"] = Field(description="How the four parameters of a row are composed.")
    joints: list[DhJointRow] = Field(min_length=1, max_length=MAX_JOINTS, description="The rows, base to tip.")
    base: Pose | None = Field(None, description="T_base_0; the identity if left out.")
    tool: Pose | None = Field(None, description="T_n_tool; the identity if left out.")

    def table(self) -> DhTable:
        """The core's table.

        Raises:
            InvalidPose: Base or tool is no rotation.
            InvalidDhTable: The table is not a robot.
        """
        joints = tuple(
            DhJoint(**{**row.model_dump(), "name": row.name or f"joint_{i}"})
            for i, row in enumerate(self.joints, start=1)
        )
        return DhTable(self.convention, joints, _placed("base", self.base), _placed("tool", self.tool))


def _placed(place: str, pose: Pose | None) -> Array:
    if pose is None:
        return np.eye(4)
    try:
        return pose.transform()
    except InvalidPose as error:
        raise InvalidPose(error.reason, error.distance, place) from error
