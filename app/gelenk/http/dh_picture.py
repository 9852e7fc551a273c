"""The picture of the DH parameters on the two links of the lecture."""

from typing import Annotated, Any

import orjson
from fastapi import Query
from starlette.datastructures import QueryParams
from starlette.responses import Response

from gelenk.contract.dh import Convention
from gelenk.contract.dh_picture import ClassicPicture, two_links
from gelenk.http.dispatch import answer
from gelenk.http.messages.openapi import documentation
from gelenk.http.messages.payloads import PNG, SVG, BoundedRequest, read_query
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import TaskRequest, buffers
from gelenk.language import Language


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
        wanted = request.preferred((SVG, PNG))
        task_request = TaskRequest(buffers([body]), wanted=wanted, endpoint="dh_picture")
        return await pool_client.answer(request, answer, task_request)

    return DocumentedRoute(classic, draw, max_body_bytes, **documentation("get_dh_picture"))
