"""Conversions of Denavit-Hartenberg tables: to URDF, from URDF, from one convention to the other."""

from collections.abc import Callable
from dataclasses import asdict
from typing import Annotated, Any

from fastapi import Query
from starlette.datastructures import QueryParams
from starlette.responses import Response

from gelenk.api.errand import Desk, Inquiry, JsonErrand
from gelenk.api.openapi import RobotPath, json_example, problem_responses
from gelenk.api.payloads import BoundedRequest, json_response, read_query
from gelenk.api.remote import Remote, json_handler
from gelenk.api.routes import DocumentedRoute, Handler
from gelenk.contract.common import FrameName
from gelenk.contract.dh import (
    EXAMPLE_TABLE,
    EXAMPLE_URDF,
    Convention,
    ConvertAnswer,
    ConvertRequest,
    FromUrdfAnswer,
    FromUrdfOptions,
    FromUrdfRequest,
    SnapTolerance,
    ToUrdfAnswer,
    ToUrdfRequest,
    table_content,
)
from gelenk.kinematics.certify import certify_conversion, certify_table
from gelenk.kinematics.dh_of_chain import dh_of_chain
from gelenk.model.appearance import INVENTED_MASSES
from gelenk.model.convert import BASE_FRAME, TOOL_FRAME, converted, describe_dh
from gelenk.model.description import MOVABLE, Description
from gelenk.model.errors import listed
from gelenk.model.robot import Robot
from gelenk.model.urdf import UNLIMITED, read_urdf, write_urdf

TAG = "DH tables"


def dh_routes(remote: Remote, max_body_bytes: int) -> list[DocumentedRoute]:
    """The conversions, none on the event loop: building a robot takes milliseconds."""

    def table_to_urdf(call: ToUrdfRequest) -> ToUrdfAnswer:
        """Writes a table as URDF, to 17 significant digits, with simple visual bodies.

        Both conventions, revolute and prismatic joints, base, tool, offsets and limits. The URDF is read back and
        recomputed through Pinocchio before it is sent. Masses are invented, and a velocity or effort that is not given
        is written as one that no joint reaches; `notes` say so.
        """
        raise NotImplementedError

    def table_from_urdf(call: FromUrdfRequest) -> FromUrdfAnswer:
        """Finds the table of any serial chain of a robot from the geometry of its axes.

        Axes in any direction, fixed joints between them, continuous, prismatic and mimic joints, and chains that lead
        up the tree are all supported: base and tool absorb what the rows cannot express. A table is not unique; `notes`
        lists what was chosen where the convention leaves a choice.

        The common normal of nearly parallel axes can be kilometres away, as where a description writes π as 3.1416.
        Where a length would be beyond ten times the reach, such axes are taken as parallel if that costs less than
        1e-5 m and 1e-4 rad: the first of `notes` names them and the cost. Otherwise it says why the length is so large.
        """
        raise NotImplementedError

    def convert_table(call: ConvertRequest) -> ConvertAnswer:
        """Writes a table in the other convention, exactly: α and a move by one row, base and tool absorb the rest."""
        raise NotImplementedError

    def robot_table(
        robot: RobotPath,
        convention: Annotated[Convention, Query(openapi_examples={"modified": {"value": "modified"}})] = "standard",
        base_frame: Annotated[FrameName | None, Query(openapi_examples={"panda": {"value": "panda_link0"}})] = None,
        tip_frame: Annotated[FrameName | None, Query(openapi_examples={"panda": {"value": "panda_link8"}})] = None,
        snap_tolerance: Annotated[SnapTolerance, Query(openapi_examples={"exact": {"value": 0.0}})] = 0.0,
    ) -> FromUrdfAnswer:
        """The table of a chain of this robot, as `from-urdf` finds it; the default chain where no frame is named."""
        raise NotImplementedError

    async def get_table(request: BoundedRequest) -> Response:
        inquiry = Inquiry(robot=request.path_params["robot"], query=request.scope["query_string"].decode("latin-1"))
        return await remote.answer(request, _robot_table, inquiry)

    def post(path: str, endpoint: Callable[..., Any], handler: Handler, **documentation: Any) -> DocumentedRoute:
        return dh_route(f"/v1/dh/{path}", endpoint, handler, max_body_bytes, **documentation)

    return [
        post(
            "to-urdf",
            table_to_urdf,
            json_handler(JsonErrand(ToUrdfRequest, _to_urdf), remote),
            operation_id="dh_to_urdf",
            summary="Table → URDF",
            example={"name": "my_arm", "dh": EXAMPLE_TABLE},
        ),
        post(
            "from-urdf",
            table_from_urdf,
            json_handler(JsonErrand(FromUrdfRequest, _from_urdf), remote),
            operation_id="dh_from_urdf",
            summary="URDF → table",
            example={"urdf": EXAMPLE_URDF, "tip_frame": "hand", "snap_tolerance": 1e-5},
        ),
        post(
            "convert",
            convert_table,
            json_handler(JsonErrand(ConvertRequest, _convert), remote),
            operation_id="convert_dh",
            summary="Standard ↔ modified",
            example={"dh": EXAMPLE_TABLE, "convention": "standard"},
        ),
        DocumentedRoute(
            "/v1/robots/{robot}/dh",
            robot_table,
            get_table,
            max_body_bytes,
            methods=["GET"],
            operation_id="get_robot_dh",
            summary="A robot's chain as a table",
            tags=[TAG],
            responses=problem_responses(404, 422),
        ),
    ]


