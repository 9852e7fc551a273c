"""Poses as the pendants of UR, KUKA, ABB and FANUC show them, both ways, against SciPy."""

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from starlette.testclient import TestClient

from gelenk.contract.pose import Pose
from gelenk.robot.arrays import Array

Q = [[0.4, -1.1, 1.3, 0.2, 0.7, -0.5], [-1.0, -0.3, 0.9, 2.2, -0.8, 0.1]]


def matrix(name: str, numbers: list[float]) -> Array:
    """What a pendant's numbers mean, by SciPy."""
    turn = numbers[3:]
    of = {
        "ur": lambda: Rotation.from_rotvec(turn),
        "kuka_abc": lambda: Rotation.from_euler("ZYX", turn, degrees=True),
        "abb": lambda: Rotation.from_quat(turn, scalar_first=True),
        "fanuc_wpr": lambda: Rotation.from_euler("xyz", turn, degrees=True),
    }
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = of[name]().as_matrix(), np.array(numbers[:3]) * (1.0 if name == "ur" else 1e-3)
    return T


def fk(client: TestClient, pose_format: str) -> list[dict[str, Any]]:
    call = {"joint_positions": Q, "pose_format": pose_format}
    answer = client.post("/v1/robots/ur5e/fk", json=call)
    assert answer.status_code == 200, answer.text
    poses: list[dict[str, Any]] = answer.json()["poses"]
    return poses


@pytest.mark.parametrize("name", ["ur", "kuka_abc", "abb", "fanuc_wpr"])
def test_what_the_pendant_shows_goes_both_ways(client: TestClient, name: str) -> None:
    shown, true = fk(client, name), [pose["matrix"] for pose in fk(client, "matrix")]
    for pose, T in zip(shown, true, strict=True):
        assert list(pose) == [name]
        np.testing.assert_allclose(matrix(name, pose[name]), T, atol=1e-12)
        np.testing.assert_allclose(Pose.model_validate(pose).transform(), T, atol=1e-12)
    call = {"targets": shown, "seeds": Q, "pose_format": name}
    results = client.post("/v1/robots/ur5e/ik", json=call).json()["results"]
    assert [result["status"] for result in results] == ["solved", "solved"]
    np.testing.assert_allclose([result["solutions"][0]["joint_positions"] for result in results], Q, atol=1e-6)


def test_a_motion_takes_and_gives_them(client: TestClient) -> None:
    start, end = fk(client, "kuka_abc")
    segment = {"type": "joint", "target": end}
    call = {"start": Q[0], "segments": [segment], "law": "quintic", "pose_format": "abb", "sample_period": 0.1}
    answer = client.post("/v1/robots/ur5e/trajectory", json=call).json()
    first, last = (matrix("abb", answer["tip_poses"][i]["abb"]) for i in (0, -1))
    np.testing.assert_allclose(first, matrix("kuka_abc", start["kuka_abc"]), atol=1e-9)
    np.testing.assert_allclose(last, matrix("kuka_abc", end["kuka_abc"]), atol=1e-6)


def test_the_five_decimals_of_a_quaternion_on_the_pendant_do() -> None:
    pose = Pose.model_validate({"abb": [600.0, 0.0, 500.0, 0.70711, 0.0, 0.70711, 0.0]})
    np.testing.assert_allclose(pose.transform()[:3, 2], [1.0, 0.0, 0.0], atol=1e-12)


@pytest.mark.parametrize(
    ("pose", "reason"),
    [
        ({"abb": [0.0, 0.0, 0.0, 0.9, 0.0, 0.0, 0.0]}, "0.1"),
        ({"ur": [0.0, 0.0, 0.0, 0.9, 0.0]}, "at least 6"),
        ({"ur": [0.0] * 6, "position": [0.0] * 3}, "alone"),
        ({"kuka_abc": [0.0] * 6, "matrix": np.eye(4).tolist()}, "alone"),
        ({"kuka_abc": [0.0] * 6, "fanuc_wpr": [0.0] * 6}, "alone"),
        ({"fanuc_wpr": [1e9, 0.0, 0.0, 0.0, 0.0, 0.0]}, "1000000"),
    ],
)
def test_what_is_no_pose_of_a_pendant_is_refused(client: TestClient, pose: dict[str, Any], reason: str) -> None:
    answer = client.post("/v1/robots/ur5e/ik", json={"targets": [pose]})
    assert answer.status_code == 422
    assert reason in answer.text
