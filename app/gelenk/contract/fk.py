"""Forward kinematics: request, answer, operation."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer, ChainOptions, FrameName
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import Configurations
from gelenk.contract.pose import Pose, PoseFormat
from gelenk.kinematics.judge.words import PoseCertificate


class ForwardOptions(ChainOptions):
    """Options of forward kinematics."""

    list_fields = frozenset({"frames"})

    pose_format: PoseFormat = Field(default="quaternion_xyzw", description="Notation of the poses in the answer.")
    frames: list[FrameName] | Literal["all"] | None = Field(
        default=None, description='Further frames that the chain moves, by name, or "all" of them.'
    )
    respect_limits: bool = Field(
        default=False, description="Whether a configuration beyond the joint limits is an error."
    )


class ForwardRequest(ForwardOptions):
    """Forward kinematics of a batch of configurations."""

    joint_positions: Configurations


class ForwardAnswer(Answer):
    """Poses, one entry per configuration, in order."""

    joint_names: list[str] = Field(description="The chain's joints in the order of a configuration.")
    base_frame: str = Field(description="Frame in which the poses are expressed.")
    tip_frame: str = Field(description="Frame whose poses they are.")
    poses: list[Pose] = Field(description="T_base_tip at each configuration.")
    frames: list[dict[str, Pose]] | None = Field(
        default=None, description="If frames were requested: T_base_frame by name, one entry per configuration."
    )
    certificate: PoseCertificate


ENDPOINT = RobotEndpoint(
    name="fk",
    operation_id="forward_kinematics",
    request=ForwardRequest,
    answer=ForwardAnswer,
    summary="Forward kinematics",
    description="""
    Pose of the tip, and of other frames on the chain, at each configuration.

    Poses are those of `tip_frame` in `base_frame`. Every answer is recomputed through Pinocchio before it is
    sent (a sample of a large batch), and `certificate` gives the difference.
    """,
    batch="joint_positions",
    options=ForwardOptions,
    npy_body="`joint_positions` as an array of shape (N, n).",
    npy_answer="Poses as one array: (N, 7) position and quaternion, (N, 6) with a triple of angles, "
    "(N, 4, 4) matrices.",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "tip_frame": "panda_link8",
        "pose_format": "rpy",
    },
)
