"""Scenes over HTTP: added, returned, replaced and removed, as JSON and with files; and what is refused."""

import io
import json
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
import trimesh
from starlette.testclient import TestClient

from gelenk.contract.common import Payload
from gelenk.contract.endpoint import Scope
from gelenk.contract.scene import EXAMPLE_SCENE, Scene, SceneInfo, SceneList, SceneOrName
from gelenk.errors import UnknownScene
from gelenk.http import dispatch
from gelenk.http.access.keyring import new_key
from gelenk.http.workers.task import TaskRequest, buffers
from gelenk.store.scenes import Scenes, SceneUpload
from tests.http.test_quotas import served

BALL = {"name": "ball", "shape": {"type": "sphere", "radius": 0.1}}
SHELF = {"name": "shelf", "shape": {"type": "mesh", "file": "shelf.stl"}}
SCAN = {"name": "scan", "shape": {"type": "points", "file": "scan.npy", "radius": 0.01}}


def npy(array: Any) -> bytes:
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


TETRAHEDRON = (
    b"\n".join(b"v %d %d %d" % corner for corner in [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    + b"\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
)
STL: bytes = cast(Any, trimesh.load_mesh(io.BytesIO(TETRAHEDRON), file_type="obj")).export(file_type="stl")
POINTS = npy(np.arange(12.0).reshape(4, 3))


def form(client: TestClient, objects: list[Any], files: list[tuple[str, bytes]], name: str = "") -> Any:
    """Add a scene with files, or replace the one of the path."""
    scene = {"objects": objects} | ({} if name else {"name": "packed"})
    method, path = ("PUT", f"/v1/scenes/{name}") if name else ("POST", "/v1/scenes")
    parts = [("files", file) for file in files]
    # The scene is a file of its own in one of the forms: `curl -F scene=@scene.json` sends it so.
    return client.request(method, path, files=[*parts, ("scene", ("scene.json", json.dumps(scene)))])


@pytest.fixture
def own(client: TestClient) -> Iterator[TestClient]:
    """The client, without scenes before and after."""
    yield client
    for scene in client.get("/v1/scenes").json()["scenes"]:
        assert client.delete(f"/v1/scenes/{scene['name']}").status_code == 204


def test_a_scene_is_added_returned_replaced_and_removed(own: TestClient) -> None:
    added = own.post("/v1/scenes", json=EXAMPLE_SCENE)
    assert added.status_code == 201, added.text
    assert added.headers["location"] == "/v1/scenes/my_cell"
    assert SceneInfo.model_validate_json(added.content).name == "my_cell"
    assert added.json() == EXAMPLE_SCENE | {"files": []} == own.get("/v1/scenes/my_cell").json()
    assert own.post("/v1/scenes", json=EXAMPLE_SCENE).status_code == 200
    other = own.post("/v1/scenes", json={"name": "my_cell", "objects": [BALL]})
    assert (other.status_code, other.json()["type"]) == (409, "urn:gelenk:scene-exists")
    replaced = own.put("/v1/scenes/my_cell", json={"objects": [BALL]})
    assert (replaced.status_code, replaced.json()["objects"]) == (200, [BALL])
    (entry,) = SceneList.model_validate_json(own.get("/v1/scenes").content).scenes
    assert (entry.name, entry.objects) == ("my_cell", 1)
    assert own.delete("/v1/scenes/my_cell").status_code == 204
    for method, body in (("GET", None), ("PUT", {"objects": []}), ("DELETE", None)):
        gone = own.request(method, "/v1/scenes/my_cell", json=body)
        assert (gone.status_code, gone.json()["type"]) == (404, "urn:gelenk:unknown-scene")


def test_a_scene_comes_with_its_files_and_keeps_those_it_still_names(own: TestClient) -> None:
    answer = form(own, [SHELF, SCAN], [("scan.npy", POINTS), ("shelf.stl", STL)])
    assert answer.status_code == 201, answer.text
    assert answer.json()["files"] == [
        {"name": "shelf.stl", "size": len(STL)},
        {"name": "scan.npy", "size": len(POINTS)},
    ]
    for file, content, kind in (
        ("shelf.stl", STL, "model/stl"),
        ("scan.npy", POINTS, "application/x-npy"),
    ):
        got = own.get(f"/v1/scenes/packed/files/{file}")
        assert (got.status_code, got.content, got.headers["content-type"]) == (200, content, kind)
        assert "sandbox" in got.headers["content-security-policy"]
    for other in ("scene.json", "none.stl", "..%2fpacked.zip"):
        missing = own.get(f"/v1/scenes/packed/files/{other}")
        assert (missing.status_code, missing.headers["content-type"]) == (404, "application/problem+json")
    assert own.put("/v1/scenes/packed", json={"objects": [BALL, SHELF]}).json()["files"] == [
        {"name": "shelf.stl", "size": len(STL)}
    ]
    replaced = form(own, [SHELF, SCAN], [("scan.npy", POINTS)], "packed")
    assert {file["name"] for file in replaced.json()["files"]} == {"shelf.stl", "scan.npy"}
    as_field = own.post(
        "/v1/scenes",
        data={"scene": json.dumps({"name": "field", "objects": [SHELF]})},
        files=[("files", ("shelf.stl", STL))],
    )
    assert as_field.status_code == 201, as_field.text


BAD_POSE = {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 2]}


@pytest.mark.parametrize(
    ("objects", "status", "words"),
    [
        ([BALL, BALL], 422, "both named 'ball'"),
        ([BALL | {"pose": BAD_POSE}], 422, "objects.0.pose"),
        ([BALL | {"shape": {"type": "sphere", "radius": 0}}], 422, "#/objects/0/shape/sphere/radius"),
        ([BALL | {"shape": {"type": "cone"}}], 422, "'box', 'sphere'"),
        ([SHELF], 422, "'shelf.stl', but no such file"),
        ([BALL | {"colour": "red"}], 422, "#/objects/0/colour"),
    ],
)
def test_a_scene_that_cannot_be(own: TestClient, objects: list[Any], status: int, words: str) -> None:
    answer = own.post("/v1/scenes", json={"name": "bad", "objects": objects})
    assert answer.status_code == status
    assert words in answer.json()["detail"]
    assert own.get("/v1/scenes").json() == {"scenes": []}


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"no array", "'scan.npy': the body is not npy"),
        (npy(np.zeros((4, 2))), "its shape is (4, 2)"),
        (npy(np.zeros((0, 3))), "its shape is (0, 3)"),
        (npy([[0.0, np.nan, 0.0]]), "magnitude"),
        (npy([[0.0, 1e7, 0.0]]), "magnitude"),
        (npy(np.zeros((1_000_001, 3), np.int8)), "1000001 is more than the 1000000"),
    ],
)
def test_a_cloud_that_cannot_be(own: TestClient, content: bytes, words: str) -> None:
    answer = form(own, [SCAN], [("scan.npy", content)])
    assert answer.status_code in {413, 422}
    assert words in answer.json()["detail"]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"solid nothing", "it has no triangle"),
        (b"", "it has no triangle"),
        (STL[:100] + b"\xff" * 12 + STL[112:], "a coordinate is not a number"),
    ],
)
def test_a_mesh_that_cannot_be(own: TestClient, content: bytes, words: str) -> None:
    answer = form(own, [SHELF], [("shelf.stl", content)])
    assert answer.status_code == 422
    assert f"'shelf.stl': {words}" in answer.json()["detail"]
    assert own.get("/v1/scenes").json() == {"scenes": []}


