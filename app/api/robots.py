"""Robots: listed, described, added, replaced, removed; their URDF and their meshes."""

import os
from collections.abc import Callable
from concurrent.futures import Executor
from typing import Annotated, Any

from fastapi import APIRouter, Path, Response
from starlette.background import BackgroundTask
from starlette.datastructures import UploadFile
from starlette.responses import StreamingResponse

from app.api.openapi import RobotPath, UploadedRobotPath, json_example, problem_responses
from app.api.payloads import JSON, BoundedRequest, json_response, read_json
from app.api.problems import UnsupportedMediaType
from app.api.routes import DocumentedRoute, in_thread
from app.model.chain import Chain
from app.model.description import Joint
from app.model.errors import InvalidArchive, KinematicsError, UnknownMesh
from app.schemas.common import ChainEnds
from app.schemas.dh import DhTablePayload, table_content
from app.schemas.pose import Pose
from app.schemas.robots import (
    EXAMPLE_DH,
    ArchiveReplacement,
    JointInfo,
    LimitsInfo,
    MeshInfo,
    MimicInfo,
    NewArchive,
    NewRobot,
    RobotInfo,
    RobotList,
    RobotReplacement,
    RobotSummary,
)
from app.store.archive import unpacked
from app.store.library import Library, RobotUpload
from app.store.records import LoadedRobot, Record

MULTIPART = "multipart/form-data"
SANDBOXED = {"Content-Security-Policy": "default-src 'none'; sandbox", "X-Content-Type-Options": "nosniff"}
"""Files that came from outside: shown by no browser as a page of ours."""
_PIECE = 256 * 1024
_MESH_TYPES = {
    ".stl": "model/stl",
    ".obj": "model/obj",
    ".dae": "model/vnd.collada+xml",
    ".mtl": "model/mtl",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
}


def robots_router(library: Library) -> APIRouter:
    """What only reads robots."""
    router = APIRouter(prefix="/v1/robots", tags=["Robots"])

    @router.get("", operation_id="list_robots", summary="All robots", response_model=RobotList)
    def list_robots() -> Any:
        """The catalogue's robots, then the uploaded ones, each part by name."""
        summaries = (_summary(library, record) for record in library.records())
        return {"robots": [summary for summary in summaries if summary is not None]}

    @router.get(
        "/{robot}",
        operation_id="get_robot",
        summary="A robot",
        response_model=RobotInfo,
        responses=problem_responses(404, 422),
    )
    def get_robot(robot: RobotPath) -> Any:
        """Joints, links, frames, chains, licence, and what is odd about the description."""
        return info(library.get(robot))

    @router.get(
        "/{robot}/urdf",
        operation_id="get_robot_urdf",
        summary="A robot's URDF",
        response_class=Response,
        responses={200: {"content": {"application/xml": {}}, "description": "The URDF"}, **problem_responses(404, 422)},
    )
    def get_urdf(robot: RobotPath) -> Response:
        """The description as it was uploaded, or as it was written from the DH table."""
        return Response(library.get(robot).urdf, media_type="application/xml", headers=SANDBOXED)

    @router.get(
        "/{robot}/meshes/{path:path}",
        operation_id="get_robot_mesh",
        summary="A mesh file of a robot",
        response_class=Response,
        responses={
            200: {"content": {kind: {} for kind in _MESH_TYPES.values()}, "description": "The file"},
            **problem_responses(404, 422),
        },
    )
    def get_mesh(
        robot: RobotPath,
        path: Annotated[
            str,
            Path(
                description="As `meshes` of the robot lists it.",
                openapi_examples={
                    "link0": {"value": "example-robot-data/robots/panda_description/meshes/visual/link0.dae"}
                },
            ),
        ],
    ) -> Response:
        """The file as it came; nothing on the server has ever looked into it."""
        file = library.mesh(robot, path)
        try:
            stream = file.open("rb")  # once open, it is there to its end, whoever replaces the robot meanwhile
        except FileNotFoundError:
            raise UnknownMesh(path) from None
        headers = {**SANDBOXED, "Content-Length": str(os.fstat(stream.fileno()).st_size)}
        return StreamingResponse(
            iter(lambda: stream.read(_PIECE), b""),
            media_type=_MESH_TYPES[file.suffix.lower()],
            headers=headers,
            background=BackgroundTask(stream.close),
        )

    @router.delete(
        "/{robot}",
        operation_id="remove_robot",
        summary="Remove an uploaded robot",
        status_code=204,
        responses=problem_responses(403, 404, 503, 507),
    )
    def remove_robot(robot: UploadedRobotPath) -> Response:
        """Gone for every worker at once. A robot of the catalogue is read-only."""
        library.remove(robot)
        return Response(status_code=204)

    return router


