"""Trajectories over HTTP: samples, formats, limits, ways of the tip, what cannot be done, pictures."""

import csv
import math
from io import BytesIO, StringIO
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.spatial.transform import Rotation
from starlette.testclient import TestClient

from gelenk.contract.trajectory_answer import TrajectoryAnswer
from tests.oracles.catalogue import NAMES
from tests.robots import robot as robot_of

Array = npt.NDArray[np.float64]
CSV, NPY, SVG, PNG = "text/csv", "application/x-npy", "image/svg+xml", "image/png"
READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
BESIDE = [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]
VELOCITIES = [2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61]
JOINT = {"type": "joint", "target": BESIDE}
LAWS = ["cubic", "quintic", "septic", "trapezoidal", "jerk_limited", "time_optimal"]


def post(client: TestClient, robot: str = "panda", accept: str = "application/json", **call: Any) -> Any:
    answer = client.post(f"/v1/robots/{robot}/trajectory", json=call, headers={"accept": accept})
    assert answer.status_code == 200, answer.text[:1000]
    assert answer.headers["content-type"].startswith(accept)
    return answer


def trajectory(client: TestClient, robot: str = "panda", **call: Any) -> dict[str, Any]:
    answer = post(client, robot, **call)
    TrajectoryAnswer.model_validate_json(answer.content)
    found = dict(answer.json())
    assert found["audit"]["passed"]
    assert found["audit"]["reasons"] == []
    return found


def panda(client: TestClient, *segments: dict[str, Any], **call: Any) -> dict[str, Any]:
    """A trajectory of the Panda's flange from its ready posture."""
    return trajectory(client, start=READY, segments=list(segments), tip_frame="panda_link8", **call)


def pose_at(client: TestClient, q: list[float]) -> dict[str, Any]:
    call = {"joint_positions": [q], "tip_frame": "panda_link8"}
    return dict(client.post("/v1/robots/panda/fk", json=call).json()["poses"][0])


def moved(pose: dict[str, Any], x: float = 0.0, y: float = 0.0, z: float = 0.0) -> dict[str, Any]:
    return {**pose, "position": [a + b for a, b in zip(pose["position"], (x, y, z), strict=True)]}


def samples(answer: dict[str, Any]) -> list[Array]:
    names = ("times", "joint_positions", "joint_velocities", "joint_accelerations")
    return [np.array(answer[name]) for name in names]


@pytest.fixture(scope="module")
def here(client: TestClient) -> dict[str, Any]:
    """The pose at the start."""
    return pose_at(client, READY)


@pytest.mark.parametrize("law", LAWS)
def test_a_joint_motion_by_every_law(client: TestClient, law: str) -> None:
    answer = panda(client, JOINT, law=law)
    times, q, v, a = samples(answer)
    assert times[:-1].tolist() == [k / 100 for k in range(len(times) - 1)]
    assert times[-1] == answer["duration"]
    assert 0.005 < answer["duration"] < 10.0
    np.testing.assert_allclose(q[[0, -1]], [READY, BESIDE], atol=1e-12)
    np.testing.assert_allclose(v[[0, -1]], 0.0, atol=1e-9)
    assert (np.abs(v) <= np.array(VELOCITIES) * (1 + 1e-9)).all()
    assert (np.abs(a) <= 2.0 * np.array(VELOCITIES) * (1 + 1e-9)).all()
    report = answer["segments"][0]
    assert (report["type"], report["law"], report["start_time"], report["length"]) == ("joint", law, 0.0, None)
    assert report["end_time"] == pytest.approx(answer["duration"])
    assert (answer["completed_fraction"], answer["failure"]) == (1.0, None)
    peaks = answer["audit"]
    assert peaks["velocity"]["ratio"] >= np.max(np.abs(v) / VELOCITIES) - 1e-9
    assert max(peaks["velocity"]["ratio"], peaks["acceleration"]["ratio"], peaks["jerk"]["ratio"] or 0.0) == (
        pytest.approx(1.0, abs=1e-6)
    ), "some limit is just reached"


