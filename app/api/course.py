"""The course's calculators: POST /v1/course/…, each a request in, an answer out, and nothing kept."""

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

from starlette.responses import Response

from app.api.openapi import json_example, picture_content, problem_responses
from app.api.payloads import JSON, PNG, SVG, BoundedRequest, json_response, read_json
from app.api.problems import UnsupportedMediaType
from app.api.routes import INLINE_BYTES, DocumentedRoute, Handler, in_thread
from app.model.errors import InvalidField
from app.schemas.common import Payload

TAG = "Course"

_Request = TypeVar("_Request", bound=Payload)


@dataclass(frozen=True, slots=True)
class Picture(Generic[_Request]):
    """What a calculator draws of a request.

    Attributes:
        description: What it shows.
        draw: The bytes of an SVG or a PNG.
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
    executor: Executor,
    max_body_bytes: int,
    *,
    example: dict[str, Any],
    is_heavy: Callable[[_Request], bool] = never,
    statuses: tuple[int, ...] = (400, 413, 415, 422),
    picture: Picture[_Request] | None = None,
    **documentation: Any,
) -> DocumentedRoute:
    """POST /v1/course/{path}, documented by its endpoint and by an example that runs as it stands.

    Args:
        path: Last part of the path.
        endpoint: Never called: its signature names the models, its docstring is the description.
        model: What the calculator takes.
        compute: The calculation; its result is what `json_response` takes.
        executor: Where a large or heavy request is worked on.
        max_body_bytes: Largest body.
        example: A request that runs.
        is_heavy: Whether a request of few bytes is still work of more than a millisecond.
        statuses: Of the problems it may answer with.
        picture: What it draws where an image is accepted instead of JSON.
        documentation: `operation_id` and `summary`.
    """
    return DocumentedRoute(
        f"/v1/course/{path}",
        endpoint,
        _handler(model, compute, executor, is_heavy, picture),
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


def _handler(
    model: type[_Request],
    compute: Callable[[_Request], Any],
    executor: Executor,
    is_heavy: Callable[[_Request], bool],
    picture: Picture[_Request] | None,
) -> Handler:
    """What reads a JSON request and answers it: on the event loop where that is quick, else in a thread."""

    def drawn(body: bytes, wanted: str, draw: Callable[[_Request, Literal["svg", "png"]], bytes]) -> Response:
        return Response(draw(read_json(model, body), "svg" if wanted == SVG else "png"), media_type=wanted)

    async def handle(request: BoundedRequest) -> Response:
        if request.media_type != JSON:
            raise UnsupportedMediaType(request.media_type, (JSON,))
        if request.scope["query_string"]:
            raise InvalidField("query", "this call has its parameters as fields of the body")
        wanted, body = request.preferred((JSON, SVG, PNG)) if picture else JSON, await request.body()
        if picture and wanted != JSON:
            draw = picture.draw
            return await in_thread(executor, lambda: drawn(body, wanted, draw))
        if len(body) > INLINE_BYTES:
            return await in_thread(executor, lambda: json_response(compute(read_json(model, body))))
        call = read_json(model, body)
        if is_heavy(call):
            return await in_thread(executor, lambda: json_response(compute(call)))
        return json_response(compute(call))

    return handle
