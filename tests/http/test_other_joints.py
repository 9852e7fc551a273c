"""Contacts of an arm whose fingers stand somewhere, in every call that knows a scene; `collisions` is the other way."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.http.test_jobs import ended

GRASP = {"position": [0.5, 0.0, 0.4], "rpy": [3.141592653589793, 0.0, 0.0]}
CHEEKS = {
    "objects": [
        {
            "name": f"cheek {side:+}",
            "shape": {"type": "box", "size": [0.02, 0.01, 0.02]},
            "pose": {"position": [0.5, 0.04 * side, 0.4]},
        }
        for side in (1, -1)
    ]
}
"""A fixture around the tip: the fingers are clear of it closed, and touch it where they are open."""
OPEN, CLOSED = {"panda_finger_joint1": 0.04}, {"panda_finger_joint1": 0.0}
TIP = {"tip_frame": "panda_hand_tcp"}
ROBOT = "/v1/robots/panda"


def ask(client: TestClient, call: str, fingers: dict[str, float] | None, **body: Any) -> Any:
    answer = client.post(f"{ROBOT}/{call}", json={**TIP, "scene": CHEEKS, "other_joints": fingers, **body})
    assert answer.status_code == 200, answer.text
    return answer.json()


def later(client: TestClient, call: str, fingers: dict[str, float], **body: Any) -> Any:
    """The result of a job."""
    body = {**TIP, "scene": CHEEKS, "other_joints": fingers, **body}
    answer = client.post(f"{ROBOT}/{call}", json=body, headers={"Prefer": "respond-async"})
    assert answer.status_code == 202, answer.text
    assert ended(lambda: client.get(answer.headers["location"]).json())["state"] == "succeeded"
    return client.get(f"{answer.headers['location']}/result").json()


@pytest.fixture(scope="module")
def grasp(client: TestClient) -> list[float]:
    """A configuration with the fingertips between the cheeks, free where the fingers are closed."""
    q: list[float] = ask(client, "ik", CLOSED, targets=[GRASP])["results"][0]["solutions"][0]["joint_positions"]
    return q


def test_fingers_decide_which_solutions_are_free(client: TestClient, grasp: list[float]) -> None:
    results = {
        name: ask(client, "ik", at, targets=[GRASP])["results"][0] for name, at in (("open", OPEN), ("shut", {}))
    }
    assert (results["open"]["status"], results["shut"]["status"]) == ("in_collision", "solved")
    (free,), hit = results["shut"]["solutions"], results["open"]["nearest"]
    assert free["joint_positions"] == grasp
    assert {hit["pair"]["a"], hit["pair"]["b"]} & {"cheek +1", "cheek -1"}
    for fingers, solution in ((CLOSED, free), (OPEN, hit)):
        at = {"joint_positions": [solution["joint_positions"]], "clearance": True}
        (seen,) = ask(client, "collisions", fingers, **at)["results"]
        assert (seen["clearance"], seen["pairs"]) == (solution["clearance"], [solution["pair"]])


def test_marked_branches_and_a_job_are_about_the_same_fingers(client: TestClient) -> None:
    call: dict[str, Any] = {"targets": [GRASP], "solutions": "all", "fixed_joints": {"panda_joint7": 0.8}}
    shut, wide = (ask(client, "ik", fingers, **call)["results"] for fingers in (CLOSED, OPEN))
    assert not all(one["in_collision"] for one in shut[0]["solutions"])
    assert all(one["in_collision"] for one in wide[0]["solutions"])
    assert later(client, "ik", OPEN, **call)["results"] == wide


def test_a_motion_keeps_clear_with_its_fingers(client: TestClient, grasp: list[float]) -> None:
    call: dict[str, Any] = {
        "start": grasp,
        "segments": [{"type": "line", "target": {**GRASP, "position": [0.5, 0.0, 0.5]}}],
    }
    above = ask(client, "trajectory", CLOSED, **call)["joint_positions"][-1]
    down: dict[str, Any] = {"start": above, "segments": [{"type": "line", "target": GRASP}]}
    shut, wide = (ask(client, "trajectory", fingers, **down) for fingers in (CLOSED, OPEN))
    assert (shut["failure"], wide["failure"]["reason"]) == (None, "collision")
    assert "finger" in wide["failure"]["first_contact"]["pair"]["a"]
    at = {"joint_positions": wide["joint_positions"], "clearance": True}
    seen = ask(client, "collisions", OPEN, **at)["results"]
    assert 0.0 < min(one["clearance"] for one in seen) < 1e-3
    assert later(client, "trajectory", OPEN, **down)["failure"] == wide["failure"]
    many: dict[str, Any] = {"starts": [grasp], "targets": [[*grasp[:6], grasp[6] + 1e-3]]}
    for fingers, passed in ((CLOSED, True), (OPEN, False)):
        (motion,) = ask(client, "trajectories", fingers, **many)["results"]
        assert motion["passed"] is passed
        assert later(client, "trajectories", fingers, **many)["results"] == [motion]


def test_the_clearance_of_a_velocity_is_that_of_the_fingers(client: TestClient, grasp: list[float]) -> None:
    at = {"joint_positions": [grasp]}
    for fingers in (CLOSED, OPEN):
        (rate,) = ask(client, "velocity", fingers, **at, twists=[[0.0, 0.0, 0.1, 0.0, 0.0, 0.0]])["results"]
        (seen,) = ask(client, "collisions", fingers, **at, clearance=True)["results"]
        assert rate["clearance"]["value"] == pytest.approx(seen["clearance"], abs=1e-9)


def test_a_workspace_counts_what_is_free_with_these_fingers(client: TestClient) -> None:
    """A hand that turns past a post."""
    shape = {"type": "box", "size": [0.01, 0.01, 0.01]}
    post = {"name": "post", "shape": shape, "attached_to": "panda_link6", "pose": {"position": [0.088, -0.06, 0.2]}}
    alone = {"base_frame": "panda_link6", "scene": {"objects": [post]}}
    turns = np.linspace(-2.8973, 2.8973, 2001)[:, None].tolist()
    shares = []
    for fingers in (CLOSED, OPEN):
        found = later(client, "workspace", fingers, **alone, kind="cloud", samples=2000)
        seen = ask(client, "collisions", fingers, **alone, joint_positions=turns, pairs="none")["results"]
        shares.append(found["samples_free"] / 2000)
        assert shares[-1] == pytest.approx(sum(not one["in_collision"] for one in seen) / 2001, abs=0.01)
    assert shares[0] > shares[1] + 0.02


@pytest.mark.parametrize(
    ("fields", "pointer", "words"),
    [
        ({"other_joints": {"panda_joint1": 0.0}}, "/other_joints", "panda_finger_joint1"),
        ({"other_joints": {"thumb": 0.0}}, "/other_joints", "'thumb' is no independent joint off the chain"),
        ({"other_joints": {"panda_finger_joint1": "open"}}, "/other_joints/panda_finger_joint1", "number"),
        ({"other_joints": [0.04]}, "/other_joints", "should be an object"),
        ({"other_joints": OPEN, "scene": None}, "/other_joints", "with a `scene` or a `min_clearance` only"),
    ],
)
@pytest.mark.parametrize("prefer", ["", "respond-async"])
def test_joints_that_are_none_are_refused(
    client: TestClient, fields: dict[str, Any], pointer: str, words: str, prefer: str
) -> None:
    q = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
    calls: dict[str, dict[str, Any]] = {
        "ik": {"targets": [GRASP]},
        "trajectory": {"start": q, "segments": [{"type": "joint", "target": q}]},
        "trajectories": {"starts": [q], "targets": [q]},
        "workspace": {"kind": "cloud", "samples": 100},
    }
    for call, body in calls.items():
        whole = {**TIP, **body, "scene": CHEEKS, **fields}
        answer = client.post(f"{ROBOT}/{call}", json=whole, headers={"Prefer": prefer} if prefer else {})
        assert answer.status_code == 422, answer.text
        assert pointer in answer.text
        assert words in answer.text


def test_fingers_stand_beside_an_array_too(client: TestClient) -> None:
    stream = BytesIO()
    np.save(stream, np.array([[0.5, 0.0, 0.4, 1.0, 0.0, 0.0, 0.0]]))
    assert client.post("/v1/scenes", json={"name": "cheeks", **CHEEKS}).status_code == 201
    unsolved = [
        client.post(
            f"{ROBOT}/ik",
            params={**TIP, "scene": "cheeks", "other_joints": fingers},
            content=stream.getvalue(),
            headers={"Content-Type": "application/x-npy", "Accept": "application/x-npy"},
        ).headers["gelenk-unsolved"]
        for fingers in ('{"panda_finger_joint1": 0.04}', '{"panda_finger_joint1": 0}')
    ]
    client.delete("/v1/scenes/cheeks")
    assert unsolved == ["1", "0"]
