"""Statics over HTTP: what the answer holds, and every way to ask wrongly."""

import time
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.statics import StaticsAnswer
from tests.speed import is_within

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
PLANAR = {"joint_positions": [[0.3, 0.8]], "task": ["x", "y"]}


def ask(client: TestClient, body: dict[str, Any], robot: str = "panda") -> dict[str, Any]:
    """The answer, which is what its model says."""
    answer = client.post(f"/v1/robots/{robot}/statics", json=body)
    assert answer.status_code == 200, answer.text
    StaticsAnswer.model_validate_json(answer.content)
    content: dict[str, Any] = answer.json()
    return content


def test_torques_of_the_course(client: TestClient) -> None:
    answer = ask(client, {**PLANAR, "wrenches": [[10.0, -5.0]]}, "planar_2r")
    # The catalogue's arm has the lengths of the course's example.
    assert answer["torques"][0] == pytest.approx([-15.557922457661, -7.826037945420], abs=1e-12)
    assert answer["task"] == ["x", "y"]
    assert answer["gravity"] is None
    assert answer["balance"] is None
    assert answer["certificate"]["max_virtual_work_error"] < 1e-10
    back = ask(client, {**PLANAR, "torques": answer["torques"]}, "planar_2r")
    assert back["wrenches"][0] == pytest.approx([10, -5], abs=1e-11)
    assert back["balance"]["is_balanced"] == [True]
    assert back["balance"]["is_unique"] == [True]
    assert back["balance"]["free_wrenches"] == [[]]


def test_subspaces_and_tests_of_the_stretched_arm(client: TestClient) -> None:
    body = {
        "joint_positions": [[0.3, 0.0]],
        "task": ["x", "y"],
        "test_twists": [[-0.295520206661256, 0.955336489125606], [1.0, 0.0]],
        "test_wrenches": [[0.955336489125606, 0.295520206661256]],
        "test_torques": [[1.7, 0.7], [0.7, -1.7]],
        "test_joint_velocities": [[0.7, -1.7], [0.0, 0.0]],
    }
    (split,) = ask(client, body, "planar_2r")["subspaces"]
    assert split["rank"] == 1
    assert split["dimensions"] == {"range": 1, "left_kernel": 1, "row_space": 1, "kernel": 1}
    members = {name: [test["member_of"] for test in split[name]] for name in ("twists", "wrenches", "torques")}
    assert members == {
        "twists": [["range"], []],
        "wrenches": [["left_kernel"]],
        "torques": [["row_space"], ["kernel"]],
    }
    assert [test["member_of"] for test in split["joint_velocities"]] == [["kernel"], ["row_space", "kernel"]]
    parts = split["twists"][1]["components"]
    assert np.sum(list(parts.values()), axis=0) == pytest.approx([1, 0])
    assert np.dot(*parts.values()) == pytest.approx(0)


def test_an_unbalanced_torque(client: TestClient) -> None:
    answer = ask(client, {"joint_positions": [READY], "torques": [[1.0] * 7], "subspaces": True})
    kernel = np.array(answer["subspaces"][0]["kernel"])
    residual = np.array(answer["balance"]["residual_torques"][0])
    assert answer["balance"]["is_balanced"] == [False]
    assert residual == pytest.approx(kernel[0] * (kernel[0] @ np.ones(7)), abs=1e-12)


def test_weight_and_payload(client: TestClient) -> None:
    empty = ask(client, {"joint_positions": [READY], "gravity": True})
    full = ask(client, {"joint_positions": [READY], "gravity": [0.0, 0.0, -9.81], "payload": {"mass": 1.0}})
    down = ask(client, {"joint_positions": [READY], "wrenches": [[0, 0, 9.81, 0, 0, 0]]})
    difference = np.array(full["torques"]) - np.array(empty["torques"])
    assert difference == pytest.approx(np.array(down["torques"]), abs=1e-12)
    assert empty["torques"] == empty["gravity_torques"]
    assert empty["wrenches"] is None
    assert empty["root_frame"] == "panda_link0"
    assert empty["notes"] == []


def test_one_wrench_for_all_and_one_each(client: TestClient) -> None:
    qs = [READY, [0.1] * 7, [0.2] * 7, [-0.3] * 7]
    wrenches = np.random.default_rng(0).uniform(-1, 1, (4, 6)).tolist()
    each = ask(client, {"joint_positions": qs, "wrenches": wrenches, "reference": "local"})
    for k, (q, wrench) in enumerate(zip(qs, wrenches, strict=True)):
        alone = ask(client, {"joint_positions": [q], "wrenches": [wrench], "reference": "local"})
        assert each["torques"][k] == pytest.approx(alone["torques"][0], abs=1e-13)
    same = ask(client, {"joint_positions": qs, "wrenches": [wrenches[1]], "reference": "local"})
    assert same["torques"][1] == each["torques"][1]
    assert same["wrenches"] == [wrenches[1]] * 4


