"""The four steps from points to a joint trajectory over HTTP."""

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.pipeline import PipelineAnswer
from gelenk.robot.arrays import Array
from tests.oracles.written import with_points

EXAMPLE_PIPELINE = BY_NAME["pipeline"].example
PATH = "/v1/course/pipeline"
FOLDED_IN = {"lengths": [1.0, 0.7], "start": [0.3, -2.0], "target": [-0.4, 0.9], "duration": 3.0}


def good(client: TestClient, body: dict[str, Any]) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    PipelineAnswer.model_validate_json(answer.content)
    return answer.json()


def tip(lengths: list[float], q: Array) -> Array:
    """Forward kinematics by sines and cosines."""
    a, b = q[..., 0], q[..., 0] + q[..., 1]
    return np.stack(
        (lengths[0] * np.cos(a) + lengths[1] * np.cos(b), lengths[0] * np.sin(a) + lengths[1] * np.sin(b)), axis=-1
    )


@pytest.mark.parametrize(("samples", "deviation"), [(5, 0.037935626952), (9, 0.007526883659), (17, 0.001922985419)])
def test_the_line_of_the_course(client: TestClient, samples: int, deviation: float) -> None:
    content = good(client, {**EXAMPLE_PIPELINE, "samples": samples})
    assert content["max_deviation"]["value"] == pytest.approx(deviation, abs=1e-8)
    assert content["certificate"]["max_position_error"] < 1e-12
    wanted = [
        (1.919862177194, 2.443460952792),
        (0.958937740441, 2.670339744270),
        (0.265248412194, 2.423137271488),
        (0.208184447121, 1.929984083840),
        (0.416816232314, 1.252522024134),
    ]
    found = [one["joint_positions"] for one in content["samples"]][:: (samples - 1) // 4]
    np.testing.assert_allclose(found, wanted, atol=1e-11)


@pytest.mark.parametrize("law", ["uniform", "cubic"])
def test_the_spline_and_its_deviation_by_other_means(client: TestClient, law: str) -> None:
    content = good(client, {**FOLDED_IN, "samples": 7, "law": law})
    assert content["elbow"] == "left"
    samples = content["samples"]
    t, q = np.array([one["time"] for one in samples]), np.array([one["joint_positions"] for one in samples])
    lengths = FOLDED_IN["lengths"]
    np.testing.assert_allclose(tip(lengths, q), [one["position"] for one in samples], atol=1e-12)  # type: ignore[arg-type]
    assert (np.sin(q[:, 1]) < 0.0).all()
    assert np.abs(np.diff(q, axis=0)).max() < np.pi
    spline = CubicSpline(t, q, bc_type="clamped")
    curve = content["curve"]
    np.testing.assert_allclose(spline(curve["times"]), curve["joint_positions"], atol=1e-12)
    fine = np.linspace(0.0, t[-1], 20_001)
    away = tip(lengths, spline(fine)) - np.array(content["knots"][0]["position"])  # type: ignore[arg-type]
    K = content["direction"]
    sideways = K[0] * away[:, 1] - K[1] * away[:, 0]
    largest = float(np.abs(sideways).max())
    assert abs(content["max_deviation"]["value"]) == pytest.approx(largest, rel=1e-6)
    assert abs(content["max_deviation"]["value"]) >= largest * (1.0 - 1e-12)


def test_a_line_around_the_base_keeps_counting(client: TestClient) -> None:
    body = {"lengths": [1.0, 0.9], "start": [2.2, 2.6], "target": [-0.3, -0.6], "samples": 9, "duration": 2.0}
    q = np.array([one["joint_positions"] for one in good(client, body)["samples"]])
    assert q[-1, 0] > np.pi
    assert np.abs(np.diff(q, axis=0)).max() < 1.0


def test_samples_out_of_reach_are_marked(client: TestClient) -> None:
    content = good(client, {**EXAMPLE_PIPELINE, "target": [0.816, 2.4], "samples": 9})
    assert [one["status"] for one in content["samples"]] == [*["reached"] * 7, *["out_of_reach"] * 2]
    assert (content["spline"], content["curve"], content["max_deviation"]) == (None, None, None)
    start, end = np.array(content["knots"][0]["position"]), np.array([0.816, 2.4])
    leaves = content["leaves_workspace"]
    assert np.linalg.norm(start + leaves * (end - start)) == pytest.approx(2.0)
    assert "Sample 8 is out of reach, 2 of 9" in content["warnings"][0]


def test_a_hole_between_two_samples_is_seen(client: TestClient) -> None:
    body = {"lengths": [1.0, 0.7], "start": [0.2, 1.6], "target": [-0.6, -0.6], "samples": 2, "duration": 1.0}
    content = good(client, body)
    assert content["spline"] is not None
    assert content["leaves_workspace"] is not None
    assert "between two samples" in content["warnings"][0]


def test_an_arm_that_begins_nearly_folded_keeps_its_digits(client: TestClient) -> None:
    lengths, target = [1.266743022721144, 1.2709098965443981], [1.9369989790097026, 0.32242174218561037]
    body = {"lengths": lengths, "start": [1000.0, 3.14159], "target": target, "duration": 16.0, "samples": 3}
    assert good(client, {**body, "law": "septic"})["certificate"]["max_position_error"] < 1e-9


def test_a_stretched_arm_is_marked(client: TestClient) -> None:
    content = good(client, {"lengths": [1, 1], "start": [0, 1], "target": [0, 2], "samples": 3, "duration": 1})
    assert content["samples"][-1]["status"] == "singular"
    assert abs(content["samples"][-1]["determinant"]) < 1e-6
    assert "stretched or folded" in content["warnings"][0]


def test_the_steps_have_its_numbers(client: TestClient) -> None:
    content = good(client, EXAMPLE_PIPELINE)
    text = "\n".join(line for step in content["steps"] for line in step["plain"])
    assert "c_2 = (0.06597985667² + 0.7² - 1² - 1²)/(2 · 1 · 1) = -0.7528233293" in text
    assert f"max|e| = {content['max_deviation']['value']:.10g} m" in text
    german = good(client, {**EXAMPLE_PIPELINE, "language": "de"})["steps"]
    assert [list(map(with_points, one["latex"])) for one in german] == [one["latex"] for one in content["steps"]]


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"start": [0.3, 0.0]}, "start"),
        ({"start": [0.3, np.pi]}, "start"),
        ({"lengths": [1.0, 1.0], "start": [0.0, np.pi / 2], "target": [1.0, 1.0]}, "target"),
        ({"lengths": [1.0]}, "lengths"),
        ({"samples": 1}, "samples"),
    ],
)
def test_refusals_name_the_field(client: TestClient, change: dict[str, Any], field: str) -> None:
    answer = client.post(PATH, json={**EXAMPLE_PIPELINE, **change})
    assert answer.status_code == 422
    assert field in answer.text


@pytest.mark.parametrize("target", [[0.816, 1.4], [0.816, 2.4]])
def test_the_picture(client: TestClient, target: list[float]) -> None:
    answer = client.post(PATH, json={**EXAMPLE_PIPELINE, "target": target}, headers={"Accept": "image/png"})
    assert answer.content.startswith(b"\x89PNG")
