"""Cubic splines over HTTP."""

from math import pi
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.spline import SplineAnswer

EXAMPLE_SPLINE = BY_NAME["spline"].example

PATH = "/v1/course/spline"
FIVE = {"times": [0.0, 1.0, 2.5, 3.0, 4.0], "waypoints": [0.0, 1.0, 0.5, 2.0, 1.5]}


def good(client: TestClient, body: dict[str, Any]) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    SplineAnswer.model_validate_json(answer.content)
    content = answer.json()
    assert max(value for name, value in content["certificate"].items() if name.endswith("error")) < 1e-9
    assert content["certificate"]["continuity"] == 2
    return content


def test_the_spline_of_the_lecture(client: TestClient) -> None:
    content = good(client, EXAMPLE_SPLINE)
    system = content["system"]
    assert system["matrix"] == [[6.0, 2.0], [2.0, 6.0]]
    assert np.ravel(system["right_side"]) == pytest.approx([-18.849555921539, -25.918139392116])
    assert system["unknowns"] == [2, 3]
    assert [knot["velocities"][0] for knot in content["knots"]] == pytest.approx(
        [0, -1.914408023281, -3.681553890926, 0]
    )
    assert [knot["accelerations"][0] for knot in content["knots"]] == pytest.approx(
        [11.339185984, -13.253594007, 9.719302272, -6.037748381]
    )
    assert content["joint_positions"][1][0] == pytest.approx(3.620194659410)


def test_assigned_velocities_and_accelerations(client: TestClient) -> None:
    body = {**EXAMPLE_SPLINE, "boundary": "assigned", "fictitious_times": [0.5, 4.5]}
    content = good(client, body)
    knots = content["knots"]
    assert [knot["fictitious"] for knot in knots] == [False, True, False, False, True, False]
    assert [knots[i]["positions"][0] for i in (1, 4)] == pytest.approx([0.435291828252, 2.932857987856])
    content = good(client, {**body, "start_acceleration": 2.0, "end_velocity": -1.0})
    assert content["joint_accelerations"][0] == pytest.approx([2.0])
    assert content["joint_velocities"][-1] == pytest.approx([-1.0])


@pytest.mark.parametrize(
    ("boundary", "velocity"), [("natural", 1.640224358974), ("not_a_knot", 3.735714285714), ("clamped", 0.0)]
)
def test_boundaries_of_the_lecture(client: TestClient, boundary: str, velocity: float) -> None:
    content = good(client, {**FIVE, "boundary": boundary})
    assert content["joint_velocities"][0][0] == pytest.approx(velocity, abs=1e-10)


def test_a_periodic_one(client: TestClient) -> None:
    content = good(client, {**FIVE, "waypoints": [0.0, 1.0, 0.5, 2.0, 0.0], "boundary": "periodic"})
    assert content["joint_velocities"][0] == pytest.approx([-1.206214689266])
    assert content["joint_velocities"][-1] == pytest.approx([-1.206214689266])
    matrix = np.array(content["system"]["matrix"])
    assert matrix[0, -1] == content["system"]["lower"][0] != 0.0
    assert matrix[-1, 0] == content["system"]["upper"][-1] != 0.0


def test_several_joints_share_the_matrix(client: TestClient) -> None:
    rows = [[value, -value, 2.0 * value] for value in FIVE["waypoints"]]
    content = good(client, {**FIVE, "waypoints": rows, "boundary": "natural", "limits": {"joint_velocity": 1.0}})
    assert np.shape(content["system"]["right_side"]) == (5, 3)
    assert len(content["warnings"]) == 3


@pytest.mark.parametrize("boundary", ["clamped", "natural", "not_a_knot", "periodic", "assigned"])
def test_few_and_many_knots(client: TestClient, boundary: str) -> None:
    for count in (2, 3, 1000):
        values = np.sin(np.linspace(0.0, 2.0 * pi, count))
        values[-1] = values[0]
        body = {"times": np.linspace(0.0, 7.0, count).tolist(), "waypoints": values.tolist(), "boundary": boundary}
        content = good(client, body)
        assert len(content["segments"]) == count - 1 + (2 if boundary == "assigned" else 0)
        if count == 1000:
            assert content["system"]["matrix"] is None


