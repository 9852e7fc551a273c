"""The preference of a caller for an asynchronous response: `Prefer: respond-async` (RFC 7240)."""

from collections.abc import Iterable

_PREFER = b"prefer"
_LATER = b"respond-async"

APPLIED = {"Preference-Applied": _LATER.decode()}
"""Header of a response that follows this preference."""


def wants_answer_later(headers: Iterable[tuple[bytes, bytes]]) -> bool:
    """Check whether a request's headers prefer that a job answers it."""
    return any(
        _LATER in (token.partition(b";")[0].strip().lower() for token in value.split(b","))
        for name, value in headers
        if name == _PREFER
    )
