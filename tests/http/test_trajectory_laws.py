"""The law of an answer is the one that was taken, and its limits are those that were asked for."""

from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from gelenk.main import create_app
from gelenk.settings import Settings

START = [0.0, -1.2, 1.6, -0.4, 1.2, 0.0]
LAWS = ("cubic", "quintic", "septic", "trapezoidal", "jerk_limited", "time_optimal")


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with TestClient(create_app(Settings(data_dir=tmp_path_factory.mktemp("data")))) as service:
        yield service


def tip(client: TestClient) -> dict[str, Any]:
    pose: dict[str, Any] = client.post("/v1/robots/ur5/fk", json={"joint_positions": [START]}).json()["poses"][0]
    return pose


def shifted(pose: dict[str, Any], x: float, z: float = 0.0) -> dict[str, Any]:
    px, py, pz = pose["position"]
    return {**pose, "position": [px + x, py, pz + z]}


@pytest.mark.quick(3)
@pytest.mark.parametrize(("law", "place", "fallback"), list(product(LAWS, ("trajectory", "segment"), (False, True))))
def test_being_slow_only_where_joints_must_is_the_time_optimal_law_or_refused(
    client: TestClient, law: str, place: str, fallback: bool
) -> None:
    pose = tip(client)
    line: dict[str, Any] = {"type": "line", "target": shifted(pose, -2.0 * pose["position"][0])}
    call = {"start": START, "near_singularity": "slow_down", "law_fallback": fallback, "tip_poses": False}
    call["segments"] = [line | ({"law": law} if place == "segment" else {})]
    if place == "trajectory":
        call["law"] = law
    answer = client.post("/v1/robots/ur5/trajectory", json=call)
    if law != "time_optimal" and not fallback:
        assert answer.status_code == 422
        assert answer.json()["field"] == ("law" if place == "trajectory" else "segments.0.law")
        assert "`law_fallback`" in answer.json()["detail"]
    else:
        assert answer.json()["segments"][0]["law"] == "time_optimal"


def test_without_a_word_about_the_law_it_is_the_time_optimal_one(client: TestClient) -> None:
    call = {"start": START, "near_singularity": "slow_down", "tip_poses": False}
    move = {"type": "joint", "target": [0.1, *START[1:]]}
    line = {"type": "line", "target": shifted(tip(client), 0.0, 0.05)}
    told = client.post("/v1/robots/ur5/trajectory", json={**call, "segments": [line, move]}).json()
    assert [segment["law"] for segment in told["segments"]] == ["time_optimal", "trapezoidal"]


def test_a_duration_that_is_too_short_for_the_jerk_is_refused(client: TestClient) -> None:
    move = {"type": "joint", "target": [1.0, *START[1:]], "law": "cubic"}
    call = {"start": START, "segments": [move], "limits": {"joint_jerk": 1.0}}
    least = 12.0 ** (1.0 / 3.0)  # A cubic's jerk is 12 rad / T³ throughout.
    assert client.post("/v1/robots/ur5/trajectory", json=call).json()["duration"] == pytest.approx(least, rel=1e-9)
    for factor, status in ((1.01, 200), (0.99, 422)):
        for place in ("segment", "trajectory"):
            whole = call | {"duration": factor * least} if place == "trajectory" else call
            segment = move if place == "trajectory" else move | {"duration": factor * least}
            answer = client.post("/v1/robots/ur5/trajectory", json=whole | {"segments": [segment]})
            assert answer.status_code == status, answer.text
            assert status == 200 or answer.json()["field"].endswith("duration")


