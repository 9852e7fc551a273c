"""An error as JSON (RFC 9457), and the answer that a monitor gets."""

from pydantic import BaseModel, ConfigDict, Field

from gelenk.contract.common import Answer, optional


class FieldError(BaseModel):
    """An error at one place in a payload."""

    pointer: str = Field(description="JSON pointer into the payload, or the name of a query parameter.")
    detail: str = Field(description="The error, in one sentence.")


class Problem(BaseModel):
    """A problem: what went wrong, why, and what is allowed; further members hold typed data."""

    model_config = ConfigDict(extra="allow")

    type: str = Field(description="Identifier of the kind of problem.")
    title: str = Field(description="The kind in words.")
    status: int = Field(description="HTTP status.")
    detail: str = Field(description="This occurrence, in one sentence for human readers.")
    instance: str = Field(description="Path of the request.")
    request_id: str | None = optional("The answer's `X-Request-Id`, for searching the log.")
    errors: list[FieldError] | None = optional("The invalid places in the payload, if there are several.")


class Health(Answer):
    """The process is alive, or ready for work."""

    status: str = Field(description="`alive`, or `ready`.")