def test_point_and_axes(client: TestClient) -> None:
    body = {
        "joint_positions": [READY],
        "wrenches": [[1.0, 2.0, 3.0, 0.0, 0.0, 0.0]],
        "tip_frame": "panda_hand",
        "point": [0.0, 0.0, 0.1034],
        "expressed_in": "panda_link0",
    }
    by_frame = ask(client, {**body, "tip_frame": "panda_hand_tcp", "point": None, "expressed_in": None})
    assert ask(client, body)["torques"][0] == pytest.approx(by_frame["torques"][0], abs=1e-12)


def test_overload_and_joints_by_name(client: TestClient) -> None:
    names = [f"panda_joint{i}" for i in range(1, 8)]
    torques = dict.fromkeys(names, 0.0) | {"panda_joint7": 20.0}
    answer = ask(client, {"joint_positions": [dict(zip(names, READY, strict=True))], "torques": [torques]})
    assert answer["overloaded_joints"] == [["panda_joint7"]]


def test_a_frame_that_other_joints_move(client: TestClient) -> None:
    """A finger at zero has the axes of the hand."""
    body = {"joint_positions": [READY], "wrenches": [[1, 2, 3, 4, 5, 6]], "tip_frame": "panda_hand"}
    by_finger = ask(client, {**body, "expressed_in": "panda_leftfinger"})
    assert by_finger["torques"][0] == pytest.approx(ask(client, {**body, "reference": "local"})["torques"][0])


def test_rounding_is_no_rank_and_tolerances_are_told(client: TestClient) -> None:
    body = {"joint_positions": [[np.pi, 0.0]], "task": ["x"], "subspaces": True}
    answer = ask(client, body, "planar_2r")
    assert answer["subspaces"][0]["rank"] == 0
    assert (answer["rank_tolerance"], answer["membership_tolerance"]) == (1e-10, 1e-9)


def test_the_masses_of_a_table_are_called_placeholders(client: TestClient) -> None:
    weighed = ask(client, {"joint_positions": [[0.3, 0.8]], "gravity": True}, "planar_2r")
    assert "placeholders" in weighed["notes"][0]
    assert "URDF" in weighed["notes"][0]
    pushed = ask(client, {**PLANAR, "wrenches": [[1, 2]]}, "planar_2r")
    assert pushed["notes"] == []


def test_links_without_mass_are_told(client: TestClient) -> None:
    text = (
        '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/>'
        '<child link="b"/></joint></robot>'
    )
    assert client.post("/v1/robots", json={"name": "light", "urdf": text}).status_code == 201
    answer = ask(client, {"joint_positions": [[0.3]], "gravity": True, "payload": {"mass": 1.0}}, "light")
    assert "'b'" in answer["notes"][0]
    assert "mass" in answer["notes"][1]
    assert "notes" in ask(client, {"joint_positions": [[0.3]], "wrenches": [[1] * 6]}, "light")


