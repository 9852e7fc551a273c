"""An error on the wire (RFC 9457)."""

from pydantic import BaseModel, ConfigDict, Field


class FieldError(BaseModel):
    """What is wrong in one place of a payload."""

    pointer: str = Field(description="JSON pointer into the payload, or the name of a query parameter.")
    detail: str = Field(description="What is wrong there, in a sentence.")


class Problem(BaseModel):
    """A problem: what went wrong, why, and what is allowed; further members hold typed facts."""

    model_config = ConfigDict(extra="allow")

    type: str = Field(description="Kind of problem, the same for all of its kind.")
    title: str = Field(description="The kind in words.")
    status: int = Field(description="HTTP status.")
    detail: str = Field(description="This occurrence, in a sentence for people.")
    instance: str = Field(description="Path of the request.")
    request_id: str | None = Field(
        default=None, description="The answer's `X-Request-Id`, by which the log is searched."
    )
    errors: list[FieldError] | None = Field(default=None, description="Places in the payload, where there are several.")
