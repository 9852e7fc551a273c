"""Whether a caller prefers an asynchronous answer: `Prefer: respond-async` (RFC 7240)."""

from collections.abc import Iterable

_PREFER = b"prefer"
_LATER = b"respond-async"

APPLIED = {"Preference-Applied": _LATER.decode()}
"""Header of an answer that heeds it."""


def wants_answer_later(headers: Iterable[tuple[bytes, bytes]]) -> bool:
    """Whether one of the preferences in a request's headers is to be answered by a job."""
    return any(
        _LATER in (token.partition(b";")[0].strip().lower() for token in value.split(b","))
        for name, value in headers
        if name == _PREFER
    )
