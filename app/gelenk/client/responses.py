"""What a response means: an answer, an exception, or that the call is sent again."""

import random
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from http import HTTPStatus
from typing import Any, TypeVar

import httpx2
import orjson

from gelenk.client.call import Call
from gelenk.client.refusals import KIND_PREFIX, NotAnswering, refusal

T = TypeVar("T")

TIMEOUT = httpx2.Timeout(5.0, read=120.0, write=120.0, pool=None)
"""Timeouts, [s]; the service ends calls that take too long and says so. A call may wait for others of its client."""
AT_ONCE = 16
"""Calls of a client that are sent at a time: as many as the service accepts from one. Others wait."""
_ATTEMPTS = 4
_FIRST_PAUSE = 0.2
_LONGEST_PAUSE = 30.0
"""Longest wait, [s]; if the service wishes a longer one, the exception is raised instead."""
_COME_AGAIN = {HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE}
_NEVER_SENT = (httpx2.ConnectError, httpx2.ConnectTimeout, httpx2.PoolTimeout)
_BROKEN_OFF = (httpx2.ReadError, httpx2.WriteError, httpx2.RemoteProtocolError, httpx2.CloseError)


class Patience:
    """Decides how long to wait before a call is sent again: only where that does no harm, and only a few times.

    - Any call is repeated if the service says when to come again (429, 503): it has not executed the call.
    - Any call is repeated if it was never sent, because there was no connection.
    - A repeatable call is repeated if the connection broke, or a proxy in front of the service lost it (502).
    - A call that took too long is not repeated: it would take too long again.
    """

    def __init__(self, call: Call[Any], url: str) -> None:
        self._call, self._url, self._tried = call, url, 0

    def after_answer(self, response: httpx2.Response) -> float | None:
        """Return the seconds until the next attempt; None if this answer is final."""
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
        """Return the seconds until the next attempt; NotAnswering if there were enough, or the call may be executed."""
        self._tried += 1
        is_safe = isinstance(error, _NEVER_SENT) or (self._call.is_repeatable and isinstance(error, _BROKEN_OFF))
        if not is_safe or self._tried >= _ATTEMPTS:
            raise NotAnswering(self._url, self._reason(error)) from error
        return self._pause()

    def _pause(self) -> float:
        return _FIRST_PAUSE * 2.0**self._tried * random.uniform(0.5, 1.0)  # noqa: S311 - spreads clients, hides nothing

    def _reason(self, error: httpx2.TransportError) -> str:
        """Return what went wrong, and what that means for the call."""
        said = str(error) or type(error).__name__
        if isinstance(error, httpx2.ConnectError | httpx2.ConnectTimeout):
            return f"{said}; is it running, and is that its address?"
        if isinstance(error, httpx2.ReadTimeout):
            said = f"it took longer than {TIMEOUT.read:g} s"
        left = "" if self._call.is_repeatable else "; whether the call was executed is not known"
        return f"{said}{left}"


def _seconds(retry_after: str) -> float | None:
    """Parse `Retry-After` (RFC 9110, 10.2.3), seconds or a date; None if it is neither."""
    if retry_after.isascii() and retry_after.isdigit():
        return float(retry_after)
    try:
        moment = parsedate_to_datetime(retry_after)
    except ValueError:
        return None
    return max(0.0, (moment.replace(tzinfo=moment.tzinfo or UTC) - datetime.now(UTC)).total_seconds())


def answer(call: Call[T], response: httpx2.Response, url: str) -> T:
    """Read the answer in a response; raises Refused if the service refuses the call, or something in front of it does.

    Raises NotAnswering if something other than the service has answered.
    """
    if not response.is_success:
        raise refusal(_problem(response, url))
    try:
        return call.read(response)
    except (ValueError, KeyError, EOFError) as error:
        media = response.headers.get("content-type", "").partition(";")[0] or "nothing"
        reason = f"what is there answers with {media}, not as Gelenk does; is that the address of the service?"
        raise NotAnswering(url, reason) from error


def _problem(response: httpx2.Response, url: str) -> dict[str, Any]:
    """Return the service's problem, or one that explains a response of something in its place."""
    try:
        problem = orjson.loads(response.content)
    except orjson.JSONDecodeError:
        problem = None
    if isinstance(problem, dict) and "detail" in problem and str(problem.get("type")).startswith(KIND_PREFIX):
        return problem
    status = response.status_code
    detail = f"{url} answers with {status} {response.reason_phrase}".rstrip()
    if response.has_redirect_location:
        detail = f"{detail} and leads to {response.headers['location']}: that may be the address to use"
    elif status >= HTTPStatus.INTERNAL_SERVER_ERROR:
        detail = f"{detail}, without a reason: the service behind it may not be running"
    else:
        detail = f"{detail}, not as Gelenk does: is that the address of the service?"
    return {"status": status, "detail": detail}
