"""The DH table of a robot's chain: GET /v1/robots/{robot}/dh."""

from typing import Annotated, Any

from fastapi import Query
from starlette.datastructures import QueryParams
from starlette.responses import Response

from gelenk.contract.common import FrameName
from gelenk.contract.dh import Convention, SnapTolerance
from gelenk.contract.dh_from_urdf import FromUrdfOptions
from gelenk.http.messages.openapi import RobotPath, documentation
from gelenk.http.messages.payloads import BoundedRequest, json_response, read_query
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.workers.context import Context
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import TaskRequest
from gelenk.operations.dh_from_urdf import table_answer


def table_route(pool_client: PoolClient, max_body_bytes: int) -> DocumentedRoute:
    """Return the route; workers compute the tables, not the event loop."""

    def robot_table(
        robot: RobotPath,
        convention: Annotated[Convention, Query(openapi_examples={"modified": {"value": "modified"}})] = "standard",
        base_frame: Annotated[FrameName | None, Query(openapi_examples={"panda": {"value": "panda_link0"}})] = None,
        tip_frame: Annotated[FrameName | None, Query(openapi_examples={"panda": {"value": "panda_link8"}})] = None,
        snap_tolerance: Annotated[SnapTolerance, Query(openapi_examples={"exact": {"value": 0.0}})] = 0.0,
    ) -> Any: ...

    async def get_table(request: BoundedRequest) -> Response:
        task_request = TaskRequest(
            robot=request.path_params["robot"], query=request.scope["query_string"].decode("latin-1")
        )
        return await pool_client.answer(request, _robot_table, task_request)

    return DocumentedRoute(robot_table, get_table, max_body_bytes, **documentation("get_robot_dh"))


def _robot_table(context: Context, task_request: TaskRequest) -> Response:
    options = read_query(FromUrdfOptions, QueryParams(task_request.query))
    loaded = context.library.get(task_request.robot)
    return json_response(table_answer(loaded.robot, options, loaded.warnings))
