"""The course's calculators: POST /v1/course/…, each a request in, an answer out, and nothing kept."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from starlette.responses import Response

from gelenk.api.errand import Errand, JsonErrand
from gelenk.api.openapi import json_example, picture_content, problem_responses
from gelenk.api.payloads import JSON, PNG, SVG, json_response, read_json
from gelenk.api.remote import Remote, json_handler
from gelenk.api.routes import DocumentedRoute
from gelenk.contract.common import Payload

TAG = "Course"

_Request = TypeVar("_Request", bound=Payload)


@dataclass(frozen=True, slots=True)
class Picture(Generic[_Request]):
    """What a calculator draws of a request.

    Attributes:
        description: What it shows.
        draw: The bytes of an SVG or a PNG; of a module.
    """

    description: str
    draw: Callable[[_Request, Literal["svg", "png"]], bytes]


def never(_: Payload) -> bool:
    """That no request of few bytes is heavy: so it is with most calculators."""
    return False


def course_route(
    path: str,
    endpoint: Callable[..., Any],
    model: type[_Request],
    compute: Callable[[_Request], Any],
    remote: Remote,
    max_body_bytes: int,
    *,
    errand: Errand | None = None,
    example: dict[str, Any],
    is_heavy: Callable[[_Request], bool] = never,
    statuses: tuple[int, ...] = (400, 413, 415, 422),
    picture: Picture[_Request] | None = None,
    **documentation: Any,
) -> DocumentedRoute:
    """POST /v1/course/{path}, documented by its endpoint and by a runnable example.

    Args:
        path: Last part of the path.
        endpoint: Never called: its signature names the models, its docstring is the description.
        model: What the calculator takes.
        compute: The calculation, of a module; its result is what `json_response` takes.
        remote: Who works on a large or heavy request, and draws.
        max_body_bytes: Largest body.
        errand: What is done of such a request, where it is not that calculation.
        example: A request that runs.
        is_heavy: Whether a request of few bytes is still work of more than a millisecond.
        statuses: Of the problems it may answer with.
        picture: What it draws where an image is accepted instead of JSON.
        documentation: `operation_id` and `summary`.
    """
    errand = errand or JsonErrand(model, compute, None if picture is None else picture.draw)

    def quick(body: bytes) -> Response | None:
        call = read_json(model, body)
        return None if is_heavy(call) else json_response(compute(call))

    return DocumentedRoute(
        f"/v1/course/{path}",
        endpoint,
        json_handler(errand, remote, (JSON, SVG, PNG) if picture else (JSON,), quick),
        max_body_bytes,
        methods=["POST"],
        tags=[TAG],
        responses={
            **({200: {"content": picture_content(picture.description)}} if picture else {}),
            **problem_responses(*statuses),
        },
        openapi_extra={"requestBody": {"content": json_example(example)}},
        **documentation,
    )
