"""Endpoints that list, describe, add, replace and remove robots, and return their URDF and meshes."""

import asyncio
import time
from dataclasses import dataclass, replace
from io import BytesIO
from typing import Annotated, Any

from fastapi import APIRouter, Path, Request, Response
from starlette.datastructures import UploadFile

from gelenk.contract.robots import ArchiveReplacement, NewArchive, NewRobot, RobotReplacement, as_text
from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME
from gelenk.errors import InvalidArchive
from gelenk.http.messages.openapi import RobotPath, UploadedRobotPath, documentation
from gelenk.http.messages.payloads import JSON, MULTIPART, BoundedRequest, JsonResponse, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.robots.exports import certified
from gelenk.http.robots.info import info
from gelenk.http.robots.meshes import SANDBOXED, mesh_answer
from gelenk.http.workers.pool_client import PoolClient, owner_of
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.kinematics.judge.tables import certify_table
from gelenk.robot.formats.reading import as_urdf
from gelenk.robot.formats.sources import Sources
from gelenk.robot.urdf import write_urdf
from gelenk.store.archive import unpacked
from gelenk.store.folders import writing
from gelenk.store.library import Library, RobotUpload

_PIECE = 256 * 1024
_LIST_SECONDS = 5.0
"""How long the list of robots is cached if nothing shows that it has changed, as after an edit by hand, [s]."""


def robots_router(library: Library, pool_client: PoolClient) -> APIRouter:
    """Return the router of operations that read or remove robots; workers read the untrusted descriptions."""
    router = APIRouter()
    cached: tuple[int | None, float, bytes] = None, 0.0, b""

    @router.api_route(**documentation("list_robots"))
    async def list_robots(request: Request) -> Any:
        nonlocal cached
        state, now = library.state(), time.monotonic()
        if state is None or state != cached[0] or now >= cached[1] + _LIST_SECONDS:
            cached = state, now, await pool_client.content(request, _listed, TaskRequest())
        return Response(cached[2], media_type=JSON)

    @router.api_route(**documentation("get_robot"))
    async def get_robot(robot: RobotPath, request: Request) -> Any:
        return await pool_client.answer(request, _described, TaskRequest(robot=robot))

    @router.api_route(**documentation("get_robot_urdf"))
    async def get_urdf(robot: RobotPath, request: Request) -> Response:
        return await pool_client.answer(request, _urdf, TaskRequest(robot=robot))

    @router.api_route(**documentation("get_robot_mesh"))
    async def get_mesh(
        request: Request,
        robot: RobotPath,
        path: Annotated[
            str,
            Path(
                description="Path as listed in the robot's `meshes`.",
                openapi_examples={
                    "link0": {"value": "example-robot-data/robots/panda_description/meshes/visual/link0.dae"}
                },
            ),
        ],
    ) -> Response:
        return await mesh_answer(request, pool_client, library, robot, path)

    @router.api_route(**documentation("remove_robot"))
    def remove_robot(robot: UploadedRobotPath) -> Response:
        library.remove(robot)
        return Response(status_code=204)

    return router


def documented_routes(pool_client: PoolClient, max_body_bytes: int) -> list[DocumentedRoute]:
    """Return the routes that add and replace robots, as JSON or as a zip in a form."""

    async def add(request: BoundedRequest) -> Response:
        return await _receive(request, pool_client, None)

    async def replace(request: BoundedRequest) -> Response:
        return await _receive(request, pool_client, request.path_params["robot"])

    def add_robot(robot: NewRobot) -> Any: ...

    def replace_robot(robot: UploadedRobotPath, content: RobotReplacement) -> Any: ...

    return [
        DocumentedRoute(add_robot, add, max_body_bytes, **documentation("add_robot")),
        DocumentedRoute(replace_robot, replace, max_body_bytes, **documentation("replace_robot")),
    ]


async def _receive(request: BoundedRequest, pool_client: PoolClient, name: str | None) -> Response:
    """Accept an upload in either form; a worker checks and stores it."""
    root_path, given = request.scope.get("root_path", ""), request.media_type
    owner = owner_of(request)
    if given == JSON:
        task_request = TaskRequest(buffers(await request.pieces()))
        return await pool_client.answer(request, Keep(name, root_path, owner), task_request)
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
    return await pool_client.answer(request, Keep(name, root_path, owner, text), TaskRequest(buffers(pieces)))


@dataclass(frozen=True, slots=True)
class Keep:
    """Checks and stores an upload; replaces the robot `name` if that is given.

    `form` holds the fields that come with an archive; None if the body is JSON.
    """

    name: str | None
    root_path: str
    owner: str
    form: ArchiveReplacement | None = None

    def __call__(self, context: Context, task_request: TaskRequest) -> Response:
        """Store the robot, and return it as it is now."""
        if self.form is None:
            return self._kept(context.library, replace(_from_json(task_request.body, self.name), owner=self.owner))
        uploads = context.library.uploads
        with unpacked(BytesIO(task_request.body), root=uploads, wanted=self.form.file) as content:
            read = as_urdf(content.model, content.path, content.sources, as_text(self.form.arguments), self.form.strict)
            upload = RobotUpload(
                name=self.form.name if isinstance(self.form, NewArchive) else self.name or "",
                format="urdf",
                model=read.urdf,
                description=self.form.description,
                default_chain=self.form.ends(),
                meshes=content.meshes,
                urdf_folder=content.folder,
                srdf=content.srdf,
                notes=read.notes,
                strict=self.form.strict,
                owner=self.owner,
            )
            return self._kept(context.library, upload)

    def _kept(self, library: Library, upload: RobotUpload) -> Response:
        if self.name is not None:
            library.replace(upload)
            return _robot_response(library, upload.name)
        status = 201 if library.add(upload) else 200
        return _robot_response(library, upload.name, status, {"Location": f"{self.root_path}/v1/robots/{upload.name}"})


def _from_json(body: bytes, name: str | None) -> RobotUpload:
    robot = read_json(NewRobot if name is None else RobotReplacement, body)
    name = robot.name if isinstance(robot, NewRobot) else name or ""
    if robot.dh is not None:
        model = robot.dh.model_dump_json(exclude_none=True, indent=2).encode() + b"\n"
        return RobotUpload(name, "dh", model, robot.description, robot.default_chain)
    if robot.screws is not None:
        urdf = write_urdf(robot.screws.described(name)).encode()
        return RobotUpload(name, "urdf", urdf, robot.description, robot.default_chain)
    text = (robot.urdf or "").encode("utf-8", "surrogatepass")
    read = as_urdf(text, "", Sources(), as_text(robot.arguments), robot.strict)
    return RobotUpload(
        name, "urdf", read.urdf, robot.description, robot.default_chain, strict=robot.strict, notes=read.notes
    )


def _listed(context: Context, _: TaskRequest) -> Response:
    return Response(b'{"robots":[%b]}' % b",".join(context.library.summaries()), media_type=JSON)


def _described(context: Context, task_request: TaskRequest) -> Response:
    return _robot_response(context.library, task_request.robot)


def _robot_response(library: Library, name: str, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    return JsonResponse(info(library.get(name)).model_dump(mode="json"), status, headers)


def _urdf(context: Context, task_request: TaskRequest) -> Response:
    loaded = context.library.get(task_request.robot)
    headers = dict(SANDBOXED)
    if loaded.table is not None:
        certificate = certify_table(loaded.robot, loaded.robot.chain(BASE_FRAME, TOOL_FRAME), loaded.table)
        headers["Gelenk-Certificate"] = f"Of a DH table, {certified(certificate)}"
    return Response(loaded.urdf, media_type="application/xml", headers=headers)