@pytest.mark.parametrize(("ratio", "words"), [(1.0 + 7e-16, None), (1.0002, "1.0002 times"), (1.5, "1.5 times")])
def test_a_note_on_jerk_names_a_ratio_above_one(client: TestClient, ratio: float, words: str | None) -> None:
    move: dict[str, Any] = {"type": "joint", "target": [0.1, *START[1:]], "law": "cubic"}
    call = {"start": START, "segments": [move], "limits": {"joint_velocity": 100.0, "joint_acceleration": 100.0}}
    limit = client.post("/v1/robots/ur5/trajectory", json=call).json()["limits"]["joint_jerk"][0]
    move["duration"] = (1.2 / (ratio * limit)) ** (1.0 / 3.0)
    notes = client.post("/v1/robots/ur5/trajectory", json=call).json()["segments"][0]["notes"]
    found = [note for note in notes if "jerk limits are exceeded" in note]
    assert len(found) == (words is not None), notes
    assert all(f"reaches {words} its limit" in note for note in found)


@pytest.mark.slow
def test_a_spline_whose_tip_accelerates_most_beside_a_break_is_answered(client: TestClient) -> None:
    """Its acceleration along the tip peaks between the end of a piece and the sample before."""
    pose = tip(client)
    places = [
        [0.624025, 0.087058, 0.31393],
        [0.632108, 0.164448, 0.192648],
        [0.562066, 0.187375, 0.266749],
    ]
    waypoints = [{**pose, "position": place} for place in places]
    limits = {
        "joint_velocity": [1.947401, 0.433409, 1.037651, 1.834202, 1.41504, 0.223009],
        "joint_acceleration": [4.063658, 3.750712, 4.269605, 4.983631, 1.26599, 1.093282],
        "joint_jerk": [17.854895, 13.244671, 26.400951, 9.597846, 12.565735, 18.445615],
        "tip_acceleration": 0.349055,
        "tip_angular_velocity": 0.177814,
        "tip_angular_acceleration": 1.064277,
    }
    call = {"start": START, "segments": [{"type": "spline", "waypoints": waypoints}], "law": "jerk_limited"}
    answer = client.post("/v1/robots/ur5/trajectory", json=call | {"limits": limits, "tip_poses": False})
    assert answer.status_code == 200, answer.text
    assert answer.json()["audit"]["tip"]["acceleration"]["ratio"] <= 1.0 + 1e-6


@pytest.mark.quick(1)
@pytest.mark.parametrize("law", LAWS)
def test_a_line_may_be_as_short_as_it_likes(client: TestClient, law: str) -> None:
    pose = tip(client)
    for length in (5.2e-8, *10.0 ** np.arange(-13.0, -2.0)):
        call = {"start": START, "law": law, "segments": [{"type": "line", "target": shifted(pose, float(length))}]}
        answer = client.post("/v1/robots/ur5/trajectory", json=call | {"sample_period": 1.0, "tip_poses": False})
        assert (answer.status_code, length) == (200, length), answer.text
        assert answer.json()["completed_fraction"] == 1.0


@pytest.mark.quick(6)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", ["joint", "line"])
def test_ramps_may_be_as_short_as_they_like(client: TestClient, law: str, kind: str) -> None:
    """From 1e-5 to 1e-12 of the duration: no law refuses what another one does, and none loses more than 1e-5."""
    target = [1.0, *START[1:]] if kind == "joint" else shifted(tip(client), 0.1)
    call = {"start": START, "segments": [{"type": kind, "target": target}], "law": law, "sample_period": 100.0}
    durations = []
    for acceleration in (0.1, 1.0, 1e2, 1e6):
        limits = {"joint_velocity": 1e-3, "joint_acceleration": acceleration, "joint_jerk": 1e6}
        answer = client.post("/v1/robots/ur5/trajectory", json=call | {"limits": limits, "tip_poses": False})
        assert answer.status_code == 200, answer.text
        assert answer.json()["audit"]["passed"]
        durations.append(answer.json()["duration"])
    assert max(durations[1:]) <= durations[0] * (1.0 + 1e-5)


