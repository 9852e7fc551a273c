"""Triangles over HTTP: the example, both languages, the picture, and refusals that name their field."""

import math
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.triangle import TriangleAnswer

PATH = "/v1/course/triangle"
EXAMPLE = BY_NAME["triangle"].example


def test_the_example_is_the_lectures(client: TestClient) -> None:
    answer = client.post(PATH, json=EXAMPLE)
    assert answer.status_code == 200, answer.text
    TriangleAnswer.model_validate_json(answer.content)
    content: dict[str, Any] = answer.json()
    (triangle,) = content["triangles"]
    assert content["case"] == "SAS"
    assert triangle["c"] == pytest.approx(3.605551275464, abs=5e-13)
    corner = triangle["corners"][2]
    assert math.hypot(*corner) == pytest.approx(4.0)
    assert [step["title"] for step in content["steps"]] == ["What is given", "Law of cosines", "Angles", "Check"]
    assert content["certificate"]["max_side_error"] < 1e-14


def test_two_triangles_are_drawn_and_listed(client: TestClient) -> None:
    body = {"a": 3.0, "b": 4.0, "alpha": 0.6}
    assert len(client.post(PATH, json=body).json()["triangles"]) == 2
    for kind, start in (("image/svg+xml", b"<?xml"), ("image/png", b"\x89PNG"), ("application/pdf", b"%PDF")):
        picture = client.post(PATH, json=body, headers={"accept": kind})
        assert picture.status_code == 200
        assert picture.content.startswith(start)


@pytest.mark.parametrize(
    ("body", "field"),
    [({"a": 1.0, "b": 2.0, "c": 4.0}, "c"), ({"a": 1.0, "b": 2.0, "gamma": 3.2}, "gamma"), ({"a": 0.0}, "a")],
)
def test_a_refusal_names_its_field(client: TestClient, body: dict[str, float], field: str) -> None:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 422
    assert field in answer.text
