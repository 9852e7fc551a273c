"""A straight line over HTTP: the numbers of the course, both ways of the orientation, and refusals."""

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.line import LineAnswer
from tests.oracles.written import with_points

EXAMPLE_LINE = BY_NAME["line"].example
PATH = "/v1/course/line"
TURN = {
    "start": [0, 0, 0],
    "target": [1, 0, 0],
    "law": "cubic",
    "duration": 2,
    "start_orientation": {"zyz": [0.2, 0.4, -0.3]},
    "target_orientation": {"zyz": [1, 0.9, 0.5]},
    "samples": 9,
}


def good(client: TestClient, body: dict[str, Any]) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    LineAnswer.model_validate_json(answer.content)
    content = answer.json()
    assert max(value for name, value in content["certificate"].items() if name.endswith("error")) < 1e-9
    return content


def of_length(length: float, **fields: Any) -> dict[str, Any]:
    return {"start": [0.0, 0.0], "target": [0.6 * length, -0.8 * length], **fields}


def test_the_line_of_the_course(client: TestClient) -> None:
    content = good(client, {**EXAMPLE_LINE, "sample_times": [0.2, 0.7, 1.9]})
    assert content["length"] == pytest.approx(0.754983443527)
    assert content["duration"] == pytest.approx(2.009966887054)
    samples = content["samples"]
    np.testing.assert_allclose(samples["positions"][1], [0.459603956068, 0.008613846238, 0.240396043932], atol=1e-12)
    K = np.array([0.2, 0.7, -0.2]) / content["length"]
    np.testing.assert_allclose(samples["velocities"], np.outer([0.2, 0.5, content["duration"] - 1.9], K), atol=1e-12)
    np.testing.assert_allclose(samples["accelerations"], np.outer([1.0, 0.0, -1.0], K), atol=1e-12)
    np.testing.assert_allclose(samples["s"], np.array(samples["sigma"]) / content["length"])


@pytest.mark.parametrize(
    ("length", "law", "times", "duration", "peak"),
    [
        (2.0, {"velocity": 0.8, "acceleration": 1.6}, (0.5, 2.0, 0.5), 3.0, 0.8),
        (0.3, {"velocity": 0.8, "acceleration": 1.6}, (0.433012701892, 0, 0.433012701892), 0.866025403784, 0.692820323),
        (
            2.0,
            {"velocity": 0.8, "acceleration": 1.6, "start_velocity": 0.3, "end_velocity": 0.1},
            (0.3125, 2.0390625, 0.4375),
            2.7890625,
            0.8,
        ),
        (
            0.1,
            {"velocity": 0.8, "acceleration": 1.6, "start_velocity": 0.3, "end_velocity": 0.1},
            (0.098910980935, 0, 0.223910980935),
            0.322821961869,
            0.458257569496,
        ),
        (
            2.0,
            {"velocity": 0.8, "acceleration": 1.6, "duration": 3.5},
            (0.403708798216, 3.5 - 2 * 0.403708798216, 0.403708798216),
            3.5,
            0.645934077146,
        ),
    ],
    ids=["coast", "no coast", "end velocities", "short with end velocities", "given time"],
)
def test_bang_coast_bang(
    client: TestClient, length: float, law: dict[str, Any], times: Any, duration: float, peak: float
) -> None:
    content = good(client, of_length(length, **law))
    profile = content["profile"]
    names = ("acceleration_time", "coast_time", "deceleration_time")
    assert [profile[name] for name in names] == pytest.approx(times, abs=1e-11)
    assert content["duration"] == pytest.approx(duration)
    assert content["sigma"]["peak_velocity"]["value"] == pytest.approx(peak)
    assert profile["peak_velocity"] == pytest.approx(peak)
    assert content["samples"]["positions"][-1] == pytest.approx([0.6 * length, -0.8 * length])


def test_the_speed_is_the_derivative_of_the_position(client: TestClient) -> None:
    h = 1e-4
    times = [0.31, 0.31 - h, 0.31 + h]
    samples = good(client, {**TURN, "sample_times": times})["samples"]
    before, after = np.array(samples["positions"])[1:]
    np.testing.assert_allclose((after - before) / (2 * h), samples["velocities"][0], atol=1e-8)


def test_two_equal_points(client: TestClient) -> None:
    content = good(client, of_length(0.0, acceleration=1.0))
    assert (content["length"], content["duration"], content["direction"]) == (0.0, 0.0, None)
    assert content["samples"]["positions"] == [[0.0, 0.0]]
    assert "does not move" in content["warnings"][0]
    turned = good(client, {**TURN, "target": [0, 0, 0]})
    assert turned["orientation"]["angle"] == pytest.approx(1.587275249684)
    assert turned["samples"]["s"][-1] == pytest.approx(1.0)
    assert np.ptp(turned["samples"]["positions"]) == 0.0