def dh_route(
    path: str,
    endpoint: Callable[..., Any],
    handler: Handler,
    max_body_bytes: int,
    example: dict[str, Any],
    **documentation: Any,
) -> DocumentedRoute:
    """A POST on tables, documented by its endpoint and by a runnable example."""
    return DocumentedRoute(
        path,
        endpoint,
        handler,
        max_body_bytes,
        methods=["POST"],
        tags=[TAG],
        responses=problem_responses(400, 404, 413, 415, 422),
        openapi_extra={"requestBody": {"content": json_example(example)}},
        **documentation,
    )


def _to_urdf(call: ToUrdfRequest) -> dict[str, Any]:
    table = call.dh.table()
    described = describe_dh(call.name, table)
    urdf = write_urdf(described)
    robot = Robot(read_urdf(urdf), (BASE_FRAME, TOOL_FRAME))
    certificate = certify_table(robot, robot.chain(None, None), table)
    return {
        "urdf": urdf,
        "joint_names": table.variables,
        "certificate": asdict(certificate),
        "notes": _notes(described),
        "warnings": described.warnings,
    }


def _notes(described: Description) -> list[str]:
    """What a description says that its table did not."""
    notes = [INVENTED_MASSES]
    for key in ("velocity", "effort"):
        names = tuple(
            joint.name for joint in described.joints if joint.type in MOVABLE and not getattr(joint.limits, key)
        )
        if names:
            notes.append(
                f"no {key} limit is given for {listed(names)}: URDF wants one, and {UNLIMITED:g} stands for none"
            )
    return notes


def _from_urdf(call: FromUrdfRequest) -> dict[str, Any]:
    description = read_urdf(call.urdf, call.strict)
    return _table_answer(Robot(description), call, description.warnings)


def _robot_table(desk: Desk, inquiry: Inquiry) -> Response:
    options, loaded = read_query(FromUrdfOptions, QueryParams(inquiry.query)), desk.library.get(inquiry.robot)
    return json_response(_table_answer(loaded.robot, options, loaded.warnings))


def _table_answer(robot: Robot, options: FromUrdfOptions, warnings: tuple[str, ...]) -> dict[str, Any]:
    chain = robot.chain(options.base_frame, options.tip_frame)
    table, notes, certificate = dh_of_chain(robot, chain, options.convention, options.snap_tolerance)
    return {
        "dh": table_content(table),
        "joint_names": table.variables,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "certificate": asdict(certificate),
        "notes": notes,
        "warnings": warnings,
    }


def _convert(call: ConvertRequest) -> dict[str, Any]:
    table = call.dh.table()
    other = converted(table, call.convention)
    return {
        "dh": table_content(other),
        "joint_names": other.variables,
        "certificate": asdict(certify_conversion(table, other)),
    }