@pytest.mark.quick(1)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("speeds", [(0.2, 0.05, 0.2), (0.05, 0.2, 0.1), (0.1, 0.1, 0.02), (None, 0.05, None)])
def test_of_blended_lines_each_keeps_its_own_speed(
    client: TestClient, law: str, speeds: tuple[float | None, ...]
) -> None:
    """As fast as it may on each line outside of the blends, and nowhere faster; by differences of the tip's poses."""
    pose, lines = tip(client), []
    places = [(0.0, 0.0), (-0.12, 0.0), (-0.12, 0.12), (-0.24, 0.12)]
    for (x, z), speed in zip(places[1:], speeds, strict=True):
        limit = {} if speed is None else {"limits": {"tip_velocity": speed}}
        lines.append({"type": "line", "target": shifted(pose, x, z), "blend_radius": 0.01, **limit})
    del lines[-1]["blend_radius"]
    limits = {"tip_velocity": 0.3, "joint_velocity": 20.0, "joint_acceleration": 20.0}
    call = {"start": START, "segments": lines, "law": law, "sample_period": 0.002, "limits": limits}
    told = client.post("/v1/robots/ur5/trajectory", json=call).json()
    positions = np.array([one["position"] for one in told["tip_poses"]])
    times = np.array(told["times"])
    speed = np.linalg.norm(np.diff(positions, axis=0), axis=1) / np.diff(times)
    middles = 0.5 * (positions[1:] + positions[:-1])
    corners = np.array([[x, 0.0, z] for x, z in places]) + pose["position"]
    for i, bound in enumerate(speed_or or 0.3 for speed_or in speeds):
        along = corners[i + 1] - corners[i]
        share = (middles - corners[i]) @ along / (along @ along)
        off = np.linalg.norm(middles - corners[i] - share[:, None] * along, axis=1)
        on_line = (off < 1e-4) & (share > 0.0) & (share < 1.0)
        least = 0.9 if law in {"quintic", "septic", "jerk_limited"} else 0.98  # An average rounds the peaks off.
        assert least * bound < speed[on_line].max() < 1.02 * bound
    assert told["audit"]["passed"]
    assert told["completed_fraction"] == 1.0
    assert told["audit"]["tip"]["speed"]["ratio"] == pytest.approx(1.0, abs=0.01)


@pytest.mark.quick(4)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(
    ("own", "order"),
    [
        ({"limits": {"joint_velocity": 0.05}}, 1),
        ({"velocity_scale": 0.05}, 1),
        ({"limits": {"joint_acceleration": {"elbow_joint": 0.3}}}, 2),
        ({"limits": {"joint_jerk": 2.0}}, 3),
    ],
)
def test_of_blended_lines_each_keeps_its_own_limits_of_joints(
    client: TestClient, law: str, own: dict[str, Any], order: int
) -> None:
    """The tight ones hold from the blend on and not before; by differences of the samples."""
    pose = tip(client)
    lines: list[dict[str, Any]] = [
        {"type": "line", "target": shifted(pose, 0.12), "blend_radius": 0.02},
        {"type": "line", "target": shifted(pose, 0.12, 0.12), **own},
    ]
    call = {"start": START, "segments": lines, "law": law, "sample_period": 0.002, "tip_poses": False}
    told = client.post("/v1/robots/ur5/trajectory", json=call).json()
    first, second = told["segments"]
    rates = np.diff(told["joint_positions"], order, axis=0)[:-1] / 0.002**order  # The last sample is off the grid.
    times = np.array(told["times"])[: len(rates)]
    name = ("joint_velocity", "joint_acceleration", "joint_jerk")[order - 1]
    before, after = times + 0.002 * order < first["blend"]["start_time"], times > first["blend"]["start_time"]
    tight, loose = np.array(second["limits"][name]), np.array(first["limits"][name])
    assert np.abs(rates[before] / tight).max() > 2.0
    if order < 3 or law in {"quintic", "septic", "jerk_limited"}:
        assert np.abs(rates[before] / loose).max() < 1.01
        assert np.abs(rates[after] / tight).max() < 1.01
    assert told["audit"]["passed"]
    assert told["audit"][name.removeprefix("joint_")]["ratio"] == pytest.approx(1.0, abs=0.1)


