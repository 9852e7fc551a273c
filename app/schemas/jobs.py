"""What travels about jobs."""

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field

from app.schemas.common import Answer

JobName = Annotated[
    str,
    Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$",
        description="A name of your own for the job, so that the same call sent again finds the same job; one is "
        "made up if left out.",
        examples=["panda-workspace"],
    ),
]

Finished: TypeAlias = Literal["keep", "remove"]
"""What becomes of a job that is to be cancelled and has come to its end."""


class JobError(Answer):
    """Why a job failed."""

    type: str = Field(description="The same as of the problem that its result answers with.")
    detail: str = Field(description="What went wrong, in a sentence.")
    facts: dict[str, Any] = Field(description="Typed data of this kind of problem.")


class JobInfo(Answer):
    """A job."""

    id: str = Field(description="By which it is asked for.")
    kind: Literal["workspace", "ik", "trajectory"] = Field(description="What it works on.")
    state: Literal["queued", "running", "succeeded", "failed", "cancelled"] = Field(
        description="The last three are final."
    )
    progress: float = Field(ge=0, le=1, description="From 0 to 1; never smaller than before.")
    created: str = Field(description="When it was asked for, RFC 3339, UTC.")
    started: str | None = Field(description="When it was begun for the first time; null before.")
    finished: str | None = Field(description="When it came to a final state; null before.")
    attempts: int = Field(
        ge=0,
        description="How often it was begun since it got further: more than once where the service has ended "
        "meanwhile; after three times it is given up.",
    )
    robot_digest: str | None = Field(
        default=None,
        description="SHA-256 of the URDF of the robot that it is about, as `GET /v1/robots/{robot}/urdf` had it then: "
        "another robot may have its name by now.",
    )
    error: JobError | None = Field(default=None, description="Of a failed job.")
