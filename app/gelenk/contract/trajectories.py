"""Batches of joint motions: request, answer, operation."""

from pydantic import Field

from gelenk.collision.contact.words import ContactCertificate
from gelenk.contract.common import Answer, ChainOptions, optional
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import MAX_CONFIGURATIONS, AboutChain, Configurations
from gelenk.contract.options import InLanguage
from gelenk.contract.scene import InCell
from gelenk.contract.trajectory_answer import LimitSourcesInfo, MotionLimitsInfo
from gelenk.contract.trajectory_request import MotionOptions
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.trajectory.audit.words import Law

MAX_MOTIONS = 100_000
"""Maximum number of motions of a call."""
MAX_JOB_MOTIONS = MAX_CONFIGURATIONS
"""Maximum number of motions of a job."""
COLUMNS = (
    "passed",
    "duration",
    "velocity_ratio",
    "acceleration_ratio",
    "jerk_ratio",
    "limit_margin",
    "tip_speed",
    "tip_angular_speed",
    "tip_acceleration",
    "tip_angular_acceleration",
    "min_singular_value",
)
"""Columns of the array, which are the fields of a result but for its reason; in a cell `clearance` comes last."""


class MotionsOptions(ChainOptions, MotionOptions, InCell, InLanguage):
    """What all motions of a batch share."""

    law: Law = Field(default="trapezoidal", description="Of time, the same as of a segment of `trajectory`.")


class MotionsRequest(MotionsOptions):
    """A batch of joint motions from rest to rest, each as fast as law and limits allow."""

    starts: Configurations | None = optional(
        "Where the motions begin: one configuration for each target, or a single one for all; required in JSON."
    )
    targets: Configurations = Field(description="Where they end.")


class MotionResult(Answer):
    """One motion and its audit; without a motion all numbers are null."""

    passed: bool = Field(description="Whether there is a motion: one that passes its audit.")
    reason: str | None = Field(description="Why there is none; null if it passed.")
    duration: float | None = Field(description="[s]; 0 if nothing moves.")
    velocity_ratio: float | None = Field(description="Largest ratio of a joint's velocity to its limit, no unit.")
    acceleration_ratio: float | None = Field(description="Likewise, of the acceleration.")
    jerk_ratio: float | None = Field(description="Likewise, of the jerk within pieces; only some laws keep its limit.")
    limit_margin: float | None = Field(
        description="Smallest distance of a joint from its limits, [rad or m]; null without limits."
    )
    tip_speed: float | None = Field(description="Largest speed of the tip, [m/s].")
    tip_angular_speed: float | None = Field(description="Largest, [rad/s].")
    tip_acceleration: float | None = Field(description="Largest, [m/s²].")
    tip_angular_acceleration: float | None = Field(description="Largest, [rad/s²].")
    min_singular_value: float | None = Field(
        description="Smallest singular value of the Jacobian on the way, [m or rad] per [rad or m]: units are mixed."
    )
    clearance: float | None = optional(
        "If the request has `scene` or `min_clearance`: least distance of a pair at any time, less what an object "
        "demands, to 0.1 mm, [m]; also of a motion that there is not because it would touch something."
    )


class MotionsAnswer(AboutChain):
    """Results, one entry per motion, in order."""

    results: list[MotionResult] = Field(description="One per motion.")
    limits: MotionLimitsInfo = Field(description="Of all motions.")
    limit_sources: LimitSourcesInfo
    notes: list[str] = Field(description="What was assumed.")
    certificate: PoseCertificate = Field(
        description="Of the tip's poses midway between starts and targets, a sample recomputed through Pinocchio."
    )
    contact_certificate: ContactCertificate | None = optional("Of the clearances, of which Coal recomputes a sample.")


ENDPOINT = RobotEndpoint(
    name="trajectories",
    request=MotionsRequest,
    answer=MotionsAnswer,
    summary="Many joint motions",
    description="""
    Many motions of the joints from one configuration to another, all with one law and the same limits: how long each
    takes, and what its audit finds.

    Each motion is that of a `joint` segment of `trajectory`, from rest to rest in the least time. It is audited like
    that one, by code independent of the planner: exact peaks of the joints, jumps where pieces meet, the ends; the tip
    and the singular values are sampled less densely, and searched between samples. A motion that cannot be done, as
    one to a target beyond the joint limits, or through something of a `scene`, has a `reason`, and the others are not
    affected; joints off the chain stand where `other_joints` says. For the samples of one of them ask `trajectory`.
    """,
    batch="targets",
    options=MotionsOptions,
    npy_holds_more=True,
    npy_body="An array of shape (N, 2, n): of each motion the start and the target.",
    npy_answer=f"An array of shape (N, {len(COLUMNS)}), of each motion {', '.join(f'`{name}`' for name in COLUMNS)}, "
    "the fields of a result; `passed` is 1 or 0, and what is null there is NaN. With `scene` or `min_clearance` "
    "`clearance` follows as one more column.",
    example={
        "starts": [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]],
        "targets": [[0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9], [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 3.0]],
        "law": "jerk_limited",
    },
    job=f"up to {MAX_JOB_MOTIONS:,} motions",
)
