"""Dynamics over HTTP: what the answer holds, and every way to ask wrongly."""

import time
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.dynamics import DynamicsAnswer
from tests.speed import is_within

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
MOVING = {"joint_positions": [READY], "joint_velocities": [[0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7]]}


def ask(client: TestClient, body: dict[str, Any], robot: str = "panda") -> dict[str, Any]:
    """The answer, which is what its model says."""
    answer = client.post(f"/v1/robots/{robot}/dynamics", json=body)
    assert answer.status_code == 200, answer.text
    DynamicsAnswer.model_validate_json(answer.content)
    content: dict[str, Any] = answer.json()
    return content


def test_the_terms_make_the_torques(client: TestClient) -> None:
    accelerations = [[1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 4.0]]
    wrenches = [[1.0, 2.0, 3.0, 0.1, 0.2, 0.3]]
    answer = ask(client, {**MOVING, "joint_accelerations": accelerations, "wrenches": wrenches})
    M, C = np.array(answer["mass_matrices"][0]), np.array(answer["coriolis_matrices"][0])
    v = np.array(MOVING["joint_velocities"][0])
    g, held = np.array(answer["gravity_torques"][0]), np.array(answer["wrench_torques"][0])
    assert answer["torques"][0] == pytest.approx(M @ accelerations[0] + C @ v + g + held, abs=1e-11)
    assert answer["coriolis_torques"][0] == pytest.approx(C @ v, abs=1e-13)
    assert answer["kinetic_energies"] == pytest.approx([v @ M @ v / 2], abs=1e-13)
    assert "joint_accelerations" not in answer
    back = ask(client, {**MOVING, "torques": answer["torques"], "wrenches": wrenches, "terms": []})
    assert back["joint_accelerations"][0] == pytest.approx(accelerations[0], abs=1e-9)
    assert back["certificate"]["max_round_trip_error"] < 1e-9
    assert "mass_matrices" not in back


def test_statics_is_dynamics_at_rest(client: TestClient) -> None:
    loads = {"wrenches": [[1.0, 2.0, 3.0, 0.1, 0.2, 0.3]], "payload": {"mass": 2.0, "center_of_mass": [0.1, 0.0, 0.2]}}
    still = client.post(
        "/v1/robots/panda/statics",
        json={"joint_positions": [READY], "gravity": True, "reference": "local", **loads},
    ).json()
    moving = ask(client, {"joint_positions": [READY], "joint_accelerations": [[0] * 7], "reference": "local", **loads})
    assert moving["torques"][0] == pytest.approx(still["torques"][0], abs=1e-11)
    assert moving["gravity_torques"][0] == pytest.approx(still["gravity_torques"][0], abs=1e-11)


def test_gravity_off_and_as_a_vector(client: TestClient) -> None:
    body = {"joint_positions": [READY], "terms": ["gravity_torques"]}
    on, vector, off = (ask(client, {**body, "gravity": gravity}) for gravity in (True, [0.0, 0.0, -9.81], False))
    assert on["gravity_torques"] == vector["gravity_torques"]
    assert on["gravity"] == [0.0, 0.0, -9.81]
    assert np.abs(off["gravity_torques"]).max() == 0.0


def test_a_batch_is_what_its_entries_are_alone(client: TestClient) -> None:
    rng = np.random.default_rng(0)
    qs, v, t = (rng.uniform(-1, 1, (20, 7)).tolist() for _ in range(3))
    batch = ask(client, {"joint_positions": qs, "joint_velocities": v, "torques": t})
    assert batch["certificate"]["samples"] == 16
    for k in (0, 7, 19):
        alone = ask(client, {"joint_positions": [qs[k]], "joint_velocities": [v[k]], "torques": [t[k]]})
        for field in ("mass_matrices", "coriolis_torques", "joint_accelerations"):
            assert np.array(batch[field][k]) == pytest.approx(np.array(alone[field][0]), abs=1e-12), field