def test_a_form_that_cannot_be(own: TestClient) -> None:
    twice = form(own, [SHELF], [("shelf.stl", b"a"), ("shelf.stl", b"b")])
    assert "'shelf.stl' is there twice" in twice.json()["detail"]
    unused = form(own, [BALL], [("../../shelf.stl", b"a")])
    assert "no object of the scene names '../../shelf.stl'" in unused.json()["detail"]
    many = form(own, [SHELF], [(f"{i}.stl", b"a") for i in range(200)])
    assert "Too many files" in many.json()["detail"]
    without = own.post("/v1/scenes", files=[("files", ("shelf.stl", b"a"))])
    assert "#/scene" in without.json()["detail"]
    assert [one.status_code for one in (twice, unused, many, without)] == [422, 422, 400, 422]
    assert own.post("/v1/scenes", content=b"<scene/>", headers={"Content-Type": "text/xml"}).status_code == 415
    assert own.get("/v1/scenes").json() == {"scenes": []}


def test_each_key_has_its_own_room_and_a_restart_forgets_nothing(tmp_path: Path) -> None:
    keys = {
        name: new_key(name, scopes)
        for name, scopes in (("anna", list(Scope)), ("ben", list(Scope)), ("eve", [Scope.READ]))
    }

    def status(client: TestClient, method: str, name: str, key: str) -> int:
        path = "/v1/scenes" if method == "POST" else f"/v1/scenes/{name}"
        body = {"POST": {"name": name, "objects": [BALL]}, "PUT": {"objects": []}}.get(method)
        headers = {"Authorization": f"Bearer {keys[key][0]}"}
        return client.request(method, path, json=body, headers=headers).status_code

    settings: dict[str, Any] = {"api_keys": " ".join(key.entry() for _, key in keys.values()), "client_scenes": 2}
    with served(tmp_path, **settings) as client:
        assert [status(client, "POST", f"anna{n}", "anna") for n in range(3)] == [201, 201, 413]
        assert status(client, "PUT", "anna0", "anna") == 200
        assert status(client, "POST", "ben0", "ben") == 201
        assert [status(client, method, "ben0", "eve") for method in ("POST", "PUT", "DELETE")] == [403, 403, 403]
        assert status(client, "GET", "ben0", "eve") == 200
        assert client.get("/v1/scenes").status_code == 401
    with served(tmp_path, **settings) as client:
        assert status(client, "POST", "anna2", "anna") == 413
        Scenes(tmp_path / "scenes").remove("anna0")  # by another process
        assert status(client, "GET", "anna0", "ben") == 404
        assert status(client, "POST", "anna2", "anna") == 201
    lines = (tmp_path / "audit" / "audit.jsonl").read_text().splitlines()
    assert {"add_scene", "replace_scene"} <= {json.loads(line)["operation"] for line in lines}


class Call(Payload):
    """A request that may name a scene."""

    scene: SceneOrName | None = None


@pytest.mark.parametrize("body", [b'{"scene": "cell"}', b'{"scene": {"objects": []}}', b"{}"])
def test_a_worker_gets_the_scene_that_a_call_names(tmp_path: Path, body: bytes) -> None:
    context, endpoint = (
        SimpleNamespace(scenes=Scenes(tmp_path)),
        SimpleNamespace(request=Call, options=None, robot_field=""),
    )
    given = Call.model_validate_json(body)
    assert dispatch._names_scene(given) == (body == b'{"scene": "cell"}')
    request = TaskRequest(buffers([body]))
    if dispatch._names_scene(given):
        with pytest.raises(UnknownScene):
            dispatch._robot_and_call(cast(Any, context), cast(Any, endpoint), request)
        stored = Scene.model_validate({"objects": [SHELF]})
        context.scenes.add(SceneUpload("cell", stored, {"shelf.stl": b"solid"}))
    _, call = dispatch._robot_and_call(cast(Any, context), cast(Any, endpoint), request)
    if dispatch._names_scene(given):
        assert (call.scene.files, call.scene.read("shelf.stl")) == (("shelf.stl",), b"solid")
    else:
        assert call == given
