"""Turns a response into an answer, or into an exception with one clear sentence, whatever server has sent it."""

from http import HTTPStatus
from typing import Any, TypeVar

import httpx2
import orjson

from gelenk.client.call import Call
from gelenk.client.refusals import KIND_PREFIX, NotAnswering, refusal

T = TypeVar("T")


def answer(call: Call[T], response: httpx2.Response, url: str) -> T:
    """Read the answer in a response.

    Args:
        call: The call that was sent.
        response: The whole response.
        url: Address of the service.

    Raises:
        Refused: The service refuses the call, or something in front of it does.
        NotAnswering: Something other than the service has answered.
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
    told = f"{url} answers with {status} {response.reason_phrase}".rstrip()
    if response.has_redirect_location:
        told = f"{told} and leads to {response.headers['location']}: that may be the address to use"
    elif status >= HTTPStatus.INTERNAL_SERVER_ERROR:
        told = f"{told}, without a reason: the service behind it may not be running"
    else:
        told = f"{told}, not as Gelenk does: is that the address of the service?"
    return {"status": status, "detail": told}
