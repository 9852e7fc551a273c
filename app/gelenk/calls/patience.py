"""When a call is sent again: where that does no harm, not for ever, and no sooner than the service wishes."""

import random
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from http import HTTPStatus
from typing import Any

import httpx2

from gelenk.calls.call import Call
from gelenk.calls.refusals import NotAnswering

TIMEOUT = httpx2.Timeout(5.0, read=120.0, write=120.0, pool=None)
"""[s]; the service ends what takes too long by itself, and says so. A call may wait for others of its own client."""
AT_ONCE = 16
"""Calls of a client that are under way at a time: as many as the service takes of one. Others wait for their turn."""
_ATTEMPTS = 4
_FIRST_PAUSE = 0.2
_LONGEST_PAUSE = 30.0
"""[s]; a longer wait raises the exception instead."""
_COME_AGAIN = {HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE}
_NEVER_SENT = (httpx2.ConnectError, httpx2.ConnectTimeout, httpx2.PoolTimeout)
_BROKEN_OFF = (httpx2.ReadError, httpx2.WriteError, httpx2.RemoteProtocolError, httpx2.CloseError)


class Patience:
    """How long to wait before a call is sent again, and when to give up.

    - Any call where the service itself says when to come again (429, 503): it has not done it.
    - Any call that was never sent, because there was no connection.
    - A repeatable one where the connection broke, or where what is in front of the service has lost it (502).
    - None that took too long: it would again.
    """

    def __init__(self, call: Call[Any], url: str) -> None:
        self._call, self._url, self._tried = call, url, 0

    def after_answer(self, response: httpx2.Response) -> float | None:
        """Seconds until the next attempt; None if this answer is final."""
        self._tried += 1
        if self._tried >= _ATTEMPTS:
            return None
        if response.status_code in _COME_AGAIN:
            wanted = _seconds(response.headers.get("retry-after", ""))
            return wanted if wanted is not None and wanted <= _LONGEST_PAUSE else None
        if response.status_code == HTTPStatus.BAD_GATEWAY and self._call.is_repeatable:
            return self._pause()
        return None

    def after_failure(self, error: httpx2.TransportError) -> float:
        """Seconds.

        Raises:
            NotAnswering: It was tried often enough, or the call might have been done already.
        """
        self._tried += 1
        is_safe = isinstance(error, _NEVER_SENT) or (self._call.is_repeatable and isinstance(error, _BROKEN_OFF))
        if not is_safe or self._tried >= _ATTEMPTS:
            raise NotAnswering(self._url, self._reason(error)) from error
        return self._pause()

    def _pause(self) -> float:
        return _FIRST_PAUSE * 2.0**self._tried * random.uniform(0.5, 1.0)  # noqa: S311 - spreads clients, hides nothing

    def _reason(self, error: httpx2.TransportError) -> str:
        """What went wrong, and what that means for the call."""
        said = str(error) or type(error).__name__
        if isinstance(error, httpx2.ConnectError | httpx2.ConnectTimeout):
            return f"{said}; is it running, and is that its address?"
        if isinstance(error, httpx2.ReadTimeout):
            said = f"it took longer than {TIMEOUT.read:g} s"
        left = "" if self._call.is_repeatable else "; whether the call was executed is not known"
        return f"{said}{left}"


def _seconds(retry_after: str) -> float | None:
    """`Retry-After` (RFC 9110, 10.2.3): seconds, or a moment; None where it is neither."""
    if retry_after.isascii() and retry_after.isdigit():
        return float(retry_after)
    try:
        moment = parsedate_to_datetime(retry_after)
    except ValueError:
        return None
    return max(0.0, (moment.replace(tzinfo=moment.tzinfo or UTC) - datetime.now(UTC)).total_seconds())