def test_a_hand_whose_fingers_follow(client: TestClient) -> None:
    """Both fingers of the Panda move with one variable, so that it carries the mass of both."""
    body = {"joint_positions": [[0.02]], "base_frame": "panda_hand", "tip_frame": "panda_leftfinger"}
    answer = ask(client, {**body, "torques": [[1.0]], "gravity": False})
    assert answer["joint_names"] == ["panda_finger_joint1"]
    assert answer["joint_accelerations"][0][0] * answer["mass_matrices"][0][0][0] == pytest.approx(1.0)


def test_the_masses_of_a_table_are_called_placeholders(client: TestClient) -> None:
    assert "placeholders" in ask(client, {"joint_positions": [[0.3, 0.8]]}, "planar_2r")["notes"][0]
    assert ask(client, MOVING)["notes"] == []


def test_a_frame_that_other_joints_move_and_one_that_is_none(client: TestClient) -> None:
    body = {**MOVING, "wrenches": [[1, 2, 3, 4, 5, 6]], "tip_frame": "panda_hand", "terms": []}
    by_finger = ask(client, {**body, "expressed_in": "panda_leftfinger"})
    by_hand = ask(client, {**body, "reference": "local"})
    assert by_finger["wrench_torques"][0] == pytest.approx(by_hand["wrench_torques"][0])
    for field in ("base_frame", "tip_frame", "expressed_in", "point_frame"):
        answer = client.post("/v1/robots/panda/dynamics", json={**body, field: "nose"})
        assert (answer.status_code, answer.json()["pointer"]) == (404, f"#/{field}")


def test_an_arm_without_inertia(client: TestClient) -> None:
    text = (
        '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/>'
        '<child link="b"/></joint></robot>'
    )
    assert client.post("/v1/robots", json={"name": "ghost", "urdf": text}).status_code == 201
    answer = ask(client, {"joint_positions": [[0.3]], "joint_accelerations": [[1.0]]}, "ghost")
    assert answer["torques"] == [[0.0]]
    assert "'b'" in answer["notes"][0]
    assert any("singular" in note for note in answer["notes"])
    refused = client.post("/v1/robots/ghost/dynamics", json={"joint_positions": [[0.3]], "torques": [[1.0]]})
    assert refused.status_code == 422
    assert refused.json()["field"] == "torques"
    assert "'j'" in refused.json()["detail"]
    assert "'b'" in refused.json()["detail"]


@pytest.mark.parametrize(
    ("query", "shape"),
    [
        ("", (10, 7, 7)),
        ("?terms=gravity_torques", (10, 7)),
        ("?terms=coriolis_matrix&gravity=false", (10, 7, 7)),
        ("?terms=energies", (10, 2)),
    ],
)
def test_npy(client: TestClient, query: str, shape: tuple[int, ...]) -> None:
    buffer = BytesIO()
    np.save(buffer, np.random.default_rng(1).uniform(-1, 1, (10, 7)))
    headers = {"content-type": "application/x-npy", "accept": "application/x-npy"}
    answer = client.post(f"/v1/robots/panda/dynamics{query}", content=buffer.getvalue(), headers=headers)
    assert answer.status_code == 200, answer.text
    assert np.load(BytesIO(answer.content)).shape == shape


