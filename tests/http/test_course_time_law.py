"""Time laws over HTTP."""

import re
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.time_law import TimeLawAnswer

EXAMPLE_TIME_LAW = BY_NAME["time_law"].example

PATH = "/v1/course/time-law"
LIMITS = {"joint_velocity": 0.8, "joint_acceleration": 1.6}
CUBIC = {"law": "cubic", "start": 0.0, "target": 1.0, "duration": 2.0}
TRAPEZOID = {"law": "trapezoidal", "start": 0.0, "target": 2.0, "limits": LIMITS}
LIFT = {"law": "4-3-4", "waypoints": [0.0, 0.3, 1.2, 1.5], "times": [0.0, 0.5, 1.5, 2.0]}
BLENDS = {"law": "parabolic_blends", "waypoints": [0.0, 1.0, 0.5], "times": [0.0, 1.0, 2.0], "blend_time": 0.2}


def good(client: TestClient, body: dict[str, Any]) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    TimeLawAnswer.model_validate_json(answer.content)
    content = answer.json()
    positions = np.array(content["joint_positions"])
    certificate = content["certificate"]
    assert max(value for name, value in certificate.items() if name.endswith("error")) < 1e-9
    assert len(positions) == len(content["times"])
    assert content["steps"]
    return content


def test_the_cubic_of_the_lecture(client: TestClient) -> None:
    content = good(client, EXAMPLE_TIME_LAW)
    assert content["segments"][0]["coefficients"][0] == pytest.approx([0.2, 0.5, 0.55, -0.25])
    assert content["normalised"][0] == pytest.approx([-1.666666667, 1.833333333, 0.833333333, 0.0])
    assert content["peaks"]["velocity"][0]["value"] == pytest.approx(0.903333333)
    assert content["joint_positions"][2] == pytest.approx([1.0])
    assert content["times"][-1] == 2.0


def test_without_displacement(client: TestClient) -> None:
    content = good(client, {**EXAMPLE_TIME_LAW, "target": 0.2})
    assert content["segments"][0]["coefficients"][0] == pytest.approx([0.2, 0.5, -0.35, 0.05])
    assert content["normalised"] == [None]


@pytest.mark.parametrize(("law", "ends"), [("quintic", 2), ("septic", 3)])
def test_higher_laws_of_several_joints(client: TestClient, law: str, ends: int) -> None:
    rates = ("velocity", "acceleration", "jerk")[:ends]
    body: dict[str, Any] = {**CUBIC, "law": law, "start": [0.0, 1.0, 2.0], "target": [1.0, 1.0, -1.0]}
    for k, rate in enumerate(rates):
        body |= {f"start_{rate}": [0.1 * k, 0.2, -0.3], f"end_{rate}": [0.3, -0.1 * k, 0.2]}
    content = good(client, body)
    assert content["normalised"][1] is None
    assert len(content["normalised"][0]) == 2 * ends + 2
    for k, rate in enumerate(rates):
        values = content[("joint_velocities", "joint_accelerations", "joint_jerks")[k]]
        assert values[0] == pytest.approx(body[f"start_{rate}"], abs=1e-9)
        assert values[-1] == pytest.approx(body[f"end_{rate}"], abs=1e-9)


def test_lift_off_travel_set_down(client: TestClient) -> None:
    content = good(client, LIFT)
    assert content["segments"][0]["coefficients"][0] == pytest.approx([0, 0, 0, 5.2, -5.6], abs=1e-12)
    assert content["segments"][2]["coefficients"][0] == pytest.approx([1.2, 1.1, 0.6, -6.0, 5.6])
    assert content["certificate"]["continuity"] == 2


def test_trapezoid_with_and_without_a_coast(client: TestClient) -> None:
    content = good(client, TRAPEZOID)
    assert content["switching_times"] == pytest.approx([0.0, 0.5, 2.5, 3.0])
    assert content["peaks"]["velocity"][0]["ratio"] == pytest.approx(1.0)
    content = good(client, {**TRAPEZOID, "target": 0.3})
    assert content["duration"] == pytest.approx(0.866025403784)
    assert content["profiles"][0]["coast_time"] == 0.0
    content = good(client, {**TRAPEZOID, "target": -0.3, "duration": 3.5, "sample_times": [0.0, 3.5]})
    assert content["duration"] == 3.5
    assert content["profiles"][0]["factor"] is None


