"""Endpoints that return a robot in another notation: as a DH table, a product of exponentials, MJCF."""

from dataclasses import asdict
from typing import Annotated, Any, Literal, TypeAlias

from fastapi import Query, Response
from pydantic import Field
from starlette.datastructures import QueryParams

from gelenk.contract.common import ChainOptions, FrameName, Payload
from gelenk.contract.dh import Convention, SnapTolerance
from gelenk.contract.dh_from_urdf import FromUrdfOptions
from gelenk.dh.compare.of_chain import dh_of_chain
from gelenk.dh.tables.columns import COLUMNS, Column
from gelenk.dh.tables.screws import screws_of_chain
from gelenk.dh.written import TableFormat, identifier, written_table
from gelenk.errors import counted
from gelenk.http.messages.openapi import RobotPath, documentation
from gelenk.http.messages.payloads import BoundedRequest, JsonResponse, read_query
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.robots.meshes import SANDBOXED
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import Context, TaskRequest
from gelenk.kinematics.judge.mjcf import certify_mjcf
from gelenk.kinematics.judge.tables import certify_screws
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.language import Language, language as speaking
from gelenk.operations.dh_from_urdf import table_answer
from gelenk.robot.chain import crossed_joints
from gelenk.robot.formats.mjcf.writer import write_mjcf
from gelenk.store.records import LoadedRobot

_EXAMPLE_STEPS: dict[str, Any] = {"without": {"value": False}}
_ORDER: dict[str, Any] = {"as usual": {"value": list(COLUMNS)}}
_BASE: dict[str, Any] = {"panda": {"value": "panda_link0"}}
_TIP: dict[str, Any] = {"panda": {"value": "panda_link8"}}
_FILES: dict[TableFormat, tuple[str, str]] = {
    "csv": ("text/csv", "csv"),
    "latex": ("text/x-tex", "tex"),
    "matlab": ("text/x-matlab", "m"),
    "roboticstoolbox": ("text/x-python", "py"),
}
"""Media type and end of the name of each format of a table."""

WrittenAs: TypeAlias = Annotated[
    Literal["json", "csv", "latex", "matlab", "roboticstoolbox"],
    Field(description="`json`, or the text of the table for another program."),
]


class RobotTableOptions(FromUrdfOptions):
    """A chain, and how its table is written."""

    format: WrittenAs = "json"


class _MjcfOptions(Payload):
    meshes: bool = False


def export_routes(pool_client: PoolClient, max_body_bytes: int) -> list[DocumentedRoute]:
    """Return the routes of a stored robot in another notation: DH table, product of exponentials, MJCF."""

    def robot_table(
        robot: RobotPath,
        convention: Annotated[Convention, Query(openapi_examples={"modified": {"value": "modified"}})] = "standard",
        base_frame: Annotated[FrameName | None, Query(openapi_examples=_BASE)] = None,
        tip_frame: Annotated[FrameName | None, Query(openapi_examples=_TIP)] = None,
        snap_tolerance: Annotated[SnapTolerance, Query(openapi_examples={"exact": {"value": 0.0}})] = 0.0,
        format: Annotated[WrittenAs, Query(openapi_examples={"json": {"value": "json"}})] = "json",  # noqa: A002
        steps: Annotated[
            bool, Query(description="Whether to show how the frames are placed.", openapi_examples=_EXAMPLE_STEPS)
        ] = False,
        language: Annotated[
            Language, Query(description="Of `steps`.", openapi_examples={"en": {"value": "en"}})
        ] = "en",
        column_order: Annotated[
            list[Column] | None,
            Query(description="Of the table in `steps`; a, alpha, d, theta if left out.", openapi_examples=_ORDER),
        ] = None,
    ) -> Any: ...

    def robot_screws(
        robot: RobotPath,
        base_frame: Annotated[FrameName | None, Query(openapi_examples=_BASE)] = None,
        tip_frame: Annotated[FrameName | None, Query(openapi_examples=_TIP)] = None,
    ) -> Any: ...

    def robot_mjcf(
        robot: RobotPath,
        meshes: Annotated[
            bool,
            Query(
                description="Whether to name the mesh files that MuJoCo reads (STL, OBJ, MSH), by their paths below "
                "`…/meshes/`: fetch them beside the text. Left out otherwise, so that the text is whole by itself.",
                openapi_examples={"without": {"value": False}},
            ),
        ] = False,
    ) -> Any: ...

    async def get_table(request: BoundedRequest) -> Response:
        return await pool_client.answer(request, _robot_table, _task_request(request))

    async def get_screws(request: BoundedRequest) -> Response:
        return await pool_client.answer(request, _robot_screws, _task_request(request))

    async def get_mjcf(request: BoundedRequest) -> Response:
        return await pool_client.answer(request, _robot_mjcf, _task_request(request))

    return [
        DocumentedRoute(robot_table, get_table, max_body_bytes, **documentation("get_robot_dh")),
        DocumentedRoute(robot_screws, get_screws, max_body_bytes, **documentation("get_robot_screws")),
        DocumentedRoute(robot_mjcf, get_mjcf, max_body_bytes, **documentation("get_robot_mjcf")),
    ]


