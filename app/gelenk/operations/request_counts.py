"""Counts of a request for the metrics; an answer carries them from whichever process makes it."""

from collections.abc import Mapping
from contextvars import ContextVar
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class RequestCounts:
    """Counts of one call: its configurations or targets, and all iterations that led to the solutions."""

    batch: int
    verdicts: Mapping[str, int] = field(default_factory=dict)
    solutions: int = 0
    iterations: int = 0


REQUEST_COUNTS: ContextVar[RequestCounts | None] = ContextVar("request_counts", default=None)
"""Counts of the current request; None if there is nothing to count."""
