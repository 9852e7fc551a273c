"""Inverse kinematics with joints held: every branch of what remains, refusals, and what the whole arm is told."""

from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.ik import InverseAnswer
from tests.http.test_inverse import ik, refused
from tests.http.test_kinematics import NPY, fk, npy
from tests.robots import robot


def made(name: str, joint: str, value: float, count: int, seed: int = 5) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Random configurations within the limits, one joint at a value."""
    chain = robot(name).chain(None, None)
    qs = np.random.default_rng(seed).uniform(
        np.maximum(chain.lower, -np.pi), np.minimum(chain.upper, np.pi), (count, len(chain))
    )
    qs[:, chain.joint_names.index(joint)] = value
    return qs


def listed(client: TestClient, name: str, joint: str, value: float, count: int, **call: Any) -> tuple[int, int]:
    """How many generators are listed and how many answers are complete; every solution holds the joint."""
    qs = made(name, joint, value, count)
    targets = fk(client, name, joint_positions=qs.tolist())["poses"]
    answer = ik(client, name, targets=targets, solutions="all", fixed_joints={joint: value}, **call)
    j = answer["joint_names"].index(joint)
    found = whole = 0
    for q, result in zip(qs, answer["results"], strict=True):
        table = np.array([solution["joint_positions"] for solution in result["solutions"]]).reshape(-1, len(q))
        assert (table[:, j] == value).all()
        found += bool((np.abs((table - q + np.pi) % (2 * np.pi) - np.pi).max(axis=1, initial=0.0) < 1e-6).any())
        whole += bool(result["complete"])
    return found, whole


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "joint", "value"),
    [("panda", "panda_joint7", 0.6), ("panda", "panda_joint1", -0.3), ("xarm7", "joint7", 0.6)],
)
def test_every_branch_is_listed_where_a_joint_of_seven_is_held(
    client: TestClient, name: str, joint: str, value: float
) -> None:
    found, whole = listed(client, name, joint, value, 12)
    assert found == 12
    assert whole >= 10


@pytest.mark.slow
@pytest.mark.parametrize("joint", range(7))
@pytest.mark.parametrize("name", ["panda", "xarm7"])
def test_each_joint_of_seven_can_be_held(client: TestClient, name: str, joint: int) -> None:
    chain = robot(name).chain(None, None)
    value = 0.37 * chain.lower[joint] + 0.63 * chain.upper[joint] if np.isfinite(chain.lower[joint]) else 0.6
    found, _ = listed(client, name, chain.joint_names[joint], float(value), 100)
    assert found >= 99


@pytest.mark.parametrize(
    "call", [{}, {"method": "newton", "trace": True}, {"objective": "limits"}, {"solutions": "all"}]
)
def test_a_held_joint_stays_in_every_mode(client: TestClient, call: dict[str, Any]) -> None:
    """Also of an arm of which five joints remain, and of what comes nearest to a target out of reach."""
    q = [0.1, -0.9, 1.2, 0.3, 0.8, 0.2]
    pose = fk(client, "ur5", joint_positions=[q])["poses"][0]
    far = {"position": [9.0, 0.0, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
    answer = ik(
        client,
        "ur5",
        targets=[pose, far],
        seeds=[np.add(q, 0.02).tolist()],
        fixed_joints={"wrist_2_joint": 0.8},
        **call,
    )
    for solution in answer["results"][0]["solutions"]:
        assert solution["joint_positions"][4] == 0.8
    np.testing.assert_allclose(answer["results"][0]["solutions"][0]["joint_positions"], q, atol=1e-4)
    assert answer["results"][1]["nearest"]["joint_positions"][4] == 0.8
    for step in answer["results"][0].get("trace") or []:
        assert step["joint_positions"][4] == 0.8


@pytest.mark.parametrize(
    ("fixed", "field", "allowed"),
    [
        ({"elbow": 0.0}, "fixed_joints.elbow", "panda_joint7"),
        ({"panda_finger_joint1": 0.0}, "fixed_joints.panda_finger_joint1", "panda_joint7"),
        ({"panda_joint4": 0.5}, "fixed_joints.panda_joint4", "-0.0698"),
        ({f"panda_joint{j}": -0.1 for j in range(1, 8)}, "fixed_joints.", "at least one"),
        ({}, "fixed_joints", "at least 1"),
    ],
)
def test_what_cannot_be_held_is_refused(client: TestClient, fixed: dict[str, float], field: str, allowed: str) -> None:
    target = {"position": [0.4, 0.1, 0.5], "rpy": [3.1, 0.0, 0.0]}
    text = str(refused(client, targets=[target], tip_frame="panda_link8", fixed_joints=fixed))
    assert field in text
    assert allowed in text


def test_a_held_joint_does_not_go_with_an_elbow_angle(client: TestClient) -> None:
    target = {"position": [0.4, 0.1, 0.5], "rpy": [3.1, 0.0, 0.0]}
    call: dict[str, Any] = {"method": "analytic", "elbow_angle": 0.1, "fixed_joints": {"panda_joint7": 0.6}}
    assert "either they or `elbow_angle`" in str(refused(client, targets=[target], **call))


def test_a_held_joint_travels_beside_an_array(client: TestClient) -> None:
    targets = npy(np.array([[0.4, 0.0, 0.4, 1.0, 0.0, 0.0, 0.0]]))
    headers = {"content-type": NPY}
    query = {"fixed_joints": '{"panda_joint7": 0.6}', "tip_frame": "panda_link8"}
    answer = client.post("/v1/robots/panda/ik", params=query, content=targets, headers=headers)
    assert answer.status_code == 200, answer.text
    (only,) = InverseAnswer.model_validate_json(answer.content).results
    assert only.solutions[0].joint_positions[6] == 0.6