@pytest.mark.quick(1)
@pytest.mark.parametrize("law", LAWS)
def test_corners_at_circles_stay_within_their_radius_and_are_smooth(client: TestClient, law: str) -> None:
    """A line, two arcs that meet at an angle, and a line; by differences of the tip's poses."""
    pose, radius = tip(client), 0.02
    places = {name: shifted(pose, x, z) for name, x, z in (("a", -0.1, 0.0), ("b", -0.1, 0.1), ("c", -0.2, 0.1))}
    segments: list[dict[str, Any]] = [
        {"type": "line", "target": places["a"], "blend_radius": radius},
        {"type": "circle", "via": shifted(pose, -0.07, 0.05), "target": places["b"], "blend_radius": radius},
        {"type": "circle", "via": shifted(pose, -0.15, 0.12), "target": places["c"], "blend_radius": radius},
        {"type": "line", "target": shifted(pose, -0.2, 0.2)},
    ]
    call = {"start": START, "segments": segments, "law": law, "sample_period": 0.001}
    told = client.post("/v1/robots/ur5/trajectory", json=call).json()
    assert told["audit"]["passed"]
    assert told["completed_fraction"] == 1.0
    positions, times = np.array([one["position"] for one in told["tip_poses"]])[:-1], np.array(told["times"])[:-1]
    for corner, segment in zip(places.values(), told["segments"], strict=False):
        distances = np.linalg.norm(positions - corner["position"], axis=1)
        inside = (times > segment["blend"]["start_time"]) & (times < segment["blend"]["end_time"])
        assert 0.001 < distances.min() < distances[inside].max() <= radius + 1e-6
        assert distances[~inside].min() > 0.9 * radius, "an arc's chord is a little shorter than the arc"
        velocities = np.gradient(positions, times, axis=0)[inside]
        assert np.linalg.norm(velocities, axis=1).min() > 0.01, "without a stop"
    if law in {"quintic", "septic", "jerk_limited"}:
        # A jump of the acceleration would stay in the differences, however short they are.
        fine, coarse = (np.abs(np.diff(positions[::step], 3, axis=0)).max() / step**2 for step in (2, 4))
        assert fine < 0.7 * coarse
        assert told["audit"]["continuity"]["acceleration"]["value"] < 1e-6


@pytest.mark.quick(2)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("tight", [{"limits": {"tip_velocity": 0.03}}, {"velocity_scale": 0.1}])
def test_a_spline_is_slow_only_on_the_way_to_a_waypoint_that_says_so(
    client: TestClient, law: str, tight: dict[str, Any]
) -> None:
    pose, limits = tip(client), {"tip_velocity": 0.3}
    waypoints = [shifted(pose, x, z) for x, z in ((-0.08, 0.02), (-0.16, 0.0), (-0.24, 0.03))]
    spline = {"type": "spline", "waypoints": waypoints, "waypoint_options": [None, tight, {}]}
    call = {"start": START, "segments": [spline], "law": law, "sample_period": 0.002, "limits": limits}
    told = client.post("/v1/robots/ur5/trajectory", json=call).json()
    positions, times = np.array([one["position"] for one in told["tip_poses"]]), np.array(told["times"])
    begin, end = (times[np.linalg.norm(positions - at["position"], axis=1).argmin()] for at in waypoints[:2])
    speeds = np.linalg.norm(np.diff(positions, axis=0), axis=1) / np.diff(times)
    within = (times[:-1] > begin + 0.002) & (times[1:] < end - 0.002)
    assert 0.027 < speeds[within].max() < 0.0301
    assert speeds[times[1:] < begin].max() > 0.06
    assert speeds[times[:-1] > end].max() > 0.06
    assert told["audit"]["passed"]