def test_npy(client: TestClient) -> None:
    qs = np.random.default_rng(1).uniform(-1, 1, (20, 7))
    buffer = BytesIO()
    np.save(buffer, qs)
    headers = {"content-type": "application/x-npy", "accept": "application/x-npy"}
    path = "/v1/robots/panda/statics?gravity=true"
    answer = client.post(path, content=buffer.getvalue(), headers=headers)
    assert answer.status_code == 200, answer.text
    torques = np.load(BytesIO(answer.content))
    expected = ask(client, {"joint_positions": qs.tolist(), "gravity": True})["torques"]
    assert torques == pytest.approx(np.array(expected), abs=1e-13)
    refused = client.post(path + "&subspaces=true", content=buffer.getvalue(), headers=headers)
    assert refused.status_code == 422


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"wrenches": [[1, 2, 3]]}, "wrenches"),
        ({"wrenches": [[1] * 7]}, "wrenches"),
        ({"wrenches": [[1] * 6] * 3}, "wrenches"),
        ({"wrenches": []}, "wrenches"),
        ({"wrenches": [[1e300] * 6]}, "wrenches"),
        ({"wrenches": [["1"] * 6]}, "wrenches"),
        ({"wrenches": [[1] * 6], "torques": [[1] * 7]}, "torques"),
        ({"torques": [[1] * 6]}, "panda_joint1"),
        ({"torques": [[1e300] * 7]}, "torques"),
        ({"torques": [{"panda_joint1": 1.0}]}, "panda_joint2"),
        ({"gravity": [0, 0]}, "gravity"),
        ({"gravity": [0, 0, -1e300]}, "gravity"),
        ({"gravity": "down"}, "gravity"),
        ({"gravity": True, "payload": {"mass": -1}}, "mass"),
        ({"gravity": True, "payload": {"mass": 0}}, "mass"),
        ({"gravity": True, "payload": {"mass": 1, "center_of_mass": [0, 0]}}, "center_of_mass"),
        ({"gravity": True, "payload": {"mass": 1, "inertia": [1, 0, 0, 1, 0, 9]}}, "payload"),
        ({"gravity": True, "payload": {"mass": 1, "inertia": [-1, 0, 0, -1, 0, -1]}}, "payload"),
        ({"payload": {"mass": 1}}, "payload"),
        ({"task": []}, "task"),
        ({"task": ["x", "x"]}, "task"),
        ({"task": ["up"]}, "task"),
        ({"task": ["x", "y"], "wrenches": [[1] * 6]}, "wrenches"),
        ({"test_twists": [[1] * 7]}, "test_twists"),
        ({"test_torques": [[1] * 6]}, "test_torques"),
        ({"test_wrenches": [[1] * 6] * 101}, "test_wrenches"),
        ({"test_joint_velocities": [[float("1e300")] * 7]}, "test_joint_velocities"),
        ({"rank_tolerance": 0}, "rank_tolerance"),
        ({"membership_tolerance": 1}, "membership_tolerance"),
        ({"reference": "tip"}, "reference"),
        ({"reference": "local", "expressed_in": "panda_link0"}, "expressed_in"),
        ({"reference": "world", "point": [0, 0, 0]}, "point"),
        ({"point_frame": "panda_link0"}, "point_frame"),
        ({"point": [0, 0]}, "point"),
        ({"joint_positions": [[4] * 7], "respect_limits": True, "gravity": True}, "panda_joint1"),
        ({}, "give `wrenches`, `torques` or `gravity`"),
        ({"gravity": True, "reference": "local"}, "#/reference"),
        ({"gravity": True, "expressed_in": "panda_link3"}, "#/expressed_in"),
        ({"gravity": True, "point": [0, 0, 0]}, "#/point"),
        ({"gravity": True, "task": ["x"]}, "#/task"),
        ({"weight": True}, "weight"),
    ],
)
def test_a_call_that_makes_no_sense(client: TestClient, change: dict[str, Any], word: str) -> None:
    started = time.process_time()
    answer = client.post("/v1/robots/panda/statics", json={"joint_positions": [READY], **change})
    assert is_within(time.process_time() - started, 1.0)
    assert answer.status_code == 422, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert word in answer.text


@pytest.mark.parametrize("number", [b"NaN", b"Infinity", b"1e400", b"null", b"true", b'"1"'])
def test_numbers_that_are_none(client: TestClient, number: bytes) -> None:
    for field in (b'"wrenches": [[%s,0,0,0,0,0]]', b'"gravity": [%s,0,0]', b'"point": [%s,0,0]', b'"torques": [[%s]]'):
        body = b'{"joint_positions": [[0,0,0,0,0,0,0]], ' + field % number + b"}"
        answer = client.post("/v1/robots/panda/statics", content=body, headers={"content-type": "application/json"})
        assert answer.status_code in {400, 422}, answer.text


def test_unknown_frame_and_too_many(client: TestClient) -> None:
    path = "/v1/robots/planar_2r/statics"
    for field in ("base_frame", "tip_frame", "expressed_in", "point_frame"):
        answer = client.post(path, json={**PLANAR, field: "nose"})
        assert answer.status_code == 404
        assert (answer.json()["field"], answer.json()["pointer"]) == (field, f"#/{field}")
        assert f"'{field}'" in answer.json()["detail"]
    answer = client.post(path, json={"joint_positions": [[0.0, 0.0]] * 20_001, "subspaces": True})
    assert answer.status_code == 413


def test_the_largest_numbers_that_are_allowed(client: TestClient) -> None:
    """No rounding of theirs is taken for a mistake."""
    body = {
        "joint_positions": [[1e6, -1e6, 1e6, -1e6, 1e6, -1e6, 1e6]],
        "gravity": [1e3, -1e3, 1e3],
        "payload": {"mass": 1e6, "center_of_mass": [1e3, -1e3, 1e3], "inertia": [1e9, 0, 0, 1e9, 0, 1e9]},
        "point": [1e6, -1e6, 1e6],
        "rank_tolerance": 0.5,
    }
    for loads in ({"wrenches": [[1e6] * 6]}, {"torques": [[-1e6] * 7]}, {"torques": [[1e-300] * 7]}):
        answer = ask(client, {**body, **loads})
        assert np.isfinite(answer["torques"]).all()
