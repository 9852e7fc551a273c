"""The strict base of all payloads, and what many of them share."""

from typing import Annotated, ClassVar

from pydantic import BaseModel, ConfigDict, Field


class Payload(BaseModel):
    """Something that comes in: no unknown fields, no NaN, no text for numbers."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)

    list_fields: ClassVar[frozenset[str]] = frozenset()
    """Fields that a query string gives by repeating their name."""


class Answer(BaseModel):
    """Something that goes out."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


FrameName = Annotated[str, Field(min_length=1, max_length=128, description="Name of a frame: each link has one.")]

RobotName = Annotated[
    str,
    Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$",
        description="1 to 64 letters, digits, `_`, `.` or `-`, the first one a letter or digit.",
        examples=["my_arm"],
    ),
]


class ChainEnds(Payload):
    """A chain by its two ends."""

    base_frame: FrameName
    tip_frame: FrameName


class ChainOptions(Payload):
    """The chain a call addresses."""

    base_frame: FrameName | None = Field(
        default=None, description="Frame in which poses are expressed; the default chain's if left out."
    )
    tip_frame: FrameName | None = Field(
        default=None, description="Frame whose pose is meant; the default chain's if left out."
    )