def test_trapezoid_without_a_distance(client: TestClient) -> None:
    content = good(client, {**TRAPEZOID, "target": 0.0})
    assert (content["duration"], content["times"], content["joint_positions"]) == (0.0, [0.0], [[0.0]])


def test_trapezoids_in_step(client: TestClient) -> None:
    limits = {"joint_velocity": [0.5, 0.8], "joint_acceleration": [0.8, 0.5]}
    content = good(client, {**TRAPEZOID, "start": [0.0, 0.0], "target": [-1.0, 0.7], "limits": limits})
    first, second = content["profiles"]
    assert (first["own_duration"], first["factor"]) == (2.625, 1.0)
    assert second["own_duration"] == pytest.approx(2.366431913240)
    assert second["peak_velocity"] == pytest.approx(0.533333333)
    assert second["acceleration"] == pytest.approx(0.406349206)


def test_infeasible_end_velocities_and_the_way_out(client: TestClient) -> None:
    body = {**TRAPEZOID, "target": 0.02, "start_velocity": 0.3, "end_velocity": 0.1}
    answer = client.post(PATH, json=body)
    assert answer.status_code == 422
    assert answer.json()["field"] == "start_velocity"
    assert "acceleration of at least 2," in answer.json()["detail"]
    assert good(client, {**body, "may_reverse": True})["profiles"][0]["reverses"]


def test_parabolic_blends(client: TestClient) -> None:
    content = good(client, BLENDS)
    assert content["blends"]["velocities"][0] == pytest.approx([1.0 / 0.9, -0.5 / 0.9])
    assert content["blends"]["deviations"][0] == pytest.approx([0.0, 1.5 / 0.9 * 0.2 / 8.0, 0.0])
    body = {name: value for name, value in BLENDS.items() if name != "blend_time"}
    content = good(client, {**body, "limits": {"joint_acceleration": 10.0}})
    assert content["peaks"]["acceleration"][0]["ratio"] == pytest.approx(1.0)


def test_a_limit_that_is_broken_is_told(client: TestClient) -> None:
    content = good(client, {**CUBIC, "limits": {"joint_velocity": 0.5}})
    assert content["peaks"]["velocity"][0]["ratio"] == pytest.approx(1.5)
    assert "Joint 1 goes beyond its limit of velocity by a factor of 1.5" in content["warnings"][0]


def test_samples_where_they_are_wanted(client: TestClient) -> None:
    content = good(client, {**CUBIC, "sample_times": [0.0, 2.0, 1.0]})
    assert np.ravel(content["joint_positions"]) == pytest.approx([0.0, 1.0, 0.5])
    many = good(client, {**CUBIC, "samples": 10_000})
    assert len(many["times"]) == 10_000
    assert many["times"][-1] == 2.0


@pytest.mark.parametrize(
    "size", [{"start": 1e6, "target": -1e6, "duration": 1e-6}, {"start": 1e6, "target": 1e6 - 1e-9, "duration": 1e6}]
)
@pytest.mark.parametrize("law", ["cubic", "quintic", "septic"])
def test_extreme_sizes_are_answered(client: TestClient, law: str, size: dict[str, float]) -> None:
    good(client, {"law": law, **size, "start_velocity": 1e6, "end_velocity": -1e-9, "samples": 3})


