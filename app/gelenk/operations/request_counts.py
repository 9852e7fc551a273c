"""Counts of a request for the metrics; an answer carries them from whichever process makes it."""

from collections.abc import Mapping
from contextvars import ContextVar
from typing import NamedTuple


class RequestCounts(NamedTuple):
    """Counts of one call: its configurations or targets, and all iterations that led to the solutions."""

    batch: int
    verdicts: Mapping[str, int] = {}
    solutions: int = 0
    iterations: int = 0


REQUEST_COUNTS: ContextVar[RequestCounts | None] = ContextVar("request_counts", default=None)
"""Counts of the current request; None if there is nothing to count."""
