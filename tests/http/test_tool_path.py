"""The path of a tool that may turn about an axis, over HTTP: the choice, what blocks it, and what is refused."""

import math
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.trajectory_answer import TrajectoryAnswer
from tests.http.test_trajectory_torques import LOAD, by_dynamics

ROBOT = "ur5_joint_limited"
AT = [0.3, -1.2, 1.3, -1.6, -1.2, 0.4]
FREE = {"free": ["rz"], "steps": 18}


def poses(client: TestClient, count: int = 4, step: float = 0.05) -> list[dict[str, Any]]:
    """A seam along y from where the tip is at `AT`, straight but for a bulge."""
    call = {"joint_positions": [AT]}
    first = client.post(f"/v1/robots/{ROBOT}/fk", json=call).json()["poses"][0]
    x, y, z = first["position"]
    offsets = [(0.01 * math.sin(i), step * i) for i in range(count)]
    return [{**first, "position": [x + a, y + b, z]} for a, b in offsets]


def post_motion(client: TestClient, **call: Any) -> Any:
    return client.post(f"/v1/robots/{ROBOT}/trajectory", json=call)


def test_the_answer_has_the_turns_the_branches_and_a_passed_audit(client: TestClient) -> None:
    seam = poses(client)
    answer = post_motion(client, start=AT, path={"poses": seam, **FREE}, law="quintic", steps=True, language="de")
    assert answer.status_code == 200, answer.text[:500]
    found = TrajectoryAnswer.model_validate_json(answer.content)
    assert found.audit.passed
    assert [one.type for one in found.segments] == ["joint", "spline"]
    assert found.path is not None
    assert len(found.path.turns) == len(found.path.branches) == len(found.path.joint_positions) == len(seam)
    assert found.path.joint_travel > 0.0
    assert {"shoulder", "elbow", "wrist"} <= found.path.branches[0].keys()
    ends = {"joint_positions": found.path.joint_positions, "pose_format": "quaternion_xyzw"}
    tips = client.post(f"/v1/robots/{ROBOT}/fk", json=ends).json()["poses"]
    np.testing.assert_allclose([tip["position"] for tip in tips], [pose["position"] for pose in seam], atol=1e-9)
    np.testing.assert_allclose(found.joint_positions[-1], found.path.joint_positions[-1], atol=1e-6)
    assert found.steps is not None


def test_without_a_start_the_motion_begins_at_the_first_pose(client: TestClient) -> None:
    found = post_motion(client, path={"poses": poses(client), "free": []}).json()
    assert found["completed_fraction"] == 1.0
    assert found["path"]["turns"] == [0.0] * 4
    assert found["joint_positions"][0] == pytest.approx(found["path"]["joint_positions"][0], abs=1e-9)


def test_a_seam_that_leaves_the_workspace_ends_where_it_does(client: TestClient) -> None:
    found = post_motion(client, path={"poses": poses(client, 8, 0.2), **FREE}).json()
    assert found["failure"]["reason"] == "out_of_reach"
    assert "way-point" in found["failure"]["detail"]
    assert 0.0 < found["completed_fraction"] < 1.0
    assert 1 <= len(found["path"]["turns"]) < 8


def test_a_seam_keeps_the_torques_that_its_payload_needs(client: TestClient) -> None:
    call = {"path": {"poses": poses(client), **FREE}, "law": "time_optimal", "payload": LOAD, "sample_period": 0.005}
    limits: dict[str, Any] = {"joint_acceleration": 15.0}
    free = post_motion(client, **call, limits=limits).json()
    peak = free["audit"]["joint_torque"]
    most = 0.97 * abs(peak["value"])
    found = post_motion(client, **call, limits={**limits, "joint_torque": {peak["joint"]: most}}, torques=True).json()
    assert found["audit"]["passed"]
    assert found["completed_fraction"] == 1.0
    assert found["path"] == free["path"]
    assert found["duration"] > free["duration"]
    torques = by_dynamics(client, found, ROBOT, payload=LOAD)
    np.testing.assert_allclose(found["joint_torques"], torques, atol=1e-9)
    column = np.abs(torques[:, found["joint_names"].index(peak["joint"])])
    assert 0.98 * most < column.max() <= most * (1.0 + 1e-9)
    unloaded = by_dynamics(client, found, ROBOT)
    assert np.abs(torques - unloaded).max() > 1.0


@pytest.mark.parametrize(
    ("changes", "pointer", "reason"),
    [
        ({"free": ["x"]}, "/path/free/0", "rx"),
        ({"free": ["rx", "ry"]}, "/path/free", "1"),
        ({"free": "rz"}, "/path/free", "array"),
        ({"steps": 0}, "/path/steps", "1"),
        ({"steps": 73}, "/path/steps", "72"),
        ({"poses": []}, "/path/poses", "2"),
        ({"poses": [{"position": [0.0, 0.0, 0.5]}] * 2}, "/path/poses/0", "orientation"),
        ({"poses": [{"position": [0.4, 0.0, 0.5], "rpy": [0.0, 0.0, 0.0]}] * 2}, "/path/poses", "share one position"),
        ({"poses": [{"position": [9.0, i, 0.5], "rpy": [0.0, 0.0, 0.0]} for i in (0, 1)]}, "/path/poses/0", "reach"),
        ({"poses": [{"position": [0.4, 0.0, 0.5], "rpy": [0.0, 0.0, 0.0]}] * 1001}, "/path/poses", "1000"),
    ],
)
def test_a_path_that_cannot_be_is_refused(client: TestClient, changes: Any, pointer: str, reason: str) -> None:
    refused(post_motion(client, path={"poses": poses(client), **FREE, **changes}), pointer, reason)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("segments", [{"type": "joint", "target": AT}]),
        ("start_velocities", [0.0] * 6),
        ("end_velocities", [0.0] * 6),
        ("task", ["x", "y", "z"]),
        ("near_singularity", "damp"),
    ],
)
def test_what_is_not_allowed_beside_a_path_is_refused(client: TestClient, name: str, value: Any) -> None:
    refused(post_motion(client, start=AT, path={"poses": poses(client), **FREE}, **{name: value}), f"/{name}", "path")


@pytest.mark.slow
def test_numbers_that_are_none_and_other_arms_are_refused(client: TestClient) -> None:
    body = '{"path": {"poses": [{"position": [NaN, 0, 0], "rpy": [0, 0, 0]}], "free": []}}'
    headers = {"content-type": "application/json"}
    assert client.post(f"/v1/robots/{ROBOT}/trajectory", content=body, headers=headers).status_code in {400, 422}
    answer = client.post("/v1/robots/baxter/trajectory", json={"path": {"poses": poses(client), **FREE}})
    refused(answer, "/path", "seven joints held")
    refused(post_motion(client, start=AT), "/segments", "path")


def refused(answer: Any, pointer: str, reason: str) -> None:
    assert answer.status_code == 422, answer.text[:500]
    problem = answer.json()
    found = problem.get("errors", [problem])
    assert any(one["pointer"] == f"#{pointer}" and reason in one["detail"] for one in found), problem
