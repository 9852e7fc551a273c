"""Contacts over HTTP: what the answer holds, and every way to ask wrongly."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
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
        (with_table(shape={"type": "mesh", "file": "table.stl"}), "/scene/objects/0/shape/file", "boxes"),
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
