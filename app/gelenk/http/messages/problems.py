"""Every error as `application/problem+json` (RFC 9457), with the one table from error class to status.

A problem never repeats the payload: a client's names are shortened and escaped if they are quoted at all.
"""

import logging
import re
from collections.abc import Mapping, Sequence
from functools import cache
from http import HTTPStatus
from typing import Any

import orjson
from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from pydantic import ValidationError
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.routing import compile_path

from gelenk import errors
from gelenk.contract.endpoints import ROUTES

MEDIA_TYPE = "application/problem+json"

STATUS: dict[type[errors.KinematicsError], HTTPStatus] = {
    errors.InvalidInput: HTTPStatus.UNPROCESSABLE_ENTITY,
    errors.NotFound: HTTPStatus.NOT_FOUND,
    errors.NotPrinted: HTTPStatus.NOT_IMPLEMENTED,
    errors.TooLarge: HTTPStatus.REQUEST_ENTITY_TOO_LARGE,
    # Waiting does not help, so no client should retry by itself: neither 429 nor a 5xx.
    errors.QuotaExceeded: HTTPStatus.REQUEST_ENTITY_TOO_LARGE,
    errors.RobotExists: HTTPStatus.CONFLICT,
    errors.SceneExists: HTTPStatus.CONFLICT,
    errors.ReadOnlyRobot: HTTPStatus.FORBIDDEN,
    errors.StorageFailed: HTTPStatus.SERVICE_UNAVAILABLE,
    errors.StorageFull: HTTPStatus.INSUFFICIENT_STORAGE,
    errors.JobExists: HTTPStatus.CONFLICT,
    errors.JobNotFinished: HTTPStatus.CONFLICT,
    errors.JobFinished: HTTPStatus.CONFLICT,
    errors.JobCancelled: HTTPStatus.CONFLICT,
    errors.JobFailed: HTTPStatus.INTERNAL_SERVER_ERROR,
    errors.JobInterrupted: HTTPStatus.CONFLICT,
    errors.ServiceStopping: HTTPStatus.SERVICE_UNAVAILABLE,
    errors.JobTookTooLong: HTTPStatus.UNPROCESSABLE_ENTITY,
    errors.TooManyJobs: HTTPStatus.TOO_MANY_REQUESTS,
    errors.TooManyRequests: HTTPStatus.TOO_MANY_REQUESTS,
    errors.ServiceBusy: HTTPStatus.SERVICE_UNAVAILABLE,
    errors.NoRoomForBody: HTTPStatus.SERVICE_UNAVAILABLE,
    errors.DeadlineExceeded: HTTPStatus.GATEWAY_TIMEOUT,
    errors.WorkerCrashed: HTTPStatus.INTERNAL_SERVER_ERROR,
    errors.WorkerOutOfMemory: HTTPStatus.INTERNAL_SERVER_ERROR,
    errors.CertificationFailed: HTTPStatus.INTERNAL_SERVER_ERROR,
    errors.AuditFailed: HTTPStatus.INTERNAL_SERVER_ERROR,
}
"""A class not listed has the status of its nearest ancestor."""

_MOST_ERRORS = 20
_MOST_NAMES = 512
"""Enough for the frames of the largest robot."""
_LONGEST_FACT = 1000
_MOST_TEXT = 2000
_MOST_BYTES = 6000
_LATER = "10"
"""`Retry-After` if the duration is unknown, [s]."""

logger = logging.getLogger("gelenk")


class InvalidPayload(Exception):
    """A body or query that does not match its model, already summarised: `errors()` of a large one is costly."""

    def __init__(self, is_json: bool, places: list[dict[str, str]], count: int) -> None:
        self.is_json, self.places, self.count = is_json, places, count
        super().__init__(places[0]["detail"] if places else "the payload is invalid")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.is_json, self.places, self.count)

    @classmethod
    def of(cls, error: ValidationError | RequestValidationError) -> "InvalidPayload":
        """Summarise a validation error by its first few places."""
        if isinstance(error, ValidationError):
            found = error.errors(include_input=False, include_url=False)
        else:
            found = list(error.errors())
        if found and found[0]["type"] == "json_invalid":
            reason = str(found[0].get("ctx", {}).get("error", found[0]["msg"]))
            return cls(False, [{"pointer": "#", "detail": f"the body is not JSON: {reason}"}], 1)
        places = [
            {"pointer": _pointer(item["loc"]), "detail": item["msg"].removeprefix("Value error, ")[:_MOST_TEXT]}
            for item in found[:_MOST_ERRORS]
        ]
        return cls(True, places, len(found))


class UnsupportedMediaType(Exception):
    """A body of a media type that the operation does not accept."""

    def __init__(self, given: str, allowed: Sequence[str]) -> None:
        self.given, self.allowed = given, tuple(allowed)
        super().__init__(f"the content type is {errors.quoted(given)}; allowed: {', '.join(allowed)}")


def problem(
    request: Request, status: HTTPStatus, kind: str, detail: str, facts: Mapping[str, object] | None = None
) -> Response:
    """Return a problem as a response: its kind in words joined by `-`, a sentence on this occurrence, typed data."""
    content: dict[str, Any] = {
        "type": f"urn:gelenk:{kind}",
        "title": kind.replace("-", " ").capitalize(),
        "status": int(status),
        "detail": _printable(detail[:_MOST_TEXT]),
        "instance": request.url.path[:256],
        "request_id": request.scope.get("request_id"),
    }
    for key, value in (facts or {}).items():
        content.setdefault(key, _shortened(value))
    return Response(orjson.dumps(content, default=str), int(status), media_type=MEDIA_TYPE)


