"""Pictures of manipulability over HTTP: what a call asks for is drawn, or refused by name."""

from typing import Any
from xml.etree import ElementTree

import pytest
from starlette.testclient import TestClient

BENT = [[0.3, 0.8]]
LIMITS = {"polytopes": True, "limits": {"joint_velocity": [1, 2], "joint_effort": [10, 5]}}


def drawn(client: TestClient, body: dict[str, Any], robot: str = "planar_2r") -> bytes:
    answer = client.post(f"/v1/robots/{robot}/manipulability", json=body, headers={"accept": "image/svg+xml"})
    assert answer.status_code == 200, answer.text
    assert answer.headers["content-type"] == "image/svg+xml"
    ElementTree.fromstring(answer.content)
    return answer.content


@pytest.mark.slow
def test_what_is_asked_for_changes_the_picture(client: TestClient) -> None:
    body = {"joint_positions": BENT}
    along = {"directions": [[1, 0, 0]]}
    asked: list[dict[str, Any]] = [{}, along, LIMITS, {**LIMITS, **along}, {"task": ["rz"]}]
    pictures = [drawn(client, {**body, **more}) for more in asked]
    assert len(set(pictures)) == len(pictures)
    other = {"polytopes": True, "limits": {"joint_velocity": [2, 2], "joint_effort": [10, 5]}}
    assert drawn(client, {**body, **other}) != pictures[2]


@pytest.mark.slow
def test_limits_that_the_description_does_not_give_are_said_to_be_missing(client: TestClient) -> None:
    assert drawn(client, {"joint_positions": BENT, "polytopes": True}) != drawn(client, {"joint_positions": BENT})


@pytest.mark.parametrize(
    ("robot", "body"),
    [
        ("panda", {"joint_positions": [[0.1] * 7], "polytopes": True}),
        ("planar_2r", {"joint_positions": BENT, "task": ["rz"], **LIMITS}),
    ],
)
def test_polytopes_that_cannot_be_drawn_are_refused(client: TestClient, robot: str, body: dict[str, Any]) -> None:
    answer = client.post(f"/v1/robots/{robot}/manipulability", json=body, headers={"accept": "image/png"})
    assert answer.status_code == 422
    assert answer.json()["pointer"] == "#/polytopes"
    assert "plane" in answer.json()["detail"]


def test_polytopes_of_a_task_in_a_plane_are_drawn_of_any_arm(client: TestClient) -> None:
    body = {"joint_positions": [[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]], "task": ["x", "z"], "polytopes": True}
    drawn(client, body, "ur5")
