"""The picture of a DH table over HTTP: its forms, what it draws without a configuration, and refusals."""

import math
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.dh_picture import two_links

JSON = {"Accept": "application/json"}
PATH = "/v1/dh/picture"


@pytest.mark.quick(1)
@pytest.mark.parametrize("method", ["GET", "POST"])
@pytest.mark.parametrize(
    ("accept", "begins"),
    [("*/*", b"<?xml"), ("image/png", b"\x89PNG"), ("application/pdf", b"%PDF"), ("text/html,*/*;q=0.8", b"<?xml")],
)
def test_it_is_a_picture_in_either_form(client: TestClient, method: str, accept: str, begins: bytes) -> None:
    body = two_links("standard") if method == "POST" else None
    answer = client.request(method, PATH, json=body, headers={"Accept": accept})
    assert answer.status_code == 200
    assert answer.content.startswith(begins)


@pytest.mark.slow
def test_the_lecture_s_picture_is_that_of_its_table(client: TestClient) -> None:
    for convention in ("standard", "modified"):
        drawn = client.get(PATH, params={"convention": convention}).content
        assert drawn == client.post(PATH, json=two_links(convention)).content
    assert client.get(PATH, params={"convention": "modified"}).content != client.get(PATH).content


def test_the_frames_as_numbers(client: TestClient) -> None:
    """P and z of the anthropomorphic arm by the lecture's closed form."""
    rows = [(0.0, math.pi / 2.0), (0.5, 0.0), (0.4, 0.0)]
    joints = [{"type": "revolute", "a": a, "alpha": alpha, "d": 0.0, "theta": 0.0} for a, alpha in rows]
    call = {"dh": {"convention": "standard", "joints": joints}, "joint_positions": [[0.3, 0.6, -0.8]]}
    answer = client.post(PATH, json=call, headers=JSON).json()
    assert [frame["name"] for frame in answer["frames"]] == ["0", "1", "2", "3"]
    tip = answer["frames"][-1]
    np.testing.assert_allclose(tip["origin"], [0.768753959783, 0.237803466792, 0.202853504379], atol=1e-12)
    np.testing.assert_allclose(tip["z_axis"], [math.sin(0.3), -math.cos(0.3), 0.0], atol=1e-12)


def test_without_a_configuration_every_joint_has_moved_within_its_limits(client: TestClient) -> None:
    joints: list[dict[str, Any]] = [
        {"type": "revolute", "a": 0.4, "alpha": 0.0, "d": 0.0, "theta": 0.0},
        {"type": "revolute", "a": 0.4, "alpha": 0.0, "d": 0.0, "theta": 0.0, "lower": -0.2, "upper": 0.1},
        {"type": "prismatic", "a": 0.0, "alpha": 0.0, "d": 0.0, "theta": 0.0},
    ]
    call = {"dh": {"convention": "standard", "joints": joints}}
    assert client.post(PATH, json=call, headers=JSON).json()["joint_positions"] == [0.5, 0.1, 0.2]


def test_base_and_tool_are_frames_of_their_own(client: TestClient) -> None:
    call = two_links("standard")
    call["dh"]["tool"] = {"position": [0.0, 0.0, 0.2], "rpy": [0.0, 0.0, 0.0]}
    frames = client.post(PATH, json=call, headers=JSON).json()["frames"]
    assert [frame["name"] for frame in frames] == ["0", "1", "2", "E"]
    wanted = np.array(frames[2]["origin"]) + 0.2 * np.array(frames[2]["z_axis"])
    np.testing.assert_allclose(frames[3]["origin"], wanted, atol=1e-12)


def test_too_many_rows_and_configurations_are_refused(client: TestClient) -> None:
    call = two_links("standard")
    call["dh"]["joints"] *= 9
    call["joint_positions"] = []
    refused = client.post(PATH, json=call)
    assert refused.status_code == 422
    assert "18 rows; a picture shows at most 16" in refused.json()["detail"]
    call = two_links("standard")
    call["joint_positions"] *= 2
    assert client.post(PATH, json=call).status_code == 422
    assert client.get(PATH, params={"convention": "craig"}).status_code == 422