def upload_routes(library: Library, executor: Executor, max_body_bytes: int) -> list[DocumentedRoute]:
    """What writes robots: as JSON, or as a zip in a form."""

    async def add(request: BoundedRequest) -> Response:
        def keep(upload: RobotUpload) -> Response:
            created = library.add(upload)
            location = {"Location": f"{request.scope.get('root_path', '')}/v1/robots/{upload.name}"}
            return json_response(
                info(library.get(upload.name)).model_dump(mode="json"), 201 if created else 200, location
            )

        return await _receive(request, None, keep, executor)

    async def replace(request: BoundedRequest) -> Response:
        def keep(upload: RobotUpload) -> Response:
            library.replace(upload)
            return json_response(info(library.get(upload.name)).model_dump(mode="json"))

        return await _receive(request, request.path_params["robot"], keep, executor)

    def add_robot(robot: NewRobot) -> RobotInfo:
        """Adds a URDF (xacro expanded), a DH table, or, as a form, a zip of one URDF and its meshes.

        The answer comes when the robot is safely on disk; every worker sees it at once. The same robot under the
        same name again is 200, another one 409; a default chain with an unknown frame is 404. What is odd but
        harmless is accepted and listed in `warnings`.
        """
        raise NotImplementedError

    def replace_robot(robot: UploadedRobotPath, content: RobotReplacement) -> RobotInfo:
        """Puts another robot in the place of an uploaded one; at any moment there is the old one or the new one."""
        raise NotImplementedError

    return [
        DocumentedRoute(
            "/v1/robots",
            add_robot,
            add,
            max_body_bytes,
            methods=["POST"],
            operation_id="add_robot",
            summary="Add a robot",
            tags=["Robots"],
            status_code=201,
            responses={
                200: {"model": RobotInfo, "description": "It was there"},
                **problem_responses(400, 404, 409, 413, 415, 422, 503, 507),
            },
            openapi_extra={"requestBody": {"content": {**json_example(EXAMPLE_DH), **_form(NewArchive)}}},
        ),
        DocumentedRoute(
            "/v1/robots/{robot}",
            replace_robot,
            replace,
            max_body_bytes,
            methods=["PUT"],
            operation_id="replace_robot",
            summary="Replace an uploaded robot",
            tags=["Robots"],
            responses=problem_responses(400, 403, 404, 413, 415, 422, 503, 507),
            openapi_extra={
                "requestBody": {
                    "content": {
                        **json_example({key: EXAMPLE_DH[key] for key in ("description", "dh")}),
                        **_form(ArchiveReplacement),
                    }
                }
            },
        ),
    ]


async def _receive(
    request: BoundedRequest,
    name: str | None,
    keep: Callable[[RobotUpload], Response],
    executor: Executor,
) -> Response:
    """Read an upload in either form, and keep it in a thread."""
    given = request.media_type
    if given == JSON:
        body = await request.body()
        return await in_thread(executor, lambda: keep(_from_json(body, name)))
    if given != MULTIPART:
        raise UnsupportedMediaType(given, (JSON, MULTIPART))
    async with request.form(max_files=1, max_fields=8, max_part_size=64 * 1024) as form:
        archive = form.get("archive")
        fields = {key: value for key, value in form.multi_items() if key != "archive"}
        text = (NewArchive if name is None else ArchiveReplacement).model_validate(fields)
        if not isinstance(archive, UploadFile):
            raise InvalidArchive("the form must have a file in the field `archive`")

        def unpack_and_keep() -> Response:
            with unpacked(archive.file) as content:
                upload = RobotUpload(
                    name=text.name if isinstance(text, NewArchive) else name or "",
                    format="urdf",
                    model=content.urdf,
                    description=text.description,
                    default_chain=text.ends(),
                    meshes=content.meshes,
                    urdf_folder=content.urdf_folder,
                )
                return keep(upload)

        return await in_thread(executor, unpack_and_keep)


