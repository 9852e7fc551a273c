"""Torques of a motion over HTTP: limits, payload, samples, and what is refused."""

from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.robot.arrays import Array

START = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
TARGET = [0.8, 0.2, 0.3, -1.6, 0.2, 1.9, 0.3]
LOAD = {"mass": 2.0, "center": [0.0, 0.0, 0.1], "inertia": [0.01, 0.0, 0.0, 0.01, 0.0, 0.005]}
RENAMED = {"center": "center_of_mass"}
"""Fields of a motion's payload that `dynamics` has another name for."""
EFFORTS = np.array([87.0] * 4 + [12.0] * 3)
MOVE = {"type": "joint", "target": TARGET}


def call(**options: Any) -> dict[str, Any]:
    motion = {"start": START, "segments": [MOVE], "tip_poses": False, "sample_period": 0.02, **options}
    motion["limits"] = {"joint_acceleration": 15.0} | motion.get("limits", {})
    return motion


def planned(client: TestClient, name: str = "panda", **options: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{name}/trajectory", json=call(**options))
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = answer.json()
    return found


def refused(client: TestClient, field: str, name: str = "panda", **options: Any) -> str:
    answer = client.post(f"/v1/robots/{name}/trajectory", json=call(**options))
    assert answer.status_code == 422, answer.text
    assert f"#/{field.replace('.', '/')}" in answer.text
    return answer.text


def by_dynamics(client: TestClient, motion: dict[str, Any], name: str = "panda", **options: Any) -> Array:
    """Torques of the samples by the operation for dynamics."""
    rows = {field: motion[field] for field in ("joint_positions", "joint_velocities", "joint_accelerations")}
    if "payload" in options:
        options["payload"] = {RENAMED.get(field, field): value for field, value in options["payload"].items()}
    answer = client.post(f"/v1/robots/{name}/dynamics", json={**rows, "terms": [], **options})
    return np.array(answer.json()["torques"])


@pytest.mark.parametrize("options", [{}, {"payload": LOAD, "gravity": [0.0, 9.81, 0.0]}])
def test_samples_are_the_torques_of_dynamics(client: TestClient, options: dict[str, Any]) -> None:
    motion = planned(client, torques=True, **options)
    torques = np.array(motion["joint_torques"])
    assert torques == pytest.approx(by_dynamics(client, motion, **options), abs=1e-9)
    peak = motion["audit"]["joint_torque"]
    assert peak["ratio"] is None
    assert np.abs(torques).max() <= abs(peak["value"]) * (1.0 + 1e-9)
    assert "joint_torque" not in motion["limits"]


def test_the_efforts_of_the_description_are_kept(client: TestClient) -> None:
    free = planned(client, law="time_optimal", payload=LOAD)
    assert np.abs(by_dynamics(client, free, payload=LOAD) / EFFORTS).max() > 0.0
    limits = {"joint_torque": "effort"}
    for law in ("cubic", "time_optimal"):
        motion = planned(client, law=law, payload=LOAD, limits=limits)
        assert motion["limits"]["joint_torque"] == EFFORTS.tolist()
        assert motion["audit"]["joint_torque"]["ratio"] <= 1.0 + 1e-9
        assert (np.abs(by_dynamics(client, motion, payload=LOAD)) <= EFFORTS * (1.0 + 1e-9)).all()


def test_a_law_takes_longer_for_the_torques_and_says_so(client: TestClient) -> None:
    limits = {"joint_torque": {"panda_joint4": 24.0}}
    free, motion = planned(client, law="cubic"), planned(client, law="cubic", limits=limits)
    optimal = planned(client, law="time_optimal", limits=limits)
    assert free["duration"] < motion["duration"]
    assert optimal["duration"] < motion["duration"]
    assert "limits of torque" in motion["segments"][0]["notes"][-1]
    assert motion["audit"]["joint_torque"]["joint"] == "panda_joint4"
    assert motion["limits"]["joint_torque"] == [None, None, None, 24.0, None, None, None]
    assert 0.99 < motion["audit"]["joint_torque"]["ratio"] <= 1.0 + 1e-9


def test_a_segment_has_its_own_limits_and_a_table_the_torques(client: TestClient) -> None:
    back = {"type": "joint", "target": START, "limits": {"joint_torque": {"panda_joint4": 24.0}}}
    content = call(segments=[MOVE, back], law="cubic", torques=True)
    motion = client.post("/v1/robots/panda/trajectory", json=content).json()
    first, second = motion["segments"]
    assert second["end_time"] - second["start_time"] > first["end_time"]
    assert "joint_torque" not in first["limits"]
    csv = client.post("/v1/robots/panda/trajectory", json=content, headers={"Accept": "text/csv"}).text
    assert csv.splitlines()[0].split(",")[-7:] == [f"tau_panda_joint{j}" for j in range(1, 8)]
    assert [float(entry) for entry in csv.splitlines()[1].split(",")[-7:]] == motion["joint_torques"][0]


def test_a_weight_that_is_too_much_is_refused(client: TestClient) -> None:
    for law in ("cubic", "time_optimal"):
        text = refused(client, "limits.joint_torque", limits={"joint_torque": "effort"}, payload={"mass": 40}, law=law)
        assert "panda_joint" in text
        assert "the weight alone" in text


def test_a_given_duration_that_asks_for_more_is_refused(client: TestClient) -> None:
    limits = {"joint_torque": {"panda_joint4": 24.0}}
    least = planned(client, law="cubic")["duration"]
    refused(client, "duration", limits=limits, law="cubic", duration=least)
    refused(client, "segments.0.duration", limits=limits, law="cubic", segments=[{**MOVE, "duration": least}])


@pytest.mark.slow
def test_moving_ends_take_longer_or_are_refused(client: TestClient) -> None:
    limits = {"joint_torque": {"panda_joint4": 26.0}}
    ends: dict[str, Any] = {"law": "quintic", "start_velocities": [0.1] * 7}
    free, motion = planned(client, **ends), planned(client, limits=limits, **ends)
    assert motion["duration"] > free["duration"]
    assert motion["audit"]["joint_torque"]["ratio"] <= 1.0
    refused(client, "start_accelerations", limits=limits, law="quintic", start_accelerations=[0, 0, 0, 15.0, 0, 0, 0])


@pytest.mark.parametrize(
    ("field", "options"),
    [
        ("payload.mass", {"payload": {"center": [0, 0, 0]}}),
        ("payload.mass", {"payload": {"mass": -1.0}}),
        ("payload", {"payload": {"mass": 1.0, "inertia": [1.0, 0, 0, 1.0, 0, 3.0]}}),
        ("payload", {"payload": {"mass": 1.0, "inertia": [1.0, 2.0, 0, 1.0, 0, 1.0]}}),
        ("limits.joint_torque", {"limits": {"joint_torque": [1.0, 2.0]}}),
        ("limits.joint_torque", {"limits": {"joint_torque": {"elbow": 10.0}}}),
        ("limits.joint_torque", {"limits": {"joint_torque": "most"}}),
        ("limits.joint_torque", {"limits": {"joint_torque": -5.0}}),
        ("segments.0.limits.joint_torque", {"segments": [{**MOVE, "limits": {"joint_torque": [1.0]}}]}),
        ("gravity", {"gravity": [0.0, 9.81]}),
    ],
)
def test_bad_input_names_its_field(client: TestClient, field: str, options: dict[str, Any]) -> None:
    refused(client, field, **options)


INERTIAL = """<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"""
BARE = """<robot name="bare"><link name="base"/><link name="arm">{mass}</link><joint name="turn" type="revolute">
<parent link="base"/><child link="arm"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="1" effort="0"/></joint>
</robot>"""


@pytest.mark.parametrize(
    ("name", "mass", "limit", "named"), [("torqueless", "", 5.0, "arm"), ("weak", INERTIAL, "effort", "turn")]
)
def test_limits_without_masses_or_efforts_are_refused(
    client: TestClient, name: str, mass: str, limit: object, named: str
) -> None:
    stored = client.post("/v1/robots", json={"name": name, "urdf": BARE.format(mass=mass)})
    assert stored.status_code == 201, stored.text
    motion = {"start": [0.0], "segments": [{"type": "joint", "target": [0.5]}]}
    assert (planned(client, name, **motion, torques=True)["joint_torques"][0] == [0.0]) == (not mass)
    assert named in refused(client, "limits.joint_torque", name, **motion, limits={"joint_torque": limit})
