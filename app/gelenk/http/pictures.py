"""Endpoints of the course's pictures: their list, and each as SVG, PNG or PDF; and the DH parameters on two links."""

from typing import Annotated, Any

import orjson
from fastapi import APIRouter, Path, Query, Request
from starlette.datastructures import QueryParams
from starlette.responses import Response

from gelenk.contract.dh import Convention
from gelenk.contract.dh_picture import ClassicPicture, two_links
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.endpoints import BY_NAME
from gelenk.errors import UnknownPicture
from gelenk.http.dispatch import answer
from gelenk.http.messages.openapi import PLANAR_2R, documentation
from gelenk.http.messages.payloads import PICTURES, BoundedRequest, JsonResponse, preferred_type, read_query
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.language import Language, language, translated
from gelenk.plots.course.titles import CALCULATED, TITLES

PicturePath = Annotated[
    str, Path(description="Name of a picture.", openapi_examples={"joint-pairs": {"value": "joint-pairs"}})
]
LanguageQuery = Annotated[
    Language, Query(description="Of the texts: English or German.", openapi_examples={"German": {"value": "de"}})
]


def pictures_router(pool_client: PoolClient) -> APIRouter:
    """Return the router of the course's pictures; a worker draws them."""
    router = APIRouter()

    @router.api_route(**documentation("list_pictures"))
    async def list_pictures(language: LanguageQuery = "en") -> Response:
        return JsonResponse({"pictures": _listed(language)})

    @router.api_route(**documentation("get_picture"))
    async def get_picture(request: Request, picture: PicturePath, language: LanguageQuery = "en") -> Response:
        wanted = preferred_type(",".join(request.headers.getlist("Accept")), (*PICTURES,))
        if picture in CALCULATED:
            return await pool_client.answer(request, answer, _example(CALCULATED[picture][0], language, wanted))
        if picture not in TITLES:
            raise UnknownPicture(picture, (*TITLES, *CALCULATED))
        task_request = TaskRequest(query=f"picture={picture}&language={language}", wanted=wanted)
        return await pool_client.answer(request, _drawn, task_request)

    return router


def _listed(code: Language) -> list[dict[str, str]]:
    with language(code):
        titles = TITLES | {name: title for name, (_, title) in CALCULATED.items()}
        return [{"name": name, "title": translated(title)} for name, title in sorted(titles.items())]


def _example(name: str, code: Language, wanted: str) -> TaskRequest:
    """Return the example of an endpoint, of one on a robot that on the two-link arm, as a request for its picture."""
    endpoint = BY_NAME[name]
    robot, example = "", endpoint.example
    if isinstance(endpoint, RobotEndpoint):
        robot, example = "planar_2r", PLANAR_2R[name]["request"]
    body = orjson.dumps(example | {"language": code})
    return TaskRequest(buffers([body]), robot, wanted=wanted, endpoint=name)


def _drawn(_: Context, task_request: TaskRequest) -> Response:
    """Draw a picture, in a worker."""
    from gelenk.plots.course.gallery import gallery_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    query, wanted = QueryParams(task_request.query), task_request.wanted
    with language("de" if query["language"] == "de" else "en"):
        figure = gallery_figure(query["picture"])
    return Response(as_bytes(figure, PICTURES[wanted]), media_type=wanted)


def picture_route(pool_client: PoolClient, max_body_bytes: int) -> DocumentedRoute:
    """Return the route of the picture, which a worker draws."""

    def classic(
        convention: Annotated[Convention, Query(openapi_examples={"modified": {"value": "modified"}})] = "standard",
        language: Annotated[
            Language, Query(description="Of the title.", openapi_examples={"German": {"value": "de"}})
        ] = "en",
    ) -> Any: ...

    async def draw(request: BoundedRequest) -> Response:
        chosen = read_query(ClassicPicture, QueryParams(request.scope["query_string"].decode("latin-1")))
        body = orjson.dumps({**two_links(chosen.convention), "language": chosen.language})
        wanted = request.preferred((*PICTURES,))
        task_request = TaskRequest(buffers([body]), wanted=wanted, endpoint="dh_picture")
        return await pool_client.answer(request, answer, task_request)

    return DocumentedRoute(classic, draw, max_body_bytes, **documentation("get_dh_picture"))