def _task_request(request: BoundedRequest) -> TaskRequest:
    return TaskRequest(robot=request.path_params["robot"], query=request.scope["query_string"].decode("latin-1"))


def _robot_table(context: Context, task_request: TaskRequest) -> Response:
    options = read_query(RobotTableOptions, QueryParams(task_request.query))
    loaded = context.library.get(task_request.robot)
    with speaking(options.language):
        if options.format != "json":
            return _table_file(loaded, options, options.format)
        return JsonResponse(table_answer(loaded.robot, options, loaded.warnings))


def _table_file(loaded: LoadedRobot, options: RobotTableOptions, kind: TableFormat) -> Response:
    chain = loaded.robot.chain(options.base_frame, options.tip_frame)
    table, _, certificate = dh_of_chain(loaded.robot, chain, options.convention, options.snap_tolerance)
    name = loaded.record.name
    remarks = (f"{name}, {chain.base_frame} to {chain.tip_frame}", certified(certificate))
    media_type, end = _FILES[kind]
    return Response(
        written_table(table, kind, name, remarks),
        media_type=media_type,
        headers={"Content-Disposition": f'attachment; filename="{identifier(name) if end == "m" else name}.{end}"'},
    )


def certified(certificate: PoseCertificate) -> str:
    """Return a certificate as a remark in a file, without an end."""
    return (
        f"against the robot through Pinocchio at {counted(certificate.samples, 'configuration')}: at most "
        f"{certificate.max_position_error:.2g} m and {certificate.max_orientation_error:.2g} rad off"
    )


def _robot_screws(context: Context, task_request: TaskRequest) -> Response:
    options = read_query(ChainOptions, QueryParams(task_request.query))
    robot = context.library.get(task_request.robot).robot
    chain = robot.chain(options.base_frame, options.tip_frame)
    found = screws_of_chain(chain.flat)
    joints = [
        {
            "name": joint.name,
            "type": "prismatic" if joint.type == "prismatic" else "revolute",
            "variable": chain.joint_names[variable],
            "multiplier": multiplier,
        }
        for joint, variable, multiplier in zip(
            crossed_joints(robot.description, chain), found.variables, found.multipliers, strict=True
        )
    ]
    return JsonResponse(
        {
            "joint_names": chain.joint_names,
            "base_frame": chain.base_frame,
            "tip_frame": chain.tip_frame,
            "home": {"matrix": found.home},
            "joints": joints,
            "space_screws": found.space,
            "body_screws": found.body,
            "certificate": asdict(certify_screws(robot, chain, found)),
        }
    )


def _robot_mjcf(context: Context, task_request: TaskRequest) -> Response:
    options = read_query(_MjcfOptions, QueryParams(task_request.query))
    loaded = context.library.get(task_request.robot)
    description = loaded.robot.description
    named = {mesh: path for mesh, path in loaded.meshes.items() if path is not None}
    plain = write_mjcf(description)
    remarks = f"{loaded.record.name}: {certified(certify_mjcf(loaded.robot, plain))}"
    text = write_mjcf(description, named if options.meshes else None, remarks)
    return Response(text, media_type="application/xml", headers=SANDBOXED)