def test_both_ways_of_the_orientation(client: TestClient) -> None:
    found = good(client, TURN)["orientation"]
    np.testing.assert_allclose(found["axis"], [-0.297013915534, 0.351045593249, 0.888003223778], atol=1e-12)
    np.testing.assert_allclose(found["base_axis"], [0.092354010294, 0.450467547491, 0.888003223778], atol=1e-12)
    assert found["angle"] == pytest.approx(1.587275249684)
    assert found["middle_difference"] == pytest.approx(0.061421714469)
    np.testing.assert_allclose(
        found["peak_angular_velocity"], [0.109943426062, 0.536261991689, 1.057129154056], atol=1e-12
    )
    # Another library, by quaternions: the shortest way is slerp, and the other one the mean of the angles.
    ends = Rotation.from_euler("ZYZ", [[0.2, 0.4, -0.3], [1, 0.9, 0.5]])
    s = good(client, TURN)["samples"]["s"]
    np.testing.assert_allclose(found["about_axis"]["rotations"], Slerp([0, 1], ends)(s).as_matrix(), atol=1e-12)
    middle = Rotation.from_euler("ZYZ", [0.6, 0.65, 0.1]).as_matrix()
    np.testing.assert_allclose(found["zyz_middle"], middle, atol=1e-12)


@pytest.mark.parametrize("way", ["about_axis", "by_angles"])
def test_angular_velocities_are_those_of_the_rotations(client: TestClient, way: str) -> None:
    h = 1e-4
    found = good(client, {**TURN, "sample_times": [0.8 - h, 0.8, 0.8 + h]})["orientation"][way]
    before, _, after = np.array(found["rotations"])
    omega = Rotation.from_matrix(after @ before.T).as_rotvec() / (2 * h)
    np.testing.assert_allclose(omega, found["angular_velocities"][1], atol=1e-7)
    change = np.subtract(found["angular_velocities"][2], found["angular_velocities"][0]) / (2 * h)
    np.testing.assert_allclose(change, found["angular_accelerations"][1], atol=1e-6)


def test_equal_and_opposite_orientations(client: TestClient) -> None:
    same = good(client, {**TURN, "target_orientation": TURN["start_orientation"]})
    assert (same["orientation"]["axis"], same["orientation"]["angle"]) == (None, 0.0)
    half = {**TURN, "start_orientation": {"rpy": [0, 0, 0]}, "target_orientation": {"rpy": [0, 0, np.pi]}}
    content = good(client, half)
    assert content["orientation"]["other_axis"] == pytest.approx([0, 0, -1])
    assert "θ = π" in " ".join(content["warnings"])
    assert "φ and ψ" in " ".join(content["warnings"])


@pytest.mark.parametrize(
    ("velocity", "acceleration", "is_optimal", "durations"),
    [
        ([1.0, 0.2], [100.0, 1.0], False, [10.01, 5.2]),
        ([1.0, 0.2], [1.0, 1.0], True, [11.0, 5.2]),
    ],
)
def test_the_line_of_a_ppp_robot(
    client: TestClient, velocity: list[float], acceleration: list[float], is_optimal: bool, durations: list[float]
) -> None:
    body = {"start": [0, 0], "target": [10, 1], "axis_velocity": velocity, "axis_acceleration": acceleration}
    content = good(client, body)
    axes = content["axes"]
    assert axes["durations"] == pytest.approx(durations)
    assert axes["is_time_optimal"] is is_optimal
    assert content["duration"] == pytest.approx(axes["line_duration"])
    # No axis beyond its limits, and one at each of them.
    for name, limits in (("velocities", velocity), ("accelerations", acceleration)):
        ratios = np.abs(content["samples"][name]).max(axis=0) / limits
        assert ratios.max() == pytest.approx(1.0)


def test_formulas_are_the_same_in_both_languages(client: TestClient) -> None:
    english, german = (good(client, {**TURN, "language": code})["steps"] for code in ("en", "de"))
    assert [one["latex"] for one in english] == [list(map(with_points, one["latex"])) for one in german]
    text = "\n".join(line for one in english for line in one["plain"])
    assert "p(s) = p_i + s (p_f - p_i) = (0, 0, 0) + s (1, 0, 0)" in text
    assert "ω = R_i r θ̇ = (0.09235401029, 0.4504675475, 0.8880032238) θ̇" in text


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"target": [1.0, 2.0]}, "target"),
        ({"acceleration": None}, "acceleration"),
        ({"axis_acceleration": [1.0, 1.0, 1.0]}, "velocity"),
        ({"velocity": None, "acceleration": None, "axis_velocity": [1.0, 1.0, 1.0]}, "axis_acceleration"),
        ({"velocity": None, "acceleration": None, "axis_acceleration": [1.0, 1.0]}, "axis_acceleration"),
        ({"duration": 1.0}, "duration"),
        ({"law": "cubic", "velocity": None, "acceleration": None}, "duration"),
        ({"law": "cubic", "duration": 2.0}, "velocity"),
        ({"start_velocity": 0.6}, "start_velocity"),
        ({"target": [0.4, -0.2, 0.3], "start_velocity": 0.1}, "start_velocity"),
        ({"start_orientation": {"rpy": [0, 0, 0]}}, "target_orientation"),
        ({"sample_times": [9.0]}, "sample_times"),
    ],
)
def test_refusals_name_the_field(client: TestClient, change: dict[str, Any], field: str) -> None:
    body = {name: value for name, value in {**EXAMPLE_LINE, **change}.items() if value is not None}
    answer = client.post(PATH, json=body)
    assert answer.status_code == 422
    assert field in answer.json()["detail"] or field in str(answer.json().get("errors"))


@pytest.mark.slow
def test_the_picture(client: TestClient) -> None:
    answer = client.post(PATH, json=EXAMPLE_LINE, headers={"Accept": "image/png"})
    assert answer.content.startswith(b"\x89PNG")
    still = client.post(PATH, json=of_length(0.0, acceleration=1.0), headers={"Accept": "image/svg+xml"})
    assert still.content.startswith(b"<?xml")