def test_velocities_are_the_slope_of_positions(client: TestClient) -> None:
    answer = panda(client, JOINT, law="quintic", sample_period=0.001)
    times, q, v, a = samples(answer)
    inner = slice(5, -5)
    np.testing.assert_allclose(np.gradient(q, times, axis=0)[inner], v[inner], atol=1e-4)
    np.testing.assert_allclose(np.gradient(v, times, axis=0)[inner], a[inner], atol=1e-3)


@pytest.mark.parametrize("pose_format", ["quaternion_xyzw", "rpy", "matrix"])
def test_poses_are_those_of_forward_kinematics(client: TestClient, pose_format: str) -> None:
    answer = panda(client, JOINT, pose_format=pose_format, sample_period=0.05)
    call = {
        "joint_positions": answer["joint_positions"],
        "tip_frame": "panda_link8",
        "pose_format": pose_format,
    }
    assert answer["tip_poses"] == client.post("/v1/robots/panda/fk", json=call).json()["poses"]
    assert 0.0 < answer["certificate"]["max_position_error"] < 1e-9
    bare = panda(client, JOINT, tip_poses=False, sample_period=0.05)
    assert (bare["tip_poses"], bare["certificate"]) == (None, None)
    assert bare["joint_positions"] == answer["joint_positions"]


def test_the_coefficients_are_the_motion(client: TestClient, here: dict[str, Any]) -> None:
    line = {"type": "line", "target": moved(here, y=0.1)}
    answer = panda(client, line, JOINT, {**JOINT, "target": READY}, law="quintic", coefficients=True)
    times, q, v, _ = samples(answer)
    parts = [segment["polynomials"] for segment in answer["segments"]]
    for before, after in pairwise(parts):
        assert before["breaks"][-1] == after["breaks"][0]
    breaks = np.concatenate([part["breaks"][:-1] for part in parts] + [parts[-1]["breaks"][-1:]])
    coefficients = np.concatenate([np.array(part["coefficients"]) for part in parts])
    assert len(coefficients) == len(breaks) - 1
    piece = np.clip(np.searchsorted(breaks, times, side="right") - 1, 0, len(coefficients) - 1)
    local = times - breaks[piece]
    for i, t in enumerate(local):
        polynomials = [np.polynomial.Polynomial(column) for column in coefficients[piece[i]].T]
        np.testing.assert_allclose([p(t) for p in polynomials], q[i], atol=1e-12)
        np.testing.assert_allclose([p.deriv()(t) for p in polynomials], v[i], atol=1e-9)
    assert "polynomials" not in panda(client, JOINT)["segments"][0]


def test_csv_and_npy_hold_the_samples_of_json(client: TestClient) -> None:
    call: dict[str, Any] = {"start": READY, "segments": [JOINT], "sample_period": 0.004}
    answer = trajectory(client, **call)
    expected = np.column_stack(samples(answer))
    binary = post(client, accept=NPY, **call)
    table = np.load(BytesIO(binary.content))
    np.testing.assert_array_equal(table, expected)
    text = post(client, accept=CSV, **call)
    rows = list(csv.reader(StringIO(text.text, newline="")))
    joints = [f"panda_joint{i}" for i in range(1, 8)]
    assert rows[0] == ["time"] + [f"{kind}_{joint}" for kind in ("q", "qd", "qdd") for joint in joints]
    np.testing.assert_array_equal([[float(value) for value in row] for row in rows[1:]], expected)
    for one in (binary, text):
        assert float(one.headers["gelenk-duration"]) == answer["duration"]
        assert one.headers["gelenk-completed-fraction"] == "1.0"
        assert one.headers["gelenk-failure"] == "none"


