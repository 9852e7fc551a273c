"""Uniform time scaling over HTTP."""

from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.time_scaling import TimeScalingAnswer

EXAMPLE_TIME_SCALING = BY_NAME["time_scaling"].example

PATH = "/v1/course/time-scaling"
LOOSE = {"joint_velocity": 10.0, "joint_acceleration": 100.0}
SAMPLES = {"times": [0.0, 0.5, 1.0, 2.0], "waypoints": [0.0, 1.0, 0.5, 2.0], "limits": LOOSE}


def good(client: TestClient, body: dict[str, Any]) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    TimeScalingAnswer.model_validate_json(answer.content)
    content = answer.json()
    assert max(value for name, value in content["certificate"].items() if name.endswith("error")) < 1e-9
    return content


def test_the_example_of_the_lecture(client: TestClient) -> None:
    content = good(client, EXAMPLE_TIME_SCALING)
    assert (content["k_vel"], content["k_acc"], content["course_factor"]) == (1.5, 1.5, 1.5)
    assert content["binding"]["quantity"] == "velocity"
    assert content["duration"] == 1.5
    assert [peak["ratio"] for peak in content["peaks"]["velocity"]] == pytest.approx([1.0, 1.0])


def test_loose_limits_speed_up_only_without_the_one(client: TestClient) -> None:
    body = {**EXAMPLE_TIME_SCALING, "limits": LOOSE}
    content = good(client, body)
    assert (content["course_factor"], content["applied_factor"], content["duration"]) == (1.0, 1.0, 1.0)
    assert content["unclipped_factor"] == pytest.approx(0.346410161514)
    faster = good(client, {**body, "scaling": "unclipped"})
    assert faster["duration"] == pytest.approx(0.346410161514)
    assert max(peak["ratio"] for peak in faster["peaks"]["acceleration"]) == pytest.approx(1.0)


def test_a_factor_of_ones_own_is_held_against_the_limits(client: TestClient) -> None:
    content = good(client, {**EXAMPLE_TIME_SCALING, "factor": 1.2})
    assert content["duration"] == pytest.approx(1.2)
    assert "beyond its limit of velocity by a factor of 1.25" in content["warnings"][0]


def test_the_exam_spline_along_its_parameter(client: TestClient) -> None:
    s, q = np.array([0.0, 0.25, 0.5, 1.0]), np.array([70.0, -45.0, 10.0, 100.0])
    velocities = [-460.0, -147.27272727272728, 329.09090909090907, 180.0]
    body = {"times": s.tolist(), "waypoints": q.tolist(), "velocities": velocities, "factor": 2.5}
    content = good(client, {**body, "limits": {"joint_velocity": 1000.0}})
    assert content["duration"] == 2.5
    assert abs(content["peaks"]["acceleration"][0]["value"]) == pytest.approx(800.581818182)
    assert content["peaks"]["acceleration"][0]["time"] == pytest.approx(0.625)
    assert "does not begin and end at rest" in content["warnings"][0]


@pytest.mark.parametrize("boundary", ["clamped", "natural", "not_a_knot", "assigned"])
def test_a_spline_through_samples(client: TestClient, boundary: str) -> None:
    content = good(client, {**SAMPLES, "boundary": boundary, "scaling": "unclipped"})
    ratios = [content["peaks"][name][0]["ratio"] for name in ("velocity", "acceleration")]
    assert max(ratios) == pytest.approx(1.0)
    assert content["switching_times"][-1] == pytest.approx(2.0 * content["unclipped_factor"])


def test_samples_with_accelerations(client: TestClient) -> None:
    t = np.linspace(0.0, 2.0, 41)
    body = {
        "times": t.tolist(),
        "waypoints": np.sin(3.0 * t).tolist(),
        "velocities": (3.0 * np.cos(3.0 * t)).tolist(),
        "accelerations": (-9.0 * np.sin(3.0 * t)).tolist(),
        "limits": {"joint_velocity": 1.5, "joint_acceleration": 1.0, "joint_jerk": 1e3},
    }
    content = good(client, body)
    assert [bound["ratio"] for bound in content["bounds"]] == pytest.approx([2.0, 9.0, 0.027], rel=1e-3)
    assert content["course_factor"] == pytest.approx(3.0, rel=1e-5)


def test_what_stands_still(client: TestClient) -> None:
    content = good(client, {**EXAMPLE_TIME_SCALING, "displacement": [0.0, 0.0]})
    assert content["unclipped_factor"] is None
    assert content["course_factor"] == 1.0
    assert content["warnings"] == ["Nothing moves: any time will do."]


@pytest.mark.parametrize("displacement", [1e-29, 1e-9, 1e6])
@pytest.mark.parametrize("limit", [1e-9, 1e9])
def test_extreme_sizes_are_answered(client: TestClient, displacement: float, limit: float) -> None:
    limits = {"joint_velocity": limit, "joint_acceleration": limit, "joint_jerk": limit}
    for law in ("cubic", "septic"):
        for duration in (1e-6, 1e6):
            body = {"law": law, "displacement": displacement, "duration": duration, "limits": limits, "samples": 3}
            content = good(client, body)
            if content["unclipped_factor"] is not None:
                good(client, {**body, "scaling": "unclipped"})


def test_pictures(client: TestClient) -> None:
    answer = client.post(PATH, json=EXAMPLE_TIME_SCALING, headers={"Accept": "image/svg+xml"})
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "image/svg+xml"