@pytest.mark.parametrize("velocity", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("acceleration", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("target", [1e-29, 1e-9, 1e6])
def test_extreme_trapezoids_are_answered_or_refused(
    client: TestClient, velocity: float, acceleration: float, target: float
) -> None:
    limits = {"joint_velocity": [velocity, 1.0], "joint_acceleration": [acceleration, 1.0]}
    body = {**TRAPEZOID, "start": [0.0, 0.0], "target": [target, 1.0], "limits": limits, "samples": 3}
    answer = client.post(PATH, json=body)
    if answer.status_code == 200:
        good(client, body)
    else:
        assert answer.status_code == 422
        assert "less than a millionth" in answer.json()["detail"]
        assert answer.json()["field"] == "limits.joint_acceleration"


@pytest.mark.quick(1)
@pytest.mark.parametrize("accept", ["image/svg+xml", "image/png"])
@pytest.mark.parametrize("body", [CUBIC, TRAPEZOID, LIFT, BLENDS, {**TRAPEZOID, "target": 0.0}], ids=lambda b: b["law"])
def test_pictures(client: TestClient, body: dict[str, Any], accept: str) -> None:
    answer = client.post(PATH, json=body, headers={"Accept": accept})
    assert answer.status_code == 200
    assert answer.headers["content-type"] == accept
    assert answer.content.startswith(b"<?xml" if "svg" in accept else b"\x89PNG")


@pytest.mark.parametrize(
    ("body", "field", "reason"),
    [
        ({**CUBIC, "law": "bang"}, "law", ""),
        ({"law": "cubic"}, "start", "needed"),
        ({**CUBIC, "target": None}, "target", "needed"),
        ({**CUBIC, "target": [1.0, 2.0]}, "target", "2 numbers for 1 joint"),
        ({**CUBIC, "start": []}, "start", ""),
        ({**CUBIC, "start": [0.0] * 33}, "start", ""),
        ({**CUBIC, "start": True}, "start", ""),
        ({**CUBIC, "start": 1e300}, "start", ""),
        ({**CUBIC, "start_velocity": [1.0, 2.0]}, "start_velocity", "2 numbers"),
        ({**CUBIC, "duration": None}, "duration", "needed"),
        ({**CUBIC, "duration": 0.0}, "duration", ""),
        ({**CUBIC, "duration": -1.0}, "duration", ""),
        ({**CUBIC, "end_acceleration": 1.0}, "end_acceleration", "is not allowed with `law` cubic"),
        ({**CUBIC, "law": "quintic", "start_jerk": 0.0}, "start_jerk", "is not allowed"),
        ({**CUBIC, "waypoints": [0.0, 1.0]}, "waypoints", "is not allowed"),
        ({**CUBIC, "may_reverse": True}, "may_reverse", "is not allowed"),
        ({**CUBIC, "blend_time": 0.1}, "blend_time", "is not allowed"),
        ({**CUBIC, "samples": 1}, "samples", ""),
        ({**CUBIC, "samples": 1_000_000}, "samples", ""),
        ({**CUBIC, "start": [0.0] * 11, "target": [1.0] * 11, "samples": 10_000}, "samples", "100000 numbers allowed"),
        ({**CUBIC, "sample_times": [2.1]}, "sample_times", "lasts from 0 to 2 s"),
        ({**CUBIC, "limits": {"joint_velocity": [1.0, 1.0]}}, "limits.joint_velocity", "2 numbers"),
        ({**TRAPEZOID, "limits": {"joint_velocity": 1.0}}, "limits.joint_acceleration", "needed"),
        ({**TRAPEZOID, "limits": {**LIMITS, "joint_velocity": 0.0}}, "limits/joint_velocity", ""),
        ({**TRAPEZOID, "limits": {**LIMITS, "joint_acceleration": -1.0}}, "limits/joint_acceleration", ""),
        ({**TRAPEZOID, "duration": 2.9}, "duration", "joint 1 needs at least 3 s"),
        ({**TRAPEZOID, "start_velocity": -0.1}, "start_velocity", "leads away"),
        ({**TRAPEZOID, "end_velocity": 0.9}, "end_velocity", "beyond the limit"),
        (
            {**TRAPEZOID, "target": 0.3, "start_velocity": 0.8, "end_velocity": 0.8, "duration": 90.0},
            "duration",
            "turning back",
        ),
        ({**LIFT, "waypoints": [0.0, 1.0, 2.0], "times": [0.0, 1.0, 2.0]}, "waypoints", "3 given"),
        ({**LIFT, "times": [0.0, 0.5, 0.5, 2.0]}, "times", "there twice"),
        ({**LIFT, "times": [0.0, 0.5, 0.4, 2.0]}, "times", "have to increase"),
        ({**LIFT, "times": [0.0, 0.5, 0.8]}, "waypoints", "4 entries for 3 times"),
        ({**LIFT, "times": None}, "times", "needed"),
        ({**LIFT, "duration": 1.0}, "duration", "is not allowed"),
        ({**LIFT, "waypoints": [[0.0, 1.0], [0.3], [1.2], [1.5]]}, "waypoints", "entry 1 has 1 number for"),
        ({**BLENDS, "blend_time": 0.9}, "blend_time", "too short"),
        ({**BLENDS, "blend_time": [0.1, 0.2]}, "blend_time", "2 numbers where there are 3 waypoints"),
        ({**BLENDS, "blend_time": None}, "blend_time", "needed"),
        ({**BLENDS, "blend_time": 0.0}, "blend_time", ""),
        ({**BLENDS, "limits": LIMITS}, "blend_time", "one of the two"),
        ({**BLENDS, "blend_time": None, "limits": LIMITS}, "limits.joint_acceleration", "too short for joint 1"),
        ({**BLENDS, "waypoints": [0.0], "times": [0.0]}, "waypoints", ""),
        (
            {"law": "parabolic_blends", "waypoints": [[0.0] * 32] * 99, "times": list(range(99)), "limits": LIMITS},
            "waypoints",
            "give `blend_time`",
        ),
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


@pytest.mark.parametrize("number", ["NaN", "Infinity", "1e400", "-1e300"])
def test_numbers_that_are_none(client: TestClient, number: str) -> None:
    body = f'{{"law": "cubic", "start": 0, "target": {number}, "duration": 1}}'
    answer = client.post(PATH, content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422


@pytest.mark.parametrize("law", ["cubic", "quintic", "septic"])
@pytest.mark.parametrize("target", [1.4, 0.2], ids=["moved", "back at the start"])
def test_the_steps_derive_each_coefficient(client: TestClient, law: str, target: float) -> None:
    rates = {"start_velocity": 0.5, "end_velocity": -0.3}
    rates |= {} if law == "cubic" else {"start_acceleration": 0.1, "end_acceleration": 0.2}
    rates |= {"start_jerk": -0.4, "end_jerk": 0.7} if law == "septic" else {}
    content = good(client, {"law": law, "start": 0.2, "target": target, "duration": 2.0, **rates})
    text = "\n".join(line for step in content["steps"] for line in step["plain"])
    coefficients = content["segments"][0]["coefficients"][0]
    if law == "cubic" and target != 0.2:
        return
    for k, value in enumerate(coefficients):
        found = re.search(rf"\nc_{k} = .* = (\S+)", text)
        assert found is not None, text
        assert float(found[1].replace("·", "")) == pytest.approx(value * 2.0**k, rel=1e-9, abs=1e-9)


def test_the_steps_solve_for_the_velocities_of_a_lift(client: TestClient) -> None:
    body = {"law": "4-3-4", "waypoints": [0, 0.3, 1.2, 1.5], "times": [0, 0.5, 1.5, 2], "start_velocity": 0.1}
    content = good(client, body)
    text = "\n".join(line for step in content["steps"] for line in step["plain"])
    found = re.search(r"\[(\S+), (\S+); (\S+), (\S+)\] \[v_1; v_2\] = \[(\S+); (\S+)\]", text)
    assert found is not None
    numbers = [float(one) for one in found.groups()]
    velocities = np.linalg.solve(np.reshape(numbers[:4], (2, 2)), numbers[4:])
    inner = [segment["coefficients"][0][1] for segment in content["segments"][1:]]
    np.testing.assert_allclose(velocities, inner, atol=1e-9)
