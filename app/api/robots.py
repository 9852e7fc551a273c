"""Robots: listed, described, added, replaced, removed; their URDF and their meshes."""

import asyncio
import os
import time
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path as FilePath
from typing import IO, Annotated, Any

from fastapi import APIRouter, Path, Request, Response
from starlette.background import BackgroundTask
from starlette.datastructures import UploadFile
from starlette.responses import StreamingResponse

from app.api.errand import Desk, Inquiry, buffers
from app.api.openapi import BY_THE_CREW, RobotPath, UploadedRobotPath, json_example, problem_responses, without_null
from app.api.payloads import JSON, BoundedRequest, json_response, read_json
from app.api.problems import UnsupportedMediaType
from app.api.remote import Remote
from app.api.routes import DocumentedRoute
from app.api.skeleton import skeleton_of
from app.model.chain import Chain
from app.model.description import Joint
from app.model.errors import InvalidArchive, UnknownMesh
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
)
from app.store.archive import unpacked
from app.store.folders import open_plain, writing
from app.store.library import Library, RobotUpload
from app.store.records import LoadedRobot

MULTIPART = "multipart/form-data"
WITHOUT_KEY = "clients without a key"
"""Whose an upload without a key is: addresses change, and where no key is needed all share one machine."""
SANDBOXED = {"Content-Security-Policy": "default-src 'none'; sandbox", "X-Content-Type-Options": "nosniff"}
"""Files that came from outside: shown by no browser as a page of ours."""
_PIECE = 256 * 1024
_LIST_SECONDS = 5.0
"""How long the list of robots is good for, where nothing says that it has changed."""
_MESH_TYPES = {
    ".stl": "model/stl",
    ".obj": "model/obj",
    ".dae": "model/vnd.collada+xml",
    ".mtl": "model/mtl",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
}


