"""The law of an answer is the one that was taken, and no audit passes above a limit that the request states."""

from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from app.main import create_app
from app.settings import Settings

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


def largest(told: dict[str, Any], order: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Of each joint the largest magnitude of a derivative, on a fine lattice of times of each polynomial."""
    found = np.zeros(6)
    for segment in told["segments"]:
        pieces = segment["polynomials"]
        for piece, length in zip(pieces["coefficients"], np.diff(pieces["breaks"]), strict=True):
            derivative = np.polynomial.polynomial.polyder(np.array(piece), order)
            values = np.polynomial.polynomial.polyval(np.linspace(0.0, length, 101), derivative)
            found = np.maximum(found, np.abs(values).max(axis=1))
    return found


@pytest.mark.parametrize(("law", "kind"), list(product(LAWS, ("joint", "line", "blended", "slow_down"))))
def test_limits_that_the_request_states_are_kept_whatever_the_law(client: TestClient, law: str, kind: str) -> None:
    rng = np.random.default_rng(LAWS.index(law))
    bounds = {
        "joint_velocity": float(rng.uniform(0.3, 1.5)),
        "joint_acceleration": float(rng.uniform(0.5, 3.0)),
        "joint_jerk": float(rng.uniform(2.0, 30.0)),
    }
    pose = tip(client)
    segments: list[dict[str, Any]]
    match kind:
        case "joint":
            segments = [{"type": "joint", "target": rng.uniform(-1.0, 1.0, 6).tolist()}]
        case "blended":
            corner = {"type": "line", "target": shifted(pose, 0.05), "blend_radius": 0.01}
            segments = [corner, {"type": "line", "target": shifted(pose, 0.05, 0.05)}]
        case _:
            segments = [{"type": "line", "target": shifted(pose, 0.1, 0.02)}]
    call = {"start": START, "segments": segments, "law": law, "limits": bounds, "coefficients": True}
    call |= {"near_singularity": "slow_down" if kind == "slow_down" else "stop", "law_fallback": True}
    answer = client.post("/v1/robots/ur5/trajectory", json=call)
    told = answer.json()
    assert answer.status_code == 200, told
    assert told["audit"]["passed"]
    for order, bound in enumerate(bounds.values(), start=1):
        assert largest(told, order).max() <= bound * (1.0 + 1e-6)


def test_a_duration_that_is_too_short_for_the_jerk_is_refused(client: TestClient) -> None:
    move = {"type": "joint", "target": [1.0, *START[1:]], "law": "cubic"}
    call = {"start": START, "segments": [move], "limits": {"joint_jerk": 1.0}}
    least = client.post("/v1/robots/ur5/trajectory", json=call).json()["duration"]
    for factor, status in ((1.01, 200), (0.99, 422)):
        for place in ("segment", "trajectory"):
            whole = call | {"duration": factor * least} if place == "trajectory" else call
            segment = move if place == "trajectory" else move | {"duration": factor * least}
            answer = client.post("/v1/robots/ur5/trajectory", json=whole | {"segments": [segment]})
            assert answer.status_code == status, answer.text
            assert status == 200 or answer.json()["field"].endswith("duration")


@pytest.mark.parametrize("law", LAWS)
def test_a_line_may_be_as_short_as_it_likes(client: TestClient, law: str) -> None:
    pose = tip(client)
    for length in (5.2e-8, *10.0 ** np.arange(-13.0, -2.0)):
        call = {"start": START, "law": law, "segments": [{"type": "line", "target": shifted(pose, float(length))}]}
        answer = client.post("/v1/robots/ur5/trajectory", json=call | {"sample_period": 1.0, "tip_poses": False})
        assert (answer.status_code, length) == (200, length), answer.text
        assert answer.json()["completed_fraction"] == 1.0


@pytest.mark.parametrize("law", ["trapezoidal", "time_optimal"])
@pytest.mark.parametrize("speeds", [(0.2, 0.05, 0.2), (0.05, 0.2, 0.1), (0.1, 0.1, 0.02), (None, 0.05, None)])
def test_of_blended_lines_each_keeps_its_own_speed(
    client: TestClient, law: str, speeds: tuple[float | None, ...]
) -> None:
    """As fast as it may on each line outside of the blends, and nowhere faster; by differences of the tip's poses."""
    pose, lines = tip(client), []
    places = [(0.0, 0.0), (0.12, 0.0), (0.12, 0.12), (0.24, 0.12)]
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
        assert speed[on_line].max() == pytest.approx(bound, rel=0.02)
    assert told["audit"]["passed"]
    assert told["audit"]["tip"]["speed"]["ratio"] == pytest.approx(1.0, abs=0.01)
