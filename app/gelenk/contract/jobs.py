"""Payloads about jobs."""

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field

from gelenk.contract.common import Answer, optional

JobName = Annotated[
    str,
    Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$",
        description="A name for the job, so that repeating the call finds the same job; generated if left out.",
        examples=["panda-workspace"],
    ),
]

Finished: TypeAlias = Literal["keep", "remove"]
"""What a request to cancel does with a job that has finished already."""


class JobError(Answer):
    """Why a job failed."""

    type: str = Field(description="Problem type, as in the problem returned for its result.")
    detail: str = Field(description="What went wrong, in a sentence.")
    facts: dict[str, Any] = Field(description="Typed data of this kind of problem.")


class JobInfo(Answer):
    """State and progress of a job."""

    id: str = Field(description="Name by which the job is requested.")
    kind: Literal["workspace", "ik", "trajectory", "trajectories"] = Field(description="The operation.")
    state: Literal["queued", "running", "succeeded", "failed", "cancelled"] = Field(
        description="State of the job; the last three are final."
    )
    progress: float = Field(ge=0, le=1, description="From 0 to 1; never smaller than before.")
    created: str = Field(description="Time of the request, RFC 3339, UTC.")
    started: str | None = Field(description="Time of its first start, RFC 3339, UTC; null before.")
    finished: str | None = Field(description="Time of its final state, RFC 3339, UTC; null before.")
    attempts: int = Field(
        ge=0,
        description="Number of starts since its last progress: more than one if the service ended in between; after "
        "three it is given up.",
    )
    robot_digest: str | None = optional(
        "SHA-256 of the robot's URDF as `GET /v1/robots/{robot}/urdf` returned it then: another robot may have that "
        "name by now."
    )
    error: JobError | None = optional("Of a failed job.")


class JobList(Answer):
    """Jobs of a client, the newest first."""

    jobs: list[JobInfo]
    next: int | None = Field(description="The `before` that continues with the next older jobs; null at the end.")
