"""Contacts over HTTP: what the answer holds, and every way to ask wrongly."""

import json
from collections.abc import Iterator
from io import BytesIO
from typing import Any

import numpy as np
import pytest
import trimesh
from starlette.testclient import TestClient

from gelenk.contract.collisions import CollisionAnswer

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
TABLE = {
    "name": "table",
    "shape": {"type": "box", "size": [0.6, 1.2, 0.1]},
    "pose": {"position": [0.6, 0.0, 0.2], "rpy": [0.0, 0.0, 0.0]},
}


def ask(client: TestClient, body: dict[str, Any]) -> dict[str, Any]:
    """The answer, which is what its model says."""
    answer = client.post("/v1/robots/panda/collisions", json={"joint_positions": [READY], **body})
    assert answer.status_code == 200, answer.text
    CollisionAnswer.model_validate_json(answer.content)
    content: dict[str, Any] = answer.json()
    return content


def with_table(**changes: Any) -> dict[str, Any]:
    """A scene of the table, some of its fields changed."""
    return {"scene": {"objects": [{**TABLE, **changes}]}}


def test_the_arm_above_a_table_is_free(client: TestClient) -> None:
    answer = ask(client, {**with_table(), "clearance": True})
    (result,) = answer["results"]
    assert result["in_collision"] is False
    assert 0.0 < result["clearance"] == pytest.approx(result["pairs"][0]["distance"])
    assert answer["certificate"]["samples"] == 1
    assert answer["root_frame"] == "panda_link0"


def test_a_hand_in_the_table_is_in_contact_and_says_where(client: TestClient) -> None:
    low = [0.0, 0.6, 0.0, -2.0, 0.0, 2.6, 0.785]
    answer = ask(client, {**with_table(), "joint_positions": [low, READY], "clearance": True, "pairs": "all"})
    hit, free = answer["results"]
    assert (hit["in_collision"], free["in_collision"], free["pairs"]) == (True, False, [])
    deepest = hit["pairs"][0]
    assert deepest["b"] == "table"
    assert hit["clearance"] == pytest.approx(deepest["distance"])
    assert hit["clearance"] < 0.0
    apart = np.subtract(deepest["point_a"], deepest["point_b"])
    assert np.linalg.norm(apart) == pytest.approx(-deepest["distance"])
    assert abs(deepest["point_a"][2] - 0.2) <= 0.05 + 1e-9


def test_a_clearance_counts_as_contact(client: TestClient) -> None:
    near = ask(client, {**with_table(), "clearance": True})["results"][0]
    wide = ask(client, {**with_table(clearance=0.5), "clearance": True})["results"][0]
    assert (near["in_collision"], wide["in_collision"]) == (False, True)
    assert wide["pairs"][0]["distance"] > 0.0 > wide["clearance"]


def test_an_attached_object_moves_with_its_frame(client: TestClient) -> None:
    stick = {"name": "stick", "shape": {"type": "capsule", "radius": 0.01, "length": 0.5}, "attached_to": "panda_hand"}
    shape = {**stick, "pose": {"position": [0.0, 0.0, 0.3], "rpy": [0.0, 0.0, 0.0]}}
    result = ask(client, {"scene": {"objects": [TABLE, shape]}, "pairs": "all"})["results"][0]
    assert [{pair["a"], pair["b"]} for pair in result["pairs"]] == [{"stick", "table"}]


def test_npy_has_a_row_a_configuration(client: TestClient) -> None:
    qs = np.random.default_rng(0).uniform(-1.0, -0.2, (100, 7))
    answers = [
        client.post(
            "/v1/robots/panda/collisions",
            json={"joint_positions": qs.tolist(), "clearance": clearance, "pairs": "none"},
            headers={"Accept": "application/x-npy"},
        )
        for clearance in (True, False)
    ]
    with_clearance, without = (np.load(BytesIO(answer.content)) for answer in answers)
    assert with_clearance.shape == (100, 2)
    np.testing.assert_array_equal(with_clearance[:, 0], with_clearance[:, 1] <= 0.0)
    np.testing.assert_array_equal(with_clearance[:, 0], without[:, 0])
    assert np.isnan(without[:, 1]).all()


@pytest.mark.parametrize(
    ("body", "pointer", "words"),
    [
        ({"scene": {"objects": [TABLE, TABLE]}}, "/scene", "both named 'table'"),
        (with_table(attached_to="hand"), "/scene/objects/0/attached_to", "no frame 'hand'"),
        (with_table(touch_links=["hand"]), "/scene/objects/0/touch_links", "no frame 'hand'"),
        (with_table(name="panda_link3"), "/scene/objects/0/name", "the name of a link"),
        (with_table(shape={"type": "box", "size": [1.0, 0.0, 1.0]}), "/shape/box/size/1", "0.0001"),
        (with_table(shape={"type": "sphere", "radius": -1.0}), "/shape/sphere/radius", "0.0001"),
        (with_table(shape={"type": "cone"}), "/scene/objects/0/shape", "cone"),
        (
            with_table(shape={"type": "half_space", "normal": [0.0, 0.0, 0.0]}),
            "/scene/objects/0/shape/normal",
            "direction",
        ),
        (
            with_table(pose={"position": [0.0, 0.0, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 2.0]}),
            "/scene/objects/0/pose",
            "length 2",
        ),
        (with_table(shape={"type": "mesh", "file": "table.stl"}), "/scene", "store the scene with its files"),
        ({"other_joints": {"panda_joint1": 0.0}}, "/other_joints", "panda_finger_joint1"),
        ({"joint_positions": [[0.0]]}, "/joint_positions", "7"),
        ({"pairs": "some"}, "/pairs", "first"),
    ],
)
def test_a_bad_request_is_refused_at_its_field(
    client: TestClient, body: dict[str, Any], pointer: str, words: str
) -> None:
    answer = client.post("/v1/robots/panda/collisions", json={"joint_positions": [READY], **body})
    assert answer.status_code == 422, answer.text
    assert pointer in answer.text
    assert words in answer.text