def test_names_that_need_quotes_are_quoted(client: TestClient) -> None:
    names = ['elbow, "left"', "=1+1"]
    joints = [{"name": name, "type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0} for name in names]
    body = {"name": "quoted", "dh": {"convention": "standard", "joints": joints}}
    assert client.post("/v1/robots", json=body).status_code in {200, 201}
    call: dict[str, Any] = {"start": [0.0, 0.0], "segments": [{"type": "joint", "target": [0.1, 0.2]}]}
    text = post(client, "quoted", accept=CSV, **call).text
    first = next(csv.reader(StringIO(text, newline="")))
    assert first == ["time"] + [f"{kind}_{name}" for kind in ("q", "qd", "qdd") for name in names]


def test_a_line_is_straight_and_turns_about_one_axis(client: TestClient, here: dict[str, Any]) -> None:
    turn = Rotation.from_quat(here["quaternion_xyzw"]) * Rotation.from_rotvec([0.0, 0.0, 0.5])
    target = {**moved(here, 0.1, 0.2, -0.1), "quaternion_xyzw": turn.as_quat().tolist()}
    answer = panda(client, {"type": "line", "target": target})
    points = np.array([pose["position"] for pose in answer["tip_poses"]])
    a, b = points[0], np.array(target["position"])
    along = (b - a) / np.linalg.norm(b - a)
    across = (points - a) - np.outer((points - a) @ along, along)
    assert np.linalg.norm(across, axis=1).max() <= 1e-4
    np.testing.assert_allclose(points[-1], b, atol=1e-4)
    turns = Rotation.from_quat([pose["quaternion_xyzw"] for pose in answer["tip_poses"]])
    vectors = (turns[0].inv() * turns).as_rotvec()
    assert np.abs(vectors[:, :2]).max() <= 1e-3
    assert vectors[-1, 2] == pytest.approx(0.5, abs=1e-3)
    report = answer["segments"][0]
    assert report["length"] == pytest.approx(math.sqrt(0.06), abs=1e-6)
    assert report["angle"] == pytest.approx(0.5, abs=1e-6)
    assert answer["audit"]["path_deviation"]["value"] <= 1e-4
    assert answer["audit"]["path_deviation"]["ratio"] <= 1.0


def test_a_circle_keeps_its_radius_and_passes_the_via_point(client: TestClient, here: dict[str, Any]) -> None:
    circle: dict[str, Any] = {"type": "circle", "via": moved(here, 0.0, 0.1, 0.1), "target": moved(here, 0.0, 0.2, 0.0)}
    answer = panda(client, circle, sample_period=0.002)
    points = np.array([pose["position"] for pose in answer["tip_poses"]])
    centre = np.array(moved(here, y=0.1)["position"])
    np.testing.assert_allclose(np.linalg.norm(points - centre, axis=1), 0.1, atol=1e-4)
    assert np.linalg.norm(points - np.array(circle["via"]["position"]), axis=1).min() < 2e-3
    assert answer["segments"][0]["length"] == pytest.approx(0.1 * math.pi, abs=1e-6)


def test_a_blended_corner_is_cut_at_its_radius_without_a_stop(client: TestClient, here: dict[str, Any]) -> None:
    corner = moved(here, 0.15)
    first = {"type": "line", "target": corner}
    second = {"type": "line", "target": moved(here, 0.15, 0.15)}
    slow = {"tip_velocity": 0.1}
    stopping = panda(client, first, second, limits=slow)
    blended = panda(client, {**first, "blend_radius": 0.05}, second, limits=slow)
    assert blended["duration"] < stopping["duration"]
    points = np.array([pose["position"] for pose in blended["tip_poses"]])
    to_corner = np.linalg.norm(points - np.array(corner["position"]), axis=1)
    # A parabola whose arms are r long at a right angle passes its corner at r √2 / 4.
    assert to_corner.min() == pytest.approx(0.05 * math.sqrt(2) / 4, abs=2e-3)
    speeds = np.linalg.norm(np.array(blended["joint_velocities"]), axis=1)
    assert speeds[1:-1].min() > 1e-3
    assert [segment["blended"] for segment in blended["segments"]] == [True, False]
    assert blended["segments"][0]["end_time"] == blended["segments"][1]["start_time"]
    assert [segment["blended"] for segment in stopping["segments"]] == [False, False]


def test_a_spline_passes_its_configurations_at_its_times(client: TestClient) -> None:
    middle = [0.1, -0.6, 0.0, -2.3, 0.1, 1.6, 0.9]
    spline = {"type": "spline", "waypoints": [middle, BESIDE], "times": [1.0, 2.5], "law": "cubic"}
    answer = panda(client, spline, sample_period=0.5)
    times, q, v, _ = samples(answer)
    assert times.tolist() == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]
    np.testing.assert_allclose(q[[0, 2, 5]], [READY, middle, BESIDE], atol=1e-12)
    np.testing.assert_allclose(v[[0, 5]], 0.0, atol=1e-12)
    by_name = [dict(zip(answer["joint_names"], one, strict=True)) for one in (middle, BESIDE)]
    assert panda(client, {**spline, "waypoints": by_name}, sample_period=0.5)["joint_positions"] == q.tolist()


def test_a_spline_passes_its_poses(client: TestClient, here: dict[str, Any]) -> None:
    poses = [moved(here, 0.1, 0.05), moved(here, 0.1, 0.15, -0.1), moved(here, 0.0, 0.2)]
    answer = panda(client, {"type": "spline", "waypoints": poses}, sample_period=0.001)
    points = np.array([pose["position"] for pose in answer["tip_poses"]])
    for pose in poses:
        assert np.linalg.norm(points - np.array(pose["position"]), axis=1).min() < 1e-3
    np.testing.assert_allclose(points[-1], poses[-1]["position"], atol=1e-4)


def test_a_joint_motion_to_a_pose_arrives_there(client: TestClient) -> None:
    target = pose_at(client, BESIDE)
    answer = panda(client, {"type": "joint", "target": target}, sample_period=0.1)
    np.testing.assert_allclose(answer["tip_poses"][-1]["position"], target["position"], atol=1e-5)


def test_limits_of_the_tip_and_of_a_segment_hold(client: TestClient, here: dict[str, Any]) -> None:
    line = {"type": "line", "target": moved(here, 0.1, 0.2)}
    slow = {**line, "target": here, "limits": {"tip_velocity": 0.05}}
    answer = panda(client, line, slow, limits={"tip_velocity": 0.1, "tip_acceleration": 1.0})
    assert answer["audit"]["tip"]["speed"]["ratio"] == pytest.approx(1.0, rel=1e-6)
    points = np.array([pose["position"] for pose in answer["tip_poses"]])
    times = np.array(answer["times"])
    speeds = np.linalg.norm(np.diff(points, axis=0), axis=1) / np.diff(times)
    second = times[:-1] >= answer["segments"][1]["start_time"]
    assert speeds[~second].max() == pytest.approx(0.1, rel=1e-3)
    assert speeds[second].max() == pytest.approx(0.05, rel=1e-3)
    assert [segment["limits"]["tip_velocity"] for segment in answer["segments"]] == [0.1, 0.05]
    assert answer["limits"]["tip_velocity"] == 0.1
    assert answer["limits"]["tip_angular_velocity"] is None


def test_half_the_scales_take_longer(client: TestClient) -> None:
    whole = panda(client, JOINT)
    half = panda(client, JOINT, velocity_scale=0.5, acceleration_scale=0.25)
    assert half["duration"] == pytest.approx(2.0 * whole["duration"], rel=1e-9)
    assert half["limits"]["joint_velocity"] == pytest.approx([0.5 * one for one in VELOCITIES])
    assert half["limit_sources"]["joint_velocity"] == ["robot"] * 7
    assert half["limit_sources"]["joint_jerk"] == ["assumed"] * 7
    assert len(half["notes"]) == 2


def test_a_duration_is_kept(client: TestClient) -> None:
    answer = panda(client, JOINT, {**JOINT, "target": READY}, duration=5.0)
    assert answer["duration"] == pytest.approx(5.0, rel=1e-12)
    answer = panda(client, {**JOINT, "duration": 3.0}, {**JOINT, "target": READY})
    assert answer["segments"][0]["end_time"] == pytest.approx(3.0, rel=1e-12)


def test_timing_is_compared_where_asked_for(client: TestClient, here: dict[str, Any]) -> None:
    line = {"type": "line", "target": moved(here, 0.1, 0.2)}
    answer = panda(client, line, law="cubic", compare_timing=True)
    (timing,) = answer["timing"]
    assert (timing["segments"], timing["law"]) == ([0], "cubic")
    assert timing["time_optimal_duration"] < timing["uniform_duration"] == answer["duration"]
    # The course's k = max{k_vel, √k_acc}, of a law that lasts 1 s.
    factors = timing["velocity_factor"], math.sqrt(timing["acceleration_factor"])
    assert max(factors) == pytest.approx(timing["uniform_duration"], rel=1e-6)
    optimal = panda(client, line, law="time_optimal")["duration"]
    assert optimal == pytest.approx(timing["time_optimal_duration"], rel=1e-9)
    assert "timing" not in panda(client, line)


def test_out_of_reach_is_an_answer(client: TestClient, here: dict[str, Any]) -> None:
    away = {"type": "line", "target": moved(here, 2.0)}
    answer = panda(client, JOINT, {**JOINT, "target": READY}, away, JOINT)
    failure = answer["failure"]
    assert failure["reason"] == "out_of_reach"
    assert failure["segment"] == 2
    assert failure["time"] == answer["duration"] == answer["times"][-1]
    assert 0.5 < answer["completed_fraction"] < 0.75
    assert len(answer["segments"]) == 3
    np.testing.assert_allclose(answer["joint_velocities"][-1], 0.0, atol=1e-9)
    done = 4.0 * answer["completed_fraction"] - 2.0
    assert answer["segments"][2]["length"] == pytest.approx(2.0 * done, rel=1e-6)


@pytest.mark.slow
def test_every_format_says_what_is_missing(client: TestClient) -> None:
    """Two links of 1 m and 0.7 m, bent by a right angle and drawn out along a line, reach 1.7 m."""
    away = {"type": "line", "target": {"position": [1.0, 3.7, 0.0], "rpy": [0.0, 0.0, 0.0]}}
    call: dict[str, Any] = {"start": [0.0, math.pi / 2], "segments": [away], "task": ["x", "y"]}
    answer = trajectory(client, "planar_2r", **call)
    assert answer["failure"]["reason"] == "out_of_reach"
    reached = answer["tip_poses"][-1]["position"]
    assert reached[0] == pytest.approx(1.0, abs=1e-4)
    assert 0.7 < reached[1] <= math.sqrt(1.7**2 - 1.0) + 1e-4
    assert answer["completed_fraction"] == pytest.approx((reached[1] - 0.7) / 3.0, abs=1e-4)
    for accept in (CSV, NPY):
        headers = post(client, "planar_2r", accept, **call).headers
        assert headers["gelenk-failure"] == answer["failure"]["reason"]
        assert float(headers["gelenk-completed-fraction"]) == answer["completed_fraction"]
    assert post(client, "planar_2r", PNG, **call).content.startswith(b"\x89PNG")


@pytest.mark.slow
def test_a_way_that_cannot_be_begun_is_an_answer(client: TestClient) -> None:
    """The wrist is stretched: axes four and six coincide."""
    start = [0.1, -1.2, 1.4, -0.7, 0.0, 0.3]
    pose = client.post("/v1/robots/ur5_dh/fk", json={"joint_positions": [start]}).json()["poses"][0]
    line = {"type": "line", "target": moved(pose, 0.05, 0.02)}
    answer = trajectory(client, "ur5_dh", start=start, segments=[line], coefficients=True)
    assert (answer["completed_fraction"], answer["duration"], answer["segments"]) == (0.0, 0.0, [])
    assert answer["failure"]["reason"] in {"singularity", "branch_change"}
    assert answer["failure"]["segment"] == 0
    assert (answer["times"], answer["joint_positions"]) == ([0.0], [start])
    call: dict[str, Any] = {"start": start, "segments": [line]}
    assert post(client, "ur5_dh", PNG, **call).content.startswith(b"\x89PNG")


@pytest.mark.slow
def test_nothing_at_all_is_an_answer(client: TestClient) -> None:
    answer = panda(client, {**JOINT, "target": READY})
    assert (answer["duration"], answer["times"], answer["joint_positions"]) == (0.0, [0.0], [READY])
    call: dict[str, Any] = {"start": READY, "segments": [{**JOINT, "target": READY}]}
    assert np.load(BytesIO(post(client, accept=NPY, **call).content)).shape == (1, 22)
    assert post(client, accept=PNG, **call).content.startswith(b"\x89PNG")


@pytest.mark.quick(16)
@pytest.mark.parametrize("name", sorted(NAMES))
def test_every_robot_moves_its_joints(client: TestClient, name: str) -> None:
    chain = robot_of(name).chain(None, None)
    near = np.clip(0.0, chain.lower, chain.upper)
    low, high = np.maximum(chain.lower, near - 1.0), np.minimum(chain.upper, near + 1.0)
    start, target = 0.6 * low + 0.4 * high, 0.4 * low + 0.6 * high
    segment = {"type": "joint", "target": target.tolist()}
    answer = trajectory(client, name, start=start.tolist(), segments=[segment], sample_period=0.1)
    np.testing.assert_allclose(answer["joint_positions"][-1], target, atol=1e-9)
    if (start != target).any():
        velocity, acceleration = (answer["audit"][name]["ratio"] for name in ("velocity", "acceleration"))
        assert max(velocity, acceleration) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("kind", [SVG, PNG])
def test_pictures(client: TestClient, here: dict[str, Any], kind: str) -> None:
    line = {"type": "line", "target": moved(here, 0.1, 0.2)}
    call: dict[str, Any] = {"start": READY, "segments": [line, JOINT], "tip_frame": "panda_link8"}
    picture = post(client, accept=kind, **call)
    assert picture.content.startswith(b"<?xml" if kind == SVG else b"\x89PNG")
    assert len(picture.content) < 500_000
    assert post(client, accept=kind, **call).content == picture.content


def test_chains_between_any_frames_and_with_sliding_joints(client: TestClient) -> None:
    target = {"type": "joint", "target": [0.5, -0.3, 0.2, 0.0]}
    answer = trajectory(client, "scara", start=[0.1, 0.2, 0.0, 0.3], segments=[target])
    assert answer["limit_sources"]["joint_velocity"] == ["assumed"] * 4
    assert any("sliding joint 0.25 m/s" in note for note in answer["notes"])
    ends = {"base_frame": "panda_link8", "tip_frame": "panda_link0"}
    back = trajectory(client, start=READY[::-1], segments=[{"type": "joint", "target": BESIDE[::-1]}], **ends)
    forth = panda(client, JOINT)
    np.testing.assert_allclose(np.array(back["joint_positions"])[:, ::-1], forth["joint_positions"], atol=1e-12)


def test_a_chain_without_joints_stays(client: TestClient) -> None:
    answer = trajectory(client, start=[], tip_frame="panda_link0", segments=[{"type": "joint", "target": []}])
    assert (answer["times"], answer["joint_positions"], answer["audit"]["velocity"]) == ([0.0], [[]], None)


def test_a_task_leaves_the_turn_about_the_tool_free(client: TestClient, here: dict[str, Any]) -> None:
    line: dict[str, Any] = {"type": "line", "target": moved(here, 0.1, 0.1)}
    answer = panda(client, line, task=["x", "y", "z", "rx", "ry"])
    points = np.array([pose["position"] for pose in answer["tip_poses"]])
    np.testing.assert_allclose(points[-1], line["target"]["position"], atol=1e-4)
