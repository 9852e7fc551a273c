"""Worked solutions where the usual formulas end: no coast, a turn back, a residual in the kernel, a lost sample."""

import math
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient


def answer_to(client: TestClient, path: str, body: dict[str, Any]) -> Any:
    answer = client.post(f"/v1/{path}", json=body)
    assert answer.status_code == 200, answer.text
    return answer.json()


def lines(steps: list[dict[str, Any]], title: str) -> list[str]:
    found: list[str] = next(step["plain"] for step in steps if step["title"] == title)
    return found


def test_without_a_coast_sigma_has_two_pieces_that_end_at_the_length(client: TestClient) -> None:
    limits = {"joint_velocity": 0.8, "joint_acceleration": 1.6}
    body = {"law": "trapezoidal", "start": 0, "target": 0.3, "limits": limits}
    titles = [step["title"] for step in answer_to(client, "course/time-law", body)["steps"]]
    assert "The two pieces" in titles
    assert "The three pieces" not in titles
    a, T = 1.6, 2.0 * math.sqrt(0.3 / 1.6)
    assert a * (T / 2) ** 2 / 2 == pytest.approx(0.3 - a * (T / 2 - T) ** 2 / 2)


@pytest.mark.parametrize(("speed_after", "turns"), [(0.5, True), (0.0, False)])
def test_a_reversal_is_named_where_the_motion_turns(client: TestClient, speed_after: float, turns: bool) -> None:
    body = {"start": [0, 0], "corner": [1, 0], "end": [0, 0], "speed_before": 0.5, "speed_after": speed_after}
    steps = answer_to(client, "course/fly-over", {**body, "max_acceleration": 1})["steps"]
    text = next(step["text"] for step in steps if step["title"] == "The blend")
    assert ("stops for a moment before B" in text) == turns


def test_a_projected_matrix_is_shown_as_it_was_given(client: TestClient) -> None:
    body = {"rotation": [[1, 0.01, 0], [0, 1, 0], [0, 0, 1]], "project": True}
    steps = answer_to(client, "course/orientation", body)["steps"]
    assert lines(steps, "Rotation matrix") == ["R = [1, 0.01, 0; 0, 1, 0; 0, 0, 1]"]


@pytest.mark.parametrize(("representation", "name"), [("geometric", "J"), ("zyz", "J_a")])
def test_the_rank_is_that_of_the_matrix_asked_for(client: TestClient, representation: str, name: str) -> None:
    q = [[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]]
    body = {"joint_positions": q, "representation": representation, "steps": True}
    answer = answer_to(client, "robots/ur5/jacobian", body)
    determinant = np.linalg.det(np.array(answer["jacobians"][0]))
    assert f"det {name} = {determinant:.6g}" in lines(answer["steps"][0], "Rank and condition")


def test_an_iteration_that_rests_in_the_kernel_says_so(client: TestClient) -> None:
    body = {"targets": [{"position": [0.5, 0, 0]}], "task": ["x", "y"], "method": "gradient", "seeds": [[0, 0]]}
    answer = answer_to(client, "robots/planar_2r/ik", {**body, "trace": True, "steps": True})
    assert lines(answer["results"][0]["steps"], "Where it rests")[1] == "e_0 = (-1.2, 0),  Jᵀ e_0 ≈ 0"
    body["seeds"] = [[0.3, 1.2]]
    answer = answer_to(client, "robots/planar_2r/ik", {**body, "trace": True, "steps": True})
    assert "Where it rests" not in [step["title"] for step in answer["results"][0]["steps"]]


def test_samples_are_decoded_in_the_steps(client: TestClient) -> None:
    body = {"type": "incremental", "pulses_per_revolution": 1024, "samples": "00 10 11 01 00 11"}
    steps = answer_to(client, "course/encoder", body)["steps"]
    assert lines(steps, "Decoding")[1:] == [
        "z = (0, 1, 2, 3, 4, 4),  z_end = 4",
        "φ_m = z_end · 360°/4096 = 0.3515625°",
    ]
    assert "it counts nothing" in next(step["text"] for step in steps if step["title"] == "Decoding")


def test_samples_out_of_reach_are_named(client: TestClient) -> None:
    body = {"lengths": [1, 1], "start": [0.5, 1], "target": [5, 5], "samples": 5, "duration": 2}
    steps = answer_to(client, "course/pipeline", body)["steps"]
    assert "out of reach" in next(step["text"] for step in steps if step["title"] == "Sample 1 in full")
    assert "q_1 = (0.5, -, -, -, -)" in lines(steps, "3. Samples and inverse kinematics")
