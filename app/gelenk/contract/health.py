"""The answer that a monitor gets."""

from pydantic import Field

from gelenk.contract.common import Answer


class Health(Answer):
    """The process is alive, or ready for work."""

    status: str = Field(description="`alive`, or `ready`.")
