"""Forward kinematics: request, answer, operation."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import ChainOptions, FrameName, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import AboutChain
from gelenk.contract.options import BatchRequest, RespectLimits, WithSteps, WorkedSolutions
from gelenk.contract.pose import AnswerFormat, Pose
from gelenk.kinematics.judge.words import PoseCertificate


class ForwardOptions(ChainOptions, WithSteps):
    """Options of forward kinematics."""

    pose_format: AnswerFormat = "quaternion_xyzw"
    frames: list[FrameName] | Literal["all"] | None = optional(
        'Further frames that the chain moves, by name, or "all" of them.'
    )
    respect_limits: RespectLimits = False


class ForwardRequest(BatchRequest, ForwardOptions):
    """Forward kinematics of a batch of configurations."""


class ForwardAnswer(AboutChain):
    """Poses, one entry per configuration, in order."""

    base_frame: str = Field(description="Frame in which the poses are expressed.")
    tip_frame: str = Field(description="Frame whose poses they are.")
    poses: list[Pose] = Field(description="T_base_tip at each configuration.")
    frames: list[dict[str, Pose]] | None = optional(
        "If frames were requested: T_base_frame by name, one entry per configuration."
    )
    steps: WorkedSolutions = None
    certificate: PoseCertificate


ENDPOINT = RobotEndpoint(
    name="fk",
    operation_id="forward_kinematics",
    request=ForwardRequest,
    answer=ForwardAnswer,
    summary="Forward kinematics",
    description="""
    Pose of the tip, and of other frames on the chain, at each configuration: the direct kinematics T^0_n(q).

    Poses are those of `tip_frame` in `base_frame`. Every answer is recomputed through Pinocchio before it is
    sent (a sample of a large batch), and `certificate` gives the difference. `steps` show the chain as a DH table in
    the course's convention, A^(i-1)_i and T^0_i in numbers, and how the orientation is read off in `pose_format`.
    """,
    options=ForwardOptions,
    npy_answer="Poses as one array: (N, 7) position and quaternion, (N, 6) with a triple of angles, "
    "(N, 4, 4) matrices.",
    example={
        "joint_positions": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "tip_frame": "panda_link8",
        "pose_format": "rpy",
    },
)