def robots_router(library: Library, remote: Remote) -> APIRouter:
    """What reads robots, or removes them: the crew looks at them, because a description comes from outside."""
    router = APIRouter(prefix="/v1/robots", tags=["Robots"])
    listed = Listed(library, remote)

    @router.get(
        "",
        operation_id="list_robots",
        summary="All robots",
        response_model=RobotList,
        responses=problem_responses(*BY_THE_CREW),
    )
    async def list_robots(request: Request) -> Any:
        """The catalogue's robots, then the uploaded ones, each part by name."""
        return await listed.answer(request)

    @router.get(
        "/{robot}",
        operation_id="get_robot",
        summary="A robot",
        response_model=RobotInfo,
        responses=problem_responses(404, 422, *BY_THE_CREW),
    )
    async def get_robot(robot: RobotPath, request: Request) -> Any:
        """Joints, links, frames, chains, licence, and what is odd about the description."""
        return await remote.answer(request, _described, Inquiry(robot=robot))

    @router.get(
        "/{robot}/urdf",
        operation_id="get_robot_urdf",
        summary="A robot's URDF",
        response_class=Response,
        responses={
            200: {"content": {"application/xml": {}}, "description": "The URDF"},
            **problem_responses(404, 422, *BY_THE_CREW),
        },
    )
    async def get_urdf(robot: RobotPath, request: Request) -> Response:
        """The description as it was uploaded, or as it was written from the DH table."""
        return await remote.answer(request, _urdf, Inquiry(robot=robot))

    @router.get(
        "/{robot}/meshes/{path:path}",
        operation_id="get_robot_mesh",
        summary="A mesh file of a robot",
        response_class=Response,
        responses={
            200: {"content": {kind: {} for kind in _MESH_TYPES.values()}, "description": "The file"},
            **problem_responses(404, 422, *BY_THE_CREW),
        },
    )
    async def get_mesh(
        request: Request,
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
        await remote.resident(request, robot)

        def opened() -> tuple[FilePath, IO[bytes]]:
            file = library.mesh(robot, path)
            try:
                return file, open_plain(file)  # once open, it is there to its end, whoever replaces the robot meanwhile
            except FileNotFoundError:
                raise UnknownMesh(path) from None

        file, stream = await asyncio.to_thread(opened)
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


class Listed:
    """The list of all robots, kept as long as none is uploaded, replaced or removed, by whichever process.

    What a person changes in the folder of a robot is told when the list has become old.

    Args:
        library: All robots.
        remote: Who makes the list.
    """

    def __init__(self, library: Library, remote: Remote) -> None:
        self._library, self._remote = library, remote
        self._kept: tuple[int, float, bytes] | None = None

    async def answer(self, request: Request) -> Response:
        """The list; raises as `Remote.answer` does."""
        state, now = self._library.state(), time.monotonic()
        if self._kept is not None and state == self._kept[0] and now < self._kept[1] + _LIST_SECONDS:
            return Response(self._kept[2], media_type=JSON)
        content = await self._remote.told(request, _listed, Inquiry())
        self._kept = None if state is None else (state, now, content)
        return Response(content, media_type=JSON)


def upload_routes(remote: Remote, max_body_bytes: int) -> list[DocumentedRoute]:
    """What writes robots: as JSON, or as a zip in a form."""

    async def add(request: BoundedRequest) -> Response:
        return await _receive(request, remote, None)

    async def replace(request: BoundedRequest) -> Response:
        return await _receive(request, remote, request.path_params["robot"])

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


async def _receive(request: BoundedRequest, remote: Remote, name: str | None) -> Response:
    """Take an upload in either form; the crew looks at it and keeps it."""
    root_path, given = request.scope.get("root_path", ""), request.media_type
    key = request.scope.get("gelenk.key")
    owner = WITHOUT_KEY if key is None else f"key {key}"
    if given == JSON:
        inquiry = Inquiry(buffers(await request.pieces()))
        return await remote.answer(request, Keep(name, root_path, owner), inquiry)
    if given != MULTIPART:
        raise UnsupportedMediaType(given, (JSON, MULTIPART))
    with writing():
        form = await request.form(max_files=1, max_fields=8, max_part_size=64 * 1024)
    try:
        archive = form.get("archive")
        fields = {key: value for key, value in form.multi_items() if key != "archive"}
        text = (NewArchive if name is None else ArchiveReplacement).model_validate(fields)
        if not isinstance(archive, UploadFile):
            raise InvalidArchive("the form must have a file in the field `archive`")
        pieces = await asyncio.to_thread(lambda: list(iter(lambda: archive.file.read(_PIECE), b"")))
    finally:
        await form.close()
    return await remote.answer(request, Keep(name, root_path, owner, text), Inquiry(buffers(pieces)))


@dataclass(frozen=True, slots=True)
class Keep:
    """An upload that is looked at and kept, in the place of another one where that is named.

    Attributes:
        name: The robot to replace; None adds one.
        root_path: What goes before the path of its address.
        owner: Whose it is.
        form: The fields that come with an archive; None where the body is JSON.
    """

    name: str | None
    root_path: str
    owner: str
    form: ArchiveReplacement | None = None

    def __call__(self, desk: Desk, inquiry: Inquiry) -> Response:
        """The robot as it is kept now."""
        if self.form is None:
            return self._kept(desk.library, replace(_from_json(inquiry.body, self.name), owner=self.owner))
        with unpacked(BytesIO(inquiry.body), root=desk.library.uploads) as content:
            upload = RobotUpload(
                name=self.form.name if isinstance(self.form, NewArchive) else self.name or "",
                format="urdf",
                model=content.urdf,
                description=self.form.description,
                default_chain=self.form.ends(),
                meshes=content.meshes,
                urdf_folder=content.urdf_folder,
                strict=self.form.strict,
                owner=self.owner,
            )
            return self._kept(desk.library, upload)

    def _kept(self, library: Library, upload: RobotUpload) -> Response:
        if self.name is not None:
            library.replace(upload)
            return json_response(info(library.get(upload.name)).model_dump(mode="json"))
        created = library.add(upload)
        location = {"Location": f"{self.root_path}/v1/robots/{upload.name}"}
        return json_response(info(library.get(upload.name)).model_dump(mode="json"), 201 if created else 200, location)


def _from_json(body: bytes, name: str | None) -> RobotUpload:
    robot = read_json(NewRobot if name is None else RobotReplacement, body)
    name = robot.name if isinstance(robot, NewRobot) else name or ""
    if robot.dh is not None:
        model = robot.dh.model_dump_json(exclude_none=True, indent=2).encode() + b"\n"
        return RobotUpload(name, "dh", model, robot.description, robot.default_chain)
    urdf = (robot.urdf or "").encode("utf-8", "surrogatepass")
    return RobotUpload(name, "urdf", urdf, robot.description, robot.default_chain, strict=robot.strict)


def _listed(desk: Desk, _: Inquiry) -> Response:
    return Response(b'{"robots":[%b]}' % b",".join(desk.library.summaries()), media_type=JSON)


def _described(desk: Desk, inquiry: Inquiry) -> Response:
    return json_response(info(desk.library.get(inquiry.robot)).model_dump(mode="json"))


def _urdf(desk: Desk, inquiry: Inquiry) -> Response:
    return Response(desk.library.get(inquiry.robot).urdf, media_type="application/xml", headers=SANDBOXED)


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
        skeleton=skeleton_of(loaded),
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


def _form(fields: type[ArchiveReplacement]) -> dict[str, Any]:
    """A form with these fields and an archive, as a further content of a request."""
    schema = fields.model_json_schema()
    for field in schema["properties"].values():
        without_null(field)
    schema["properties"]["archive"] = {
        "type": "string",
        "format": "binary",
        "description": "Zip of one URDF and its meshes.",
    }
    schema["required"] = [*schema.get("required", []), "archive"]
    return {MULTIPART: {"schema": schema}}
