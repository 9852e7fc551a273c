"""Worked solutions of trajectories: their numbers are those of the answer."""

import math
import re
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from tests.oracles.written import with_points

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
BESIDE = [0.3, -0.5, 0.1, -2.2, 0.05, 1.8, 0.9]
JOINT = {"type": "joint", "target": BESIDE}


def at(x: float, y: float) -> dict[str, Any]:
    return {"position": [x, y, 0.0], "rpy": [0.0, 0.0, 0.0]}


def worked(client: TestClient, robot: str = "panda", **call: Any) -> tuple[dict[str, Any], str]:
    """The answer, and all its formulas as plain text."""
    answer = client.post(f"/v1/robots/{robot}/trajectory", json={"sample_period": 0.5, "steps": True, **call})
    assert answer.status_code == 200, answer.text[:500]
    TrajectoryAnswer.model_validate_json(answer.content)
    content = answer.json()
    return content, "\n".join(line for step in content["steps"] for line in (step["title"], *step["plain"]))


def number(text: str, pattern: str) -> float:
    found = re.search(pattern, text)
    assert found is not None, text
    return float(found[1])


def test_none_unless_requested(client: TestClient) -> None:
    content, _ = worked(client, start=READY, segments=[JOINT])
    assert content["steps"]
    plain = client.post("/v1/robots/panda/trajectory", json={"start": READY, "segments": [JOINT]}).json()
    assert plain["steps"] is None if "steps" in plain else True


def test_formulas_are_the_same_in_both_languages(client: TestClient) -> None:
    english, german = (
        worked(client, start=READY, segments=[JOINT], language=code)[0]["steps"] for code in ("en", "de")
    )
    assert [one["latex"] for one in english] == [list(map(with_points, one["latex"])) for one in german]


@pytest.mark.parametrize(("law", "peaks"), [("cubic", (1.5, 6.0)), ("quintic", (1.875, 10 / math.sqrt(3), 60.0))])
def test_the_time_of_a_polynomial(client: TestClient, law: str, peaks: tuple[float, ...]) -> None:
    content, text = worked(client, start=READY, segments=[JOINT], law=law)
    limits = [content["limits"][f"joint_{name}"] for name in ("velocity", "acceleration", "jerk")]
    moved = [abs(b - a) for a, b in zip(READY, BESIDE, strict=True)]
    least = max(
        (c * d / limit[j]) ** (1.0 / k)
        for k, (c, limit) in enumerate(zip(peaks, limits, strict=False), start=1)
        for j, d in enumerate(moved)
    )
    assert number(text, r"\nT = ([\d.]+) s") == pytest.approx(content["duration"])
    assert max(float(t) for t in re.findall(r"T ≥ .* = ([\d.]+) s", text)) == pytest.approx(least)
    assert least == pytest.approx(content["duration"])


def test_a_trapezoid_waits_for_the_slowest(client: TestClient) -> None:
    content, text = worked(client, start=READY, segments=[JOINT])
    assert number(text, r"T_min = max_j T_j = ([\d.]+) s") == pytest.approx(content["duration"])
    own, k = number(text, r"T_2 = .* = ([\d.]+) s"), number(text, r"k_2 = T/T_2 = ([\d.]+)")
    assert own * k == pytest.approx(content["duration"])
    _, longer = worked(client, start=READY, segments=[JOINT], duration=4.0)
    assert "T = 4 s" in longer


def test_a_line_of_the_tip(client: TestClient) -> None:
    body = {"start": [0.3, 0.8], "task": ["x", "y"], "segments": [{"type": "line", "target": at(0.5, 1.2)}]}
    content, text = worked(client, "planar_2r", **body)
    first = content["tip_poses"][0]["position"]
    assert number(text, r"L = ([\d.]+) m") == pytest.approx(math.dist(first, [0.5, 1.2, 0.0]))
    assert number(text, r"T = ([\d.]+) s") == pytest.approx(content["duration"])
    assert f"p(s) = p_i + s (p_f - p_i) = ({first[0]:.10g}, {first[1]:.10g}, 0) + s" in text
    assert "σ = " in text


def test_an_arc_has_its_centripetal_term(client: TestClient) -> None:
    circle = {"type": "circle", "via": at(0.8, 1.0), "target": at(0.5, 1.2)}
    content, text = worked(client, "planar_2r", start=[0.3, 0.8], task=["x", "y"], segments=[circle], law="cubic")
    assert "-σ̇²/r (cos φ x + sin φ y)" in text
    assert number(text, r"= ([\d.]+) m\n") == pytest.approx(content["segments"][0]["length"])
    c3, c2 = number(text, r"σ = -([\d.]+) τ³"), number(text, r"τ³ \+ ([\d.]+) τ²")
    T = content["duration"]
    assert c2 * T**2 - c3 * T**3 == pytest.approx(content["segments"][0]["length"])


@pytest.mark.parametrize(("law", "kind"), [("trapezoidal", "A parabola"), ("quintic", "A curve of fourth degree")])
def test_a_corner_is_what_its_law_makes_of_it(client: TestClient, law: str, kind: str) -> None:
    lines = [{"type": "line", "target": at(0.9, 1.1), "blend_radius": 0.05}, {"type": "line", "target": at(0.5, 1.1)}]
    content, _ = worked(client, "planar_2r", start=[0.3, 0.8], segments=lines, task=["x", "y"], law=law)
    (corner,) = (step for step in content["steps"] if "Blend into" in step["title"])
    assert corner["text"].startswith(kind)


def test_blends_and_many_pieces(client: TestClient) -> None:
    content, text = worked(client, **{**BY_NAME["trajectory"].example, "sample_period": 0.5})
    blend = content["segments"][1]["blend"]
    assert number(text, r"ΔT = ([\d.]+) s") == pytest.approx(blend["end_time"] - blend["start_time"])
    assert "A' = B - d K_AB" in text
    assert "Segment 2: Along the line" in text
    assert any("polynomials, each as fast as" in step["text"] for step in content["steps"])


@pytest.mark.parametrize("law", ["jerk_limited", "time_optimal"])
def test_other_laws_and_splines(client: TestClient, law: str) -> None:
    spline = {"type": "spline", "waypoints": [[0.5, 0.9], [0.8, 0.4]]}
    target = {"type": "spline", "waypoints": [at(0.4, 1.3), at(0.2, 1.4)]}
    segments = [{"type": "joint", "target": [0.2, 1.1]}, spline, target]
    content, text = worked(client, "planar_2r", start=[0.3, 0.8], task=["x", "y"], segments=segments, law=law)
    assert content["completed_fraction"] == 1.0
    for title in ("Segment 0: All joints together", "Segment 1: Cubic spline", "Segment 2: Path through points"):
        assert title in text


@pytest.mark.slow
def test_a_turn_on_the_spot_and_a_failure(client: TestClient) -> None:
    beyond = {"type": "line", "target": at(1.5, 1.2)}
    content, text = worked(client, "planar_2r", start=[0.3, 0.8], task=["x", "y"], segments=[beyond])
    assert content["failure"]["reason"] == "out_of_reach"
    assert number(text, r"T = ([\d.]+) s") == pytest.approx(content["duration"])