@pytest.fixture
def own(client: TestClient) -> Iterator[TestClient]:
    """The client, without scenes afterwards."""
    yield client
    for scene in client.get("/v1/scenes").json()["scenes"]:
        client.delete(f"/v1/scenes/{scene['name']}")


def store(client: TestClient, shape: dict[str, Any], content: bytes, method: str = "POST", **changes: Any) -> None:
    """Store a scene of the table, of another shape that is read from a file."""
    scene = {"name": "cell"} if method == "POST" else {}
    path = "/v1/scenes" if method == "POST" else "/v1/scenes/cell"
    objects = [{**TABLE, "shape": shape, **changes}]
    parts: list[tuple[str, Any]] = [("files", (shape["file"], content))]
    parts.append(("scene", ("scene.json", json.dumps({**scene, "objects": objects}))))
    answer = client.request(method, path, files=parts)
    assert answer.status_code == {"POST": 201, "PUT": 200}[method], answer.text


def stl(mesh: Any) -> bytes:
    content: bytes = mesh.export(file_type="stl")
    return content


def npy(points: Any) -> bytes:
    stream = BytesIO()
    np.save(stream, points)
    return stream.getvalue()


def test_a_stored_mesh_is_what_it_looks_like_until_it_is_replaced(own: TestClient) -> None:
    mesh = {"type": "mesh", "file": "table.stl"}
    for method, size in (("POST", [0.6, 1.2, 0.1]), ("PUT", [0.6, 1.2, 0.5])):
        store(own, mesh, stl(trimesh.creation.box(size)), method)
        named, drawn = (
            ask(own, {"scene": scene, "clearance": True})
            for scene in ("cell", with_table(shape={"type": "box", "size": size})["scene"])
        )
        assert named["results"][0]["clearance"] == pytest.approx(drawn["results"][0]["clearance"], abs=1e-6)
        assert named["warnings"] == drawn["warnings"]
    assert own.delete("/v1/scenes/cell").status_code == 204
    gone = own.post("/v1/robots/panda/collisions", json={"joint_positions": [READY], "scene": "cell"})
    assert (gone.status_code, gone.json()["type"]) == (404, "urn:gelenk:unknown-scene")
    assert gone.json()["pointer"] == "#/scene"


def test_a_mesh_that_is_not_convex_says_how_much_larger_it_counts(own: TestClient) -> None:
    store(own, {"type": "mesh", "file": "ring.stl"}, stl(trimesh.creation.annulus(0.1, 0.2, 0.1)))
    (warning,) = ask(own, {"scene": "cell"})["warnings"]
    assert "'table' counts as 1 convex hull around what it is made of, with at most 3" in warning
    sheet = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    store(own, {"type": "mesh", "file": "sheet.stl"}, stl(sheet), "PUT")
    assert "not closed" in ask(own, {"scene": "cell"})["warnings"][0]


@pytest.mark.slow
def test_a_stored_cloud_is_never_farther_than_its_points(own: TestClient) -> None:
    cloud = {"type": "points", "file": "scan.npy", "radius": 0.005}
    few = np.random.default_rng(0).uniform(-0.3, 0.3, (400, 3)).astype("f4")
    store(own, cloud, npy(few))
    points = with_table(shape={"type": "points", "points": few.tolist(), "radius": 0.005})["scene"]
    named, given = (ask(own, {"scene": scene, "clearance": True})["results"][0] for scene in ("cell", points))
    assert named == given
    many = np.repeat(few, 30, axis=0) + np.random.default_rng(1).uniform(-1e-3, 1e-3, (12_000, 3))
    store(own, cloud, npy(many), "PUT")
    answer = ask(own, {"scene": "cell", "clearance": True})
    (warning,) = answer["warnings"]
    assert "'table' counts as boxes around its 12000 points" in warning
    excess = float(warning.split("at most ")[1].split(" m")[0])
    assert -excess - 2e-3 <= answer["results"][0]["clearance"] - given["clearance"] <= 2e-3


@pytest.mark.slow
def test_a_scene_of_too_many_pieces_or_pairs_is_refused(client: TestClient) -> None:
    random = np.random.default_rng(0)

    def cloud(name: str, count: int, **more: Any) -> dict[str, Any]:
        points = random.uniform(-1.0, 1.0, (count, 3)).tolist()
        return {"name": name, "shape": {"type": "points", "points": points, "radius": 0.001}, **more}

    for objects, status, words in (
        ([cloud("a", 9000), cloud("b", 9000), cloud("c", 9000)], 422, "/scene/objects/2/shape"),
        ([cloud("a", 1500), cloud("b", 1500, attached_to="panda_hand")], 413, "pairs of pieces"),
    ):
        body = {"joint_positions": [READY], "scene": {"objects": objects}}
        answer = client.post("/v1/robots/panda/collisions", json=body)
        assert answer.status_code == status, answer.text
        assert words in answer.text