def status_of(error: type[errors.KinematicsError]) -> HTTPStatus:
    """Return the status of an error class: its own or its nearest ancestor's."""
    return next(STATUS[ancestor] for ancestor in error.__mro__ if ancestor in STATUS)


def install(app: FastAPI) -> None:
    """Answer every error of the application with a problem."""
    for kind in (
        *(errors.KinematicsError, InvalidPayload, ValidationError, RequestValidationError, UnsupportedMediaType),
        *(HTTPException, ClientDisconnect, Exception),
    ):
        app.add_exception_handler(kind, answer)


def answer(request: Request, error: Exception) -> Response:
    """Return the response to any error."""
    match error:
        case errors.KinematicsError():
            return _kinematics(request, error)
        case InvalidPayload():
            return _payload(request, error)
        case ValidationError() | RequestValidationError():
            return _payload(request, InvalidPayload.of(error))
        case UnsupportedMediaType():
            status, facts = HTTPStatus.UNSUPPORTED_MEDIA_TYPE, {"allowed": error.allowed}
            return problem(request, status, "unsupported-media-type", str(error), facts)
        case HTTPException():
            return _http(request, error)
        case ClientDisconnect():
            return Response(status_code=499)  # no client waits for it
    logger.error("unexpected error at %s %s", request.method, errors.quoted(request.url.path), exc_info=error)
    detail = "something went wrong in the service; see its log"
    return problem(request, HTTPStatus.INTERNAL_SERVER_ERROR, "internal-error", detail)


def _kinematics(request: Request, error: errors.KinematicsError) -> Response:
    facts = error.facts()
    if (pointer := _place(error)) is not None:
        facts["pointer"] = pointer
    response = problem(request, status_of(type(error)), errors.kind_of(type(error)), error.detail, facts)
    if (retry_after := facts.get("retry_after")) is not None:
        response.headers["Retry-After"] = str(retry_after)
        if not isinstance(error, errors.TooManyJobs):
            # The connection is read again after that time: see `connections`.
            request.scope.setdefault("state", {})["retry_after"] = retry_after
    elif response.status_code == HTTPStatus.SERVICE_UNAVAILABLE:
        response.headers["Retry-After"] = _LATER
    return response


def _payload(request: Request, error: InvalidPayload) -> Response:
    if not error.is_json:
        return problem(request, HTTPStatus.BAD_REQUEST, "malformed-json", str(error))
    first = f"{error.places[0]['pointer']}: {error.places[0]['detail']}" if error.places else str(error)
    more = f" (and {error.count - 1} more)" if error.count > 1 else ""
    facts = {"errors": error.places}
    return problem(request, HTTPStatus.UNPROCESSABLE_ENTITY, "invalid-payload", first + more, facts)


def _http(request: Request, error: HTTPException) -> Response:
    status = HTTPStatus(error.status_code)
    detail = str(error.detail)
    if status == HTTPStatus.NOT_FOUND:
        detail = "there is nothing at this path; /docs lists all paths"
    elif status == HTTPStatus.METHOD_NOT_ALLOWED:
        detail = f"{request.method} is not allowed here"
    kind = status.phrase.lower().replace(" ", "-").replace("'", "")
    response = problem(request, status, kind, detail)
    response.headers.update(error.headers or {})
    if status == HTTPStatus.METHOD_NOT_ALLOWED:
        response.headers["Allow"] = ", ".join(_allowed_methods(request))
    return response


def _allowed_methods(request: Request) -> list[str]:
    """Return the methods of all routes to a path; a single route knows only its own."""
    path = request.url.path.removeprefix(request.app.root_path)
    allowed = {method for pattern, method in _patterns() if pattern.fullmatch(path)}
    return sorted(allowed | ({"HEAD"} if "GET" in allowed else set()))


@cache
def _patterns() -> list[tuple[re.Pattern[str], str]]:
    return [(compile_path(f"/{route.path}")[0], route.method.upper()) for route in ROUTES.values()]


def _place(error: errors.KinematicsError) -> str | None:
    match error:
        case errors.InvalidUrdf():
            return "#/urdf"
        case errors.InvalidDhTable(joint=None):
            return "#/dh"
        case errors.InvalidDhTable(joint=joint, parameter=parameter):
            return f"#/dh/joints/{joint}" + (f"/{parameter}" if parameter else "")
        case errors.InvalidPose(field=("base" | "tool") as place, index=None):
            return f"#/dh/{place}"
        case errors.RepresentationSingularity():
            return f"#/joint_positions/{error.index}"
    index, field = getattr(error, "index", None), getattr(error, "field", None)
    if field is None:
        return None
    pointer = "#/" + field.replace(".", "/")  # segments.1.via
    return pointer if index is None else f"{pointer}/{index}"


def _pointer(location: Sequence[int | str]) -> str:
    parts = [str(part) for part in location if not str(part).startswith("<")]
    if parts[:1] == ["body"]:
        parts = parts[1:]
    escaped = [part.replace("~", "~0").replace("/", "~1")[:80] for part in parts]
    return "#/" + "/".join(escaped) if escaped else "#"


def _printable(text: str) -> str:
    return text if text.isprintable() else "".join(c if c.isprintable() else "�" for c in text)


def _shortened(value: Any) -> Any:
    if isinstance(value, str):
        return _printable(value[:_LONGEST_FACT])
    if isinstance(value, list | tuple):
        items = [_shortened(item) for item in value[:_MOST_NAMES]]
        while len(orjson.dumps(items)) > _MOST_BYTES:
            items = items[: len(items) // 2]
        return items
    if isinstance(value, dict):
        return {key: _shortened(item) for key, item in value.items()}
    return value
