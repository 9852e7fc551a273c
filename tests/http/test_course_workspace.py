"""Planar workspaces over HTTP."""

import json
from math import hypot, pi
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.planar_workspace import PlanarWorkspaceAnswer

EXAMPLE_WORKSPACE = BY_NAME["planar_workspace"].example

PATH = "/v1/course/workspace"


def good(client: TestClient, **body: Any) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    PlanarWorkspaceAnswer.model_validate_json(answer.content)
    return answer.json()


@pytest.mark.parametrize(
    ("links", "primary", "secondary"),
    [
        ([1.0, 0.7], [[0.3, 1.7]], []),
        ([1.0, 0.7, 0.2], [[0.1, 1.9]], [[0.5, 1.5]]),
        ([1.0, 0.2, 0.3], [[0.5, 1.5]], []),
        ([0.5, 0.5, 0.5], [[0.0, 1.5]], [[0.0, 0.5]]),
        ([1.0, 0.9, 0.5], [[0.0, 2.4]], [[0.0, 0.4], [0.6, 1.4]]),
    ],
    ids=str,
)
def test_the_workspaces_of_the_lecture(
    client: TestClient, links: list[float], primary: list[list[float]], secondary: list[list[float]]
) -> None:
    content = good(client, links=links)
    for name, expected in (("primary", primary), ("secondary", secondary)):
        found = content[name]
        assert len(found["intervals"]) == len(expected)
        assert np.allclose(found["intervals"], expected, atol=1e-12)
        assert found["area"] == pytest.approx(sum(pi * (b**2 - a**2) for a, b in expected))
    assert content["point"] is None
    assert content["certificate"]["radii"] > 40
    assert content["steps"]


@pytest.mark.parametrize(
    ("point", "primary", "secondary", "share"),
    [
        ([0.2, 0.1], "inside", "inside", 1.0),
        ([0.3, 0.4], "inside", "outside", 0.9362314391414802),
        ([0.0, -1.4], "inside", "boundary", 1.0),
        ([2.4, 0.0], "boundary", "outside", 0.0),
        ([2.0, 2.0], "outside", "outside", 0.0),
    ],
)
def test_a_point(client: TestClient, point: list[float], primary: str, secondary: str, share: float) -> None:
    content = good(client, links=[1.0, 0.9, 0.5], point=point)["point"]
    assert content["radius"] == pytest.approx(hypot(*point))
    assert (content["primary"]["location"], content["secondary"]["location"]) == (primary, secondary)
    assert content["orientation_share"] == pytest.approx(share, abs=1e-6)
    widths = [upper - lower for lower, upper in content["orientations"]]
    assert sum(widths) == pytest.approx(2.0 * pi * content["orientation_share"])
    assert (content["orientations"] == []) == (primary == "outside")


def test_an_empty_workspace_has_no_boundary(client: TestClient) -> None:
    content = good(client, links=[1.0, 0.7], point=[0.9, 0.8])
    assert content["point"]["secondary"] == {"location": "outside", "boundary": None, "distance": None}
    assert content["secondary"]["area"] == 0.0
    assert len(content["point"]["orientations"]) == 2


@pytest.mark.parametrize(
    ("fields", "field"),
    [
        ({"links": []}, "links"),
        ({"links": [1.0]}, "links"),
        ({"links": [1.0] * 4}, "links"),
        ({"links": [1.0, -0.7]}, "links/1"),
        ({"links": [1.0, 1e300]}, "links/1"),
        ({"links": [1.0, "0.7"]}, "links/1"),
        ({"links": 3}, "links"),
        ({"point": [0.1]}, "point"),
        ({"point": [0.1, 0.2, 0.3]}, "point"),
        ({"point": [0.1, -1e300]}, "point/1"),
        ({"tolerance": -1e-9}, "tolerance"),
        ({"joint_limits": [[-1.0, 1.0]] * 3}, "joint_limits"),
    ],
)
def test_a_field_that_cannot_be_is_named(client: TestClient, fields: dict[str, Any], field: str) -> None:
    answer = client.post(PATH, json={**EXAMPLE_WORKSPACE, **fields})
    assert answer.status_code == 422, answer.text
    assert answer.json()["errors"][0]["pointer"].startswith(f"#/{field}")


@pytest.mark.parametrize("body", [b"", b"[]", b'{"links": [NaN, 1]}', b'{"links": [1e400, 1]}'])
def test_a_call_that_is_none(client: TestClient, body: bytes) -> None:
    answer = client.post(PATH, content=body, headers={"content-type": "application/json"})
    assert answer.status_code in {400, 422}


@pytest.mark.slow
def test_lengths_of_all_sizes_have_finite_answers(client: TestClient) -> None:
    rng = np.random.default_rng(5)
    for _ in range(200):
        links = (10.0 ** rng.uniform(-12, 6, rng.integers(2, 4))).tolist()
        good(client, links=links, point=(rng.normal(size=2) * 10.0 ** rng.uniform(-12, 5)).tolist())
    for links in ([0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5e-324, 1e-300], [1e6, 5e-324, 1e6]):
        good(client, links=links, point=[0.0, 0.0])
    tenths = rng.integers(0, 8, (100, 5)) / 10.0
    for row in tenths.tolist():
        good(client, links=row[:3], point=row[3:])


@pytest.mark.slow
def test_the_documentation_says_what_other_solutions_miss(client: TestClient) -> None:
    text = json.dumps(client.get("/openapi.json").json()["paths"][PATH])
    assert "miss the disc" in text


@pytest.mark.parametrize(("media_type", "begins"), [("image/svg+xml", b"<?xml"), ("image/png", b"\x89PNG")])
def test_as_a_picture(client: TestClient, media_type: str, begins: bytes) -> None:
    answer = client.post(PATH, json=EXAMPLE_WORKSPACE, headers={"accept": media_type})
    assert answer.status_code == 200, answer.text
    assert answer.headers["content-type"] == media_type
    assert answer.content.startswith(begins)
    again = client.post(PATH, json=EXAMPLE_WORKSPACE, headers={"accept": media_type})
    assert again.content == answer.content


def test_a_bad_call_for_a_picture_is_a_problem(client: TestClient) -> None:
    answer = client.post(PATH, json={"links": [1.0]}, headers={"accept": "image/svg+xml"})
    assert (answer.status_code, answer.headers["content-type"]) == (422, "application/problem+json")


def test_other_media_types_and_queries_are_refused(client: TestClient) -> None:
    assert client.post(PATH, content=b"l=1", headers={"content-type": "text/plain"}).status_code == 415
    assert client.post(f"{PATH}?links=1", json=EXAMPLE_WORKSPACE).status_code == 422
    large = {**EXAMPLE_WORKSPACE, "links": [1.0] * 5000}
    assert client.post(PATH, json=large).status_code == 422
