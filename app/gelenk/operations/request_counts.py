"""What an answer says of itself to the metrics; it goes along with the answer from whichever process makes it."""

from collections.abc import Mapping
from contextvars import ContextVar
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class RequestCounts:
    """What was in a call.

    Attributes:
        batch: Configurations or targets.
        verdicts: Of inverse kinematics, targets by verdict.
        solutions: How many were found.
        iterations: That led to them, in all.
    """

    batch: int
    verdicts: Mapping[str, int] = field(default_factory=dict)
    solutions: int = 0
    iterations: int = 0


REQUEST_COUNTS: ContextVar[RequestCounts | None] = ContextVar("request_counts", default=None)
"""That of the request which is being answered; None where there is nothing to count."""