@pytest.mark.parametrize("times", [[1e6 - 1.0, 1e6 - 0.5, 1e6], [0.0, 1e-3, 9e2 - 1e-3, 9e2], [-1e6, 0.0, 3.0, 1e6]])
@pytest.mark.parametrize("size", [1e-25, 1.0, 1e6])
def test_extreme_sizes_are_answered(client: TestClient, times: list[float], size: float) -> None:
    for boundary in ("clamped", "natural", "not_a_knot", "assigned"):
        points = [size * (-1.0) ** k for k in range(len(times))]
        good(client, {"times": times, "waypoints": points, "boundary": boundary, "samples": 5})


@pytest.mark.parametrize("accept", ["image/svg+xml", "image/png"])
def test_pictures(client: TestClient, accept: str) -> None:
    answer = client.post(PATH, json=EXAMPLE_SPLINE, headers={"Accept": accept})
    assert answer.status_code == 200
    assert answer.headers["content-type"] == accept


@pytest.mark.parametrize(
    ("fields", "field", "reason"),
    [
        ({"times": [0.0], "waypoints": [1.0]}, "times", ""),
        ({"times": [0.0, 1.0], "waypoints": [1.0]}, "waypoints", ""),
        ({"times": [0.0, 1.0]}, "waypoints", "5 entries for 2 times"),
        ({"times": [0.0, 1.0, 1.0, 3.0, 4.0]}, "times", "1 s is there twice"),
        ({"times": [0.0, 1.0, 0.5, 3.0, 4.0]}, "times", "have to increase"),
        ({"times": [0.0, 1e300, 2.0, 3.0, 4.0]}, "times", ""),
        ({"waypoints": [0.0, 1.0, [1.0, 2.0], 2.0, 1.0]}, "waypoints", "entry 2 has 2 numbers"),
        ({"waypoints": [0.0, 1.0, [], 2.0, 1.0]}, "waypoints", ""),
        ({"waypoints": [0.0, 1.0, "2", 2.0, 1.0]}, "waypoints", ""),
        ({"boundary": "tight"}, "boundary", ""),
        ({"boundary": "periodic"}, "waypoints", "the last one must equal the first"),
        ({"boundary": "natural", "start_velocity": 1.0}, "start_velocity", "is not allowed with"),
        ({"start_acceleration": 1.0}, "start_acceleration", "only allowed with `boundary` assigned"),
        ({"fictitious_times": [0.5, 3.5]}, "fictitious_times", "only allowed with `boundary` assigned"),
        ({"boundary": "assigned", "fictitious_times": [1.5, 3.5]}, "fictitious_times", "within the first segment"),
        ({"boundary": "assigned", "fictitious_times": [0.5]}, "fictitious_times", ""),
        ({"start_velocity": [1.0, 2.0]}, "start_velocity", "2 numbers"),
        ({"limits": {"joint_velocity": 0.0}}, "limits", ""),
        ({"times": list(range(1001)), "waypoints": [0.0] * 1001}, "times", ""),
        ({"speed": 1.0}, "speed", ""),
    ],
)
def test_bad_input_names_the_field(client: TestClient, fields: dict[str, Any], field: str, reason: str) -> None:
    answer = client.post(PATH, json={**FIVE, **fields})
    assert answer.status_code == 422, answer.text
    problem = answer.json()
    if problem["type"] == "urn:gelenk:invalid-field":
        assert problem["field"] == field
        assert reason in problem["detail"]
    else:
        assert reason == ""
        assert any(place["pointer"].startswith(f"#/{field}") for place in problem["errors"])


def test_a_query_and_another_body_are_refused(client: TestClient) -> None:
    assert client.post(PATH, params={"boundary": "natural"}, json=FIVE).status_code == 422
    assert client.post(PATH, content=b"x", headers={"Content-Type": "text/plain"}).status_code == 415
