"""What a monitor is told."""

from pydantic import Field

from app.schemas.common import Answer


class Health(Answer):
    """The process lives, or is ready for work."""

    status: str = Field(description="`alive`, or `ready`.")