def test_npy_of_accelerations_and_of_nothing(client: TestClient) -> None:
    headers = {"accept": "application/x-npy"}
    path = "/v1/robots/panda/dynamics"
    answer = client.post(path, json={**MOVING, "torques": [[1.0] * 7]}, headers=headers)
    expected = ask(client, {**MOVING, "torques": [[1.0] * 7]})["joint_accelerations"]
    assert np.load(BytesIO(answer.content)).tolist() == expected
    assert client.post(path, json={**MOVING, "terms": []}, headers=headers).status_code == 422


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"torques": [[1] * 7], "joint_accelerations": [[1] * 7]}, "torques"),
        ({"joint_velocities": [[1] * 6]}, "panda_joint1"),
        ({"joint_velocities": [[1] * 7] * 2}, "joint_velocities"),
        ({"joint_velocities": []}, "joint_velocities"),
        ({"joint_velocities": [[1e300] * 7]}, "joint_velocities"),
        ({"joint_accelerations": [[1] * 8]}, "panda_joint1"),
        ({"joint_accelerations": [[1e7] * 7]}, "joint_accelerations"),
        ({"torques": [[1e300] * 7]}, "torques"),
        ({"torques": [{"nose": 1.0}]}, "nose"),
        ({"wrenches": [[1, 2]]}, "wrenches"),
        ({"wrenches": [[1] * 6] * 3}, "wrenches"),
        ({"payload": {"mass": -1}}, "mass"),
        ({"payload": {"mass": 1e9}}, "mass"),
        ({"payload": {"mass": 1, "inertia": [1, 2, 3]}}, "inertia"),
        ({"payload": {"mass": 1, "inertia": [0, 1, 0, 0, 0, 0]}}, "payload"),
        ({"payload": {"center_of_mass": [0, 0, 0]}}, "mass"),
        ({"gravity": 9.81}, "gravity"),
        ({"gravity": [0, 0, 9.81, 0]}, "gravity"),
        ({"terms": ["friction"]}, "terms"),
        ({"reference": "world", "point": [0, 0, 0]}, "point"),
        ({"terms": ["mass_matrix", "mass_matrix"]}, "each term at most once"),
        ({"reference": "local"}, "#/reference"),
        ({"expressed_in": "panda_link3"}, "#/expressed_in"),
        ({"point": [0, 0, 0.1]}, "#/point"),
        ({"joint_positions": [], "joint_velocities": [[0] * 7]}, "#/joint_positions"),
        ({"joint_positions": [], "torques": [[0] * 7]}, "#/joint_positions"),
        ({"joint_positions": [[4] * 7], "respect_limits": True}, "panda_joint1"),
        ({"friction": True}, "friction"),
    ],
)
def test_a_call_that_makes_no_sense(client: TestClient, change: dict[str, Any], word: str) -> None:
    started = time.process_time()
    answer = client.post("/v1/robots/panda/dynamics", json={"joint_positions": [READY], **change})
    assert is_within(time.process_time() - started, 1.0)
    assert answer.status_code == 422, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert word in answer.text


def test_more_than_an_answer_holds(client: TestClient) -> None:
    buffer = BytesIO()
    np.save(buffer, np.zeros((200_000, 7)))
    headers = {"content-type": "application/x-npy", "accept": "application/x-npy"}
    answer = client.post("/v1/robots/panda/dynamics", content=buffer.getvalue(), headers=headers)
    assert answer.status_code == 413


@pytest.mark.parametrize(("robot", "n"), [("panda", 7), ("planar_2r", 2), ("scara", 4), ("iris", 1)])
def test_the_largest_numbers_that_are_allowed(client: TestClient, robot: str, n: int) -> None:
    """No rounding of theirs is taken for a mistake, and no answer is anything but finite."""
    body = {
        "joint_positions": [[1e6 if i % 2 else -1e6 for i in range(n)]],
        "joint_velocities": [[1e6] * n],
        "gravity": [1e3, -1e3, 1e3],
        "point": [1e6, -1e6, 1e6],
        "wrenches": [[1e6] * 6],
    }
    heavy = {"mass": 1e6, "center_of_mass": [1e3, -1e3, 1e3], "inertia": [1e9, 0, 0, 1e9, 0, 1e9]}
    for payload in (None, heavy, {"mass": 1e-300}):
        answer = ask(client, {**body, "payload": payload, "joint_accelerations": [[-1e6] * n]}, robot)
        assert np.isfinite(answer["torques"]).all()
        forward = {**body, "payload": payload, "torques": [[1e6] * n]}
        reply = client.post(f"/v1/robots/{robot}/dynamics", json=forward)
        if payload is heavy and robot in {"panda", "scara"}:
            # A thousand tons on a wrist of a few kilogrammes: no digit is left of the lighter joints' inertia.
            assert (reply.status_code, reply.json()["field"]) == (422, "torques"), reply.text
            assert "singular" in reply.json()["detail"]
        else:
            assert reply.status_code == 200, reply.text
            assert np.isfinite(reply.json()["joint_accelerations"]).all()
