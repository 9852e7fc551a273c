"""Endpoints that list, return, add, replace and remove scenes."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Annotated, Any

import numpy as np
import orjson
from fastapi import APIRouter, Path, Response
from starlette.datastructures import UploadFile

from gelenk.collision.shapes.meshes import read_triangles
from gelenk.contract.pose import MAX_MAGNITUDE
from gelenk.contract.resources import SCENE_TYPES
from gelenk.contract.scene import MAX_FILES, MAX_POINTS, NamedScene, Scene, SceneForm, SceneList, SceneMesh, ScenePoints
from gelenk.errors import InvalidArray, InvalidField, TooLarge, UnknownMesh, quoted
from gelenk.http.messages.npy import read_npy
from gelenk.http.messages.openapi import documentation
from gelenk.http.messages.payloads import JSON, MULTIPART, BoundedRequest, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.robots.meshes import SANDBOXED
from gelenk.http.workers.pool_client import PoolClient, owner_of
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.store.folders import writing
from gelenk.store.scenes import Scenes, SceneUpload

ScenePath = Annotated[str, Path(description="Name of a scene.", openapi_examples={"my_cell": {"value": "my_cell"}})]
_LARGEST_TEXT = 16 * 1024 * 1024
"""Size of the largest scene in a form that is no file of its own there, [bytes]."""


def scenes_router(scenes: Scenes) -> APIRouter:
    """Return the router of operations that read or remove scenes; none of them parses one."""
    router = APIRouter()

    @router.api_route(**documentation("list_scenes"))
    def list_scenes() -> Any:
        return Response(SceneList(scenes=scenes.summaries()).model_dump_json(), media_type=JSON)

    @router.api_route(**documentation("get_scene"))
    def get_scene(scene: ScenePath) -> Any:
        return _scene_response(scenes, scene)

    @router.api_route(**documentation("get_scene_file"))
    def get_file(
        scene: ScenePath,
        file: Annotated[
            str, Path(description="Name of one of its files.", openapi_examples={"mesh": {"value": "shelf.stl"}})
        ],
    ) -> Response:
        stored = scenes.get(scene)
        if file not in stored.files:
            raise UnknownMesh(file, "scene")
        kind = SCENE_TYPES[PurePath(file).suffix.lower()]
        return Response(stored.read(file), media_type=kind, headers=SANDBOXED)

    @router.api_route(**documentation("remove_scene"))
    def remove_scene(scene: ScenePath) -> Response:
        scenes.remove(scene)
        return Response(status_code=204)

    return router


def scene_routes(pool_client: PoolClient, max_body_bytes: int) -> list[DocumentedRoute]:
    """Return the routes that add and replace scenes, as JSON or as a form with files; workers check them."""

    async def add(request: BoundedRequest) -> Response:
        return await _receive(request, pool_client, None)

    async def replace(request: BoundedRequest) -> Response:
        return await _receive(request, pool_client, request.path_params["scene"])

    def add_scene(content: NamedScene) -> Any: ...

    def replace_scene(scene: ScenePath, content: Scene) -> Any: ...

    return [
        DocumentedRoute(add_scene, add, max_body_bytes, **documentation("add_scene")),
        DocumentedRoute(replace_scene, replace, max_body_bytes, **documentation("replace_scene")),
    ]


async def _receive(request: BoundedRequest, pool_client: PoolClient, name: str | None) -> Response:
    files: Sequence[tuple[str, bytes]] = ()
    if request.media_type == JSON:
        pieces = await request.pieces()
    elif request.media_type == MULTIPART:
        text, files = await _parts(request)
        pieces = [text, *(content for _, content in files)]
    else:
        raise UnsupportedMediaType(request.media_type, (JSON, MULTIPART))
    sizes = tuple((file, len(content)) for file, content in files)
    keep = KeepScene(name, request.scope.get("root_path", ""), owner_of(request), sizes)
    return await pool_client.answer(request, keep, TaskRequest(buffers(pieces)))


async def _parts(request: BoundedRequest) -> tuple[bytes, list[tuple[str, bytes]]]:
    """Return the parts of a form: the scene as JSON, and the files with their names."""
    with writing():
        form = await request.form(max_files=MAX_FILES + 1, max_fields=8, max_part_size=_LARGEST_TEXT)
    try:
        fields = {key: value for key, value in form.multi_items() if key != "files"}
        if isinstance(scene := fields.get("scene"), UploadFile):
            fields["scene"] = (await scene.read()).decode("utf-8", "surrogateescape")
        text = SceneForm.model_validate(fields).scene.encode("utf-8", "surrogateescape")
        files = [one for one in form.getlist("files") if isinstance(one, UploadFile)]
        return text, [(one.filename or "", await one.read()) for one in files]
    finally:
        await form.close()


@dataclass(frozen=True, slots=True)
class KeepScene:
    """Checks and stores a scene; replaces the scene `name` if that is given.

    The body of the request is the scene as JSON and behind it the `files`, given by name and size.
    """

    name: str | None
    root_path: str
    owner: str
    files: tuple[tuple[str, int], ...] = ()

    def __call__(self, context: Context, task_request: TaskRequest) -> Response:
        """Store the scene, and return it as it is now."""
        text, files = self._cut(task_request.body)
        scene = read_json(NamedScene if self.name is None else Scene, text)
        scene.transforms()
        _check_points(scene, files)
        _check_meshes(scene, files)
        if self.name is None:
            name = scene.name if isinstance(scene, NamedScene) else ""
            status = 201 if context.scenes.add(SceneUpload(name, scene, files, self.owner)) else 200
            return _scene_response(context.scenes, name, status, {"Location": f"{self.root_path}/v1/scenes/{name}"})
        context.scenes.replace(SceneUpload(self.name, scene, files, self.owner))
        return _scene_response(context.scenes, self.name)

    def _cut(self, body: bytes) -> tuple[bytes, dict[str, bytes]]:
        at = end = len(body) - sum(size for _, size in self.files)
        files: dict[str, bytes] = {}
        for file, size in self.files:
            if file in files:
                raise InvalidField("files", f"{quoted(file)} is there twice")
            files[file], at = body[at : at + size], at + size
        return body[:end], files


def _check_points(scene: Scene, files: dict[str, bytes]) -> None:
    """Check that each file of points holds some; raises InvalidField, or TooLarge."""
    clouds = {str(one.shape.file) for one in scene.objects if isinstance(one.shape, ScenePoints)}
    for file in clouds & set(files):
        try:
            points = read_npy(files[file])
        except InvalidArray as error:
            raise InvalidField("files", f"{quoted(file)}: {error.reason}") from None
        if points.ndim != 2 or points.shape[1] != 3 or not len(points) or not (np.abs(points) <= MAX_MAGNITUDE).all():
            shape = f"its shape is {points.shape}, and there must be numbers of magnitude ≤ {MAX_MAGNITUDE:g} in (N, 3)"
            raise InvalidField("files", f"{quoted(file)}: {shape}")
        if len(points) > MAX_POINTS:
            raise TooLarge(f"points in {quoted(file)}", len(points), MAX_POINTS)


def _check_meshes(scene: Scene, files: dict[str, bytes]) -> None:
    """Check that each mesh can be read, so that no later call stumbles over it; raises InvalidMesh."""
    for file in {one.shape.file for one in scene.objects if isinstance(one.shape, SceneMesh)} & set(files):
        read_triangles(file, files[file])


def _scene_response(scenes: Scenes, name: str, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    document, files = scenes.document(name)
    about = orjson.dumps({"name": name, "files": [file.model_dump() for file in files]})
    return Response(b"%b,%b" % (about[:-1], document[1:]), status, headers, JSON)