@pytest.mark.parametrize(
    ("body", "field", "reason"),
    [
        ({**EXAMPLE_TIME_SCALING, "limits": None}, "limits", ""),
        ({**EXAMPLE_TIME_SCALING, "limits": {}}, "limits", "at least one"),
        ({**EXAMPLE_TIME_SCALING, "limits": {"joint_velocity": 0.0}}, "limits", ""),
        ({**EXAMPLE_TIME_SCALING, "limits": {"joint_velocity": [-1.0, 1.0]}}, "limits", ""),
        ({**EXAMPLE_TIME_SCALING, "limits": {"joint_velocity": [1.0] * 3}}, "limits.joint_velocity", "3 numbers"),
        ({**EXAMPLE_TIME_SCALING, "displacement": None}, "displacement", "needed"),
        ({**EXAMPLE_TIME_SCALING, "duration": None}, "duration", "needed"),
        ({**EXAMPLE_TIME_SCALING, "duration": 0.0}, "duration", ""),
        ({**EXAMPLE_TIME_SCALING, "times": [0.0, 1.0]}, "times", "waypoints`"),
        ({**EXAMPLE_TIME_SCALING, "factor": 0.0}, "factor", ""),
        ({**EXAMPLE_TIME_SCALING, "factor": 2.0, "scaling": "course"}, "scaling", "leave one of the two out"),
        ({**EXAMPLE_TIME_SCALING, "displacement": 0.0, "scaling": "unclipped", "limits": LOOSE}, "scaling", "nothing"),
        ({**SAMPLES, "displacement": 1.0}, "displacement", "instead of `waypoints`"),
        ({**SAMPLES, "times": None}, "times", "needed"),
        ({**SAMPLES, "times": [0.0, 0.5, 0.5, 2.0]}, "times", "there twice"),
        ({**SAMPLES, "times": [0.0, 0.5, 0.5, 2.0], "velocities": [0.0] * 4}, "times", "there twice"),
        ({**SAMPLES, "velocities": [0.0] * 3}, "velocities", "3 entries for 4 times"),
        ({**SAMPLES, "velocities": [[0.0, 1.0]] * 4}, "velocities", "entry 0 has 2 numbers"),
        ({**SAMPLES, "accelerations": [0.0] * 4}, "accelerations", "velocities`"),
        ({**SAMPLES, "velocities": [0.0] * 4, "boundary": "natural"}, "boundary", "there is none"),
        ({**SAMPLES, "boundary": "periodic"}, "waypoints", "the last one must equal the first"),
    ],
)
def test_bad_input_names_the_field(client: TestClient, body: dict[str, Any], field: str, reason: str) -> None:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 422, answer.text
    problem = answer.json()
    if problem["type"] == "urn:gelenk:invalid-field":
        assert problem["field"] == field
        assert reason in problem["detail"]
    else:
        assert reason == ""
        assert any(place["pointer"].startswith(f"#/{field}") for place in problem["errors"])


LINE = {"lengths": [1.0, 1.0], "start": np.radians([110.0, 140.0]).tolist(), "target": [0.816, 1.4]}
ALONG = {"line": LINE, "duration": 1.0, "limits": {"joint_velocity": [3.0, 2.5], "joint_acceleration": [5.0, 7.0]}}


def test_a_line_of_a_planar_arm_has_exact_peaks(client: TestClient) -> None:
    content = good(client, ALONG)
    assert content["k_vel"] == pytest.approx(1.918966430, rel=1e-9)
    assert content["k_acc"] == pytest.approx(6.151971947, rel=1e-9)
    assert content["course_factor"] == pytest.approx(2.480316904599, rel=1e-9)
    assert abs(content["peaks"]["acceleration"][0]["value"]) == pytest.approx(5.0, rel=1e-9)
    given = good(client, {**ALONG, "factor": 1.0})["peaks"]
    for quantity, wanted in (("velocity", (5.756899290, 3.004575851)), ("acceleration", (30.759859736, 20.114406054))):
        assert [abs(one["value"]) for one in given[quantity]] == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("law", ["cubic", "quintic", "septic"])
def test_its_tip_is_on_the_line(client: TestClient, law: str) -> None:
    content = good(client, {**ALONG, "law": law, "factor": 1.0, "samples": 41})
    q, t = np.array(content["joint_positions"]), np.array(content["times"])
    tip = np.column_stack((np.cos(q[:, 0]) + np.cos(q.sum(axis=1)), np.sin(q[:, 0]) + np.sin(q.sum(axis=1))))
    s = {
        "cubic": 3 * t**2 - 2 * t**3,
        "quintic": 10 * t**3 - 15 * t**4 + 6 * t**5,
        "septic": 35 * t**4 - 84 * t**5 + 70 * t**6 - 20 * t**7,
    }[law]
    np.testing.assert_allclose(tip, tip[0] + s[:, None] * (np.array(LINE["target"]) - tip[0]), atol=1e-11)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"line": {**LINE, "target": [0.816, 2.4]}}, "line"),
        ({"line": {**LINE, "target": [0.5, -0.5]}, "duration": None}, "duration"),
        ({"displacement": [1.0, 1.0]}, "displacement"),
        ({"line": {**LINE, "start": [0.3, 0.0]}}, "line.start"),
        ({"line": {**LINE, "lengths": [1.0, 1.0], "target": [0.684040286651, 0.0]}}, "line"),
    ],
    ids=["out of reach", "no duration", "two motions", "stretched", "through the base"],
)
def test_lines_that_are_refused(client: TestClient, change: dict[str, Any], field: str) -> None:
    body = {name: value for name, value in {**ALONG, **change}.items() if value is not None}
    answer = client.post(PATH, json=body)
    assert answer.status_code == 422, answer.text
    assert field in answer.text
