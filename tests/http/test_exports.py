"""A robot in other notations over HTTP: screws, MJCF, and the files of its table; and a robot given as screws."""

from typing import Any
from xml.etree import ElementTree as xml

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.http.test_kinematics import refusal


def test_screws_come_with_their_certificate(client: TestClient) -> None:
    answer = client.get("/v1/robots/panda/screws?tip_frame=panda_leftfinger").json()
    assert [joint["name"] for joint in answer["joints"]][-1] == "panda_finger_joint1"
    assert answer["certificate"]["max_position_error"] < 1e-12
    jacobian = {"joint_positions": [[0.0] * 8], "tip_frame": "panda_leftfinger"}
    for reference in ("space_screws", "body_screws"):
        found = client.post("/v1/robots/panda/jacobian", json={**jacobian, "reference": reference}).json()
        at_zero = np.array(found["jacobians"][0])
        if reference == "space_screws":
            assert at_zero == pytest.approx(np.array(answer[reference]).T, abs=1e-12)
        assert found["certificate"]["max_error"] < 1e-12
        assert found["reference"] == reference


def test_steps_of_the_screws_say_that_halves_change_places(client: TestClient) -> None:
    call = {"joint_positions": [[0.3, 0.8]], "reference": "body_screws", "steps": True}
    steps = client.post("/v1/robots/planar_2r/jacobian", json=call).json()["steps"][0]
    assert "Angular rows first" in [step["title"] for step in steps]


def test_screws_are_a_robot_again(client: TestClient) -> None:
    given = client.get("/v1/robots/ur5/screws").json()
    screws = {key: given[key] for key in ("home", "space_screws", "body_screws", "joints")}
    added = client.post("/v1/robots", json={"name": "ur5_of_screws", "screws": screws})
    assert added.status_code == 201, added.text
    try:
        assert added.json()["joint_names"] == given["joint_names"]
        call = {"joint_positions": [[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]]}
        poses = [
            client.post(f"/v1/robots/{name}/fk", json={**call, "pose_format": "matrix"}).json()["poses"][0]["matrix"]
            for name in ("ur5", "ur5_of_screws")
        ]
        assert poses[1] == pytest.approx(np.array(poses[0]), abs=1e-12)
        table = client.get("/v1/robots/ur5_of_screws/dh").json()
        assert table["certificate"]["max_position_error"] < 1e-12
    finally:
        client.delete("/v1/robots/ur5_of_screws")


@pytest.mark.parametrize(
    ("screws", "pointer"),
    [
        ({"space_screws": [[0, 0, 2, 0, 0, 0]]}, "#/screws/0"),
        ({"space_screws": [[0, 0, 1, 0, 0]]}, "#/screws/space_screws/0"),
        ({}, "#/screws"),
        ({"space_screws": [[0, 0, 1, 0, 0, 0]], "joints": [{"lower": 2.0, "upper": 1.0}]}, "#/screws/joints/0/lower"),
    ],
)
def test_wrong_screws_are_refused_at_their_place(client: TestClient, screws: dict[str, Any], pointer: str) -> None:
    home = {"position": [1.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]}
    answer = refusal(client, "/v1/robots", {"name": "wrong", "screws": {"home": home, **screws}}, 422)
    places = [error["pointer"] for error in answer.get("errors", [])]
    assert pointer in places or answer["detail"].startswith(f"'{pointer.removeprefix('#/')}': ")


def test_the_mjcf_says_how_far_off_it_is(client: TestClient) -> None:
    answer = client.get("/v1/robots/ur5/mjcf")
    assert answer.headers["content-type"].startswith("application/xml")
    assert "against the robot through Pinocchio at 20 configurations: at most" in answer.text
    assert "<mesh " not in answer.text
    assert 'file="' in client.get("/v1/robots/ur5/mjcf?meshes=true").text


@pytest.mark.parametrize(
    ("kind", "media_type", "part"),
    [
        ("csv", "text/csv", "name,type,a,alpha,d,theta"),
        ("latex", "text/x-tex", r"\begin{array}"),
        ("matlab", "text/x-matlab", "function T = ur5(q)"),
        ("roboticstoolbox", "text/x-python", "RevoluteMDH("),
    ],
)
def test_tables_are_files_for_other_programs(client: TestClient, kind: str, media_type: str, part: str) -> None:
    answer = client.get(f"/v1/robots/ur5/dh?convention=modified&format={kind}")
    assert answer.headers["content-type"].startswith(media_type)
    assert 'filename="ur5.' in answer.headers["content-disposition"]
    assert part in answer.text
    assert "configurations: at most" in answer.text


def test_what_a_format_cannot_say_is_refused(client: TestClient) -> None:
    answer = client.get("/v1/robots/panda/dh?format=roboticstoolbox&base_frame=panda_rightfinger&tip_frame=panda_link8")
    assert answer.status_code == 422
    assert "follows another one" in answer.json()["detail"]
    unknown = client.get("/v1/robots/panda/dh?format=excel")
    assert unknown.status_code == 422
    assert unknown.json()["errors"][0]["pointer"] == "#/format"


def test_a_robot_with_dashes_is_well_formed_and_callable(client: TestClient) -> None:
    dh = client.get("/v1/robots/planar_2r/dh").json()["dh"]
    assert client.post("/v1/robots", json={"name": "a---b", "dh": dh}).status_code == 201
    try:
        assert xml.fromstring(client.get("/v1/robots/a---b/mjcf").text).tag == "mujoco"
        answer = client.get("/v1/robots/a---b/dh?format=matlab")
        assert 'filename="a___b.m"' in answer.headers["content-disposition"]
        assert "function T = a___b(q)" in answer.text
    finally:
        client.delete("/v1/robots/a---b")


def test_arguments_are_those_of_a_xacro(client: TestClient) -> None:
    dh = client.get("/v1/robots/planar_2r/dh").json()["dh"]
    answer = refusal(client, "/v1/robots", {"name": "wrong", "dh": dh, "arguments": {"a": 1}}, 422)
    assert "those of a xacro" in str(answer)
