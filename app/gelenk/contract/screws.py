"""A chain as a product of exponentials: the answer, and a robot given as one."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from gelenk.contract.common import Answer, Payload, optional
from gelenk.contract.dh import JointName, TableCertificate, placed
from gelenk.contract.kinematics import AboutChain
from gelenk.contract.pose import Pose
from gelenk.dh.tables.from_screws import ScrewJoint, describe_screws, space_axes
from gelenk.robot.description import Description
from gelenk.robot.dh import MAX_JOINTS, MAX_LENGTH

_Axis = Annotated[
    list[Annotated[float, Field(ge=-MAX_LENGTH, le=MAX_LENGTH)]],
    Field(min_length=6, max_length=6),
]
_Axes = Annotated[list[_Axis], Field(min_length=1, max_length=MAX_JOINTS)]
_ORDER = "ω, then v: [rad per rad or m], [m per rad or m]"


class ScrewJointPayload(Payload):
    """A joint of a product of exponentials."""

    name: JointName | None = optional("Unique; `joint_1`, `joint_2`, … if left out.")
    type: Literal["revolute", "prismatic"] | None = optional("What its axis says already: prismatic where ω is zero.")
    variable: JointName | None = optional("The joint that this one follows; itself if left out.")
    multiplier: float = Field(default=1.0, description="Its position per position of `variable`.")
    lower: float | None = optional("Lower limit of the position, [rad or m]; -π or -1 m if left out.")
    upper: float | None = optional("Upper limit of the position, [rad or m]; π or 1 m if left out.")
    velocity: float | None = optional("Velocity limit, [rad/s or m/s].", ge=0)
    effort: float | None = optional("Effort limit, [N m or N].", ge=0)


class ScrewsPayload(Payload):
    """A robot as a product of exponentials: T = exp([S_1] θ_1) ⋯ exp([S_n] θ_n) M.

    The axes are those of the space frame or those of the body frame; both may be given where they agree.
    """

    home: Pose = Field(description="M: T_base_tool where every variable is zero.")
    space_screws: _Axes | None = optional(f"S_1 … S_n in the base's axes, base to tip: {_ORDER}.")
    body_screws: _Axes | None = optional(f"B_1 … B_n in the tool's axes, base to tip: {_ORDER}.")
    joints: list[ScrewJointPayload] | None = optional("Names and limits, one for each axis.", max_length=MAX_JOINTS)

    def described(self, name: str) -> Description:
        """Return the robot; raises InvalidField, and InvalidPose if the orientation of `home` is no rotation."""
        home = placed("home", self.home)
        given = (None if axes is None else np.array(axes) for axes in (self.space_screws, self.body_screws))
        axes = space_axes(home, *given)
        joints = [ScrewJointPayload()] * len(axes) if self.joints is None else self.joints
        named = [
            ScrewJoint(**{**dict(joint), "name": joint.name or f"joint_{i}"}) for i, joint in enumerate(joints, start=1)
        ]
        return describe_screws(name, home, axes, named)


class ScrewJointInfo(Answer):
    """A joint on the chain's path, and what moves it."""

    name: str = Field(description="Of the joint.")
    type: Literal["revolute", "prismatic"] = Field(description="Whether it turns about or slides along its axis.")
    variable: str = Field(description="The joint whose position moves it: itself, unless it follows another one.")
    multiplier: float = Field(description="Its position per position of the variable, [rad or m] per [rad or m].")


class ScrewsAnswer(AboutChain):
    """A chain as a product of exponentials, angular part first as Modern Robotics writes it.

    T_base_tip = exp([S_1] θ_1) ⋯ exp([S_m] θ_m) M = M exp([B_1] θ_1) ⋯ exp([B_m] θ_m), where θ_i is the position of the
    variable of joint i times its multiplier.
    """

    home: Pose = Field(description="M: T_base_tip where every variable is zero.")
    joints: list[ScrewJointInfo] = Field(description="The joints on the path, base to tip, those that follow included.")
    space_screws: list[list[float]] = Field(description=f"S_1 … S_m in the base's axes, one for each joint: {_ORDER}.")
    body_screws: list[list[float]] = Field(description=f"B_1 … B_m in the tip's axes, one for each joint: {_ORDER}.")
    certificate: TableCertificate = Field(description="Both products against the robot through Pinocchio.")


EXAMPLE_SCREWS: dict[str, Any] = {
    "home": {"position": [1.7, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]},
    "space_screws": [[0, 0, 1, 0, 0, 0], [0, 0, 1, 0, -1.0, 0]],
}