def _from_json(body: bytes, name: str | None) -> RobotUpload:
    robot = read_json(NewRobot if name is None else RobotReplacement, body)
    name = robot.name if isinstance(robot, NewRobot) else name or ""
    if robot.dh is not None:
        model = robot.dh.model_dump_json(exclude_none=True, indent=2).encode() + b"\n"
        return RobotUpload(name, "dh", model, robot.description, robot.default_chain)
    urdf = (robot.urdf or "").encode("utf-8", "surrogatepass")
    return RobotUpload(name, "urdf", urdf, robot.description, robot.default_chain)


def info(loaded: LoadedRobot) -> RobotInfo:
    """Everything about a robot but its poses."""
    record, robot = loaded.record, loaded.robot
    description = robot.description
    chain: Chain = robot.chain(None, None)
    return RobotInfo(
        name=record.name,
        description=record.file.description,
        source=record.source,
        format=record.file.format,
        default_chain=ChainEnds(base_frame=chain.base_frame, tip_frame=chain.tip_frame),
        chains=record.file.chains,
        root=description.root,
        joints=[_joint(joint) for joint in description.joints],
        joint_names=list(chain.joint_names),
        dh=None if loaded.table is None else DhTablePayload.model_validate(table_content(loaded.table)),
        degrees_of_freedom=len(description.movable),
        links=list(description.frames),
        frames=list(description.frames),
        leaf_tips=list(description.leaves),
        meshes=[MeshInfo(reference=reference, path=path) for reference, path in loaded.meshes.items()],
        licence=record.file.licence,
        provenance=record.file.source,
        warnings=list(loaded.warnings),
    )


def _joint(joint: Joint) -> JointInfo:
    mimic = joint.mimic
    return JointInfo(
        name=joint.name,
        type=joint.type,
        parent=joint.parent,
        child=joint.child,
        origin=Pose(position=list(joint.origin.xyz), rpy=list(joint.origin.rpy)),
        axis=None if joint.type in {"fixed", "floating"} else list(joint.axis),
        limits=LimitsInfo(
            lower=joint.limits.lower,
            upper=joint.limits.upper,
            velocity=joint.limits.velocity,
            effort=joint.limits.effort,
        ),
        mimic=MimicInfo(joint=mimic.joint, multiplier=mimic.multiplier, offset=mimic.offset) if mimic else None,
    )


def _summary(library: Library, record: Record) -> RobotSummary | None:
    """A robot in the list; None where a folder dropped in by hand is no robot (asked for by name it says why)."""
    ends = record.file.default_chain
    if ends is None:
        try:
            base_frame, tip_frame = library.get(record.name).robot.default_chain
        except (KinematicsError, OSError):
            return None
        ends = ChainEnds(base_frame=base_frame, tip_frame=tip_frame)
    return RobotSummary(
        name=record.name,
        description=record.file.description,
        source=record.source,
        format=record.file.format,
        default_chain=ends,
    )


def _form(fields: type[ArchiveReplacement]) -> dict[str, Any]:
    """A form with these fields and an archive, as a further content of a request."""
    schema = fields.model_json_schema()
    schema["properties"]["archive"] = {
        "type": "string",
        "format": "binary",
        "description": "Zip of one URDF and its meshes.",
    }
    schema["required"] = [*schema.get("required", []), "archive"]
    return {MULTIPART: {"schema": schema}}
