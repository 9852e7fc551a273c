"""Fly-over over HTTP: the lecture's numbers, the worked solution, and what is refused."""

import json
import math
import time
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.fly_over import FlyOverAnswer
from tests.speed import is_within

EXAMPLE_FLY_OVER = BY_NAME["fly_over"].example

PATH = "/v1/course/fly-over"
IN_SPACE = {
    "start": [0.0, 0.0, 0.0],
    "corner": [1.0, 0.0, 0.0],
    "end": [1.0, 1.0, 0.5],
    "speed_before": 0.5,
    "speed_after": 0.5,
    "max_acceleration": 1.0,
    "rest_acceleration": 1.0,
}


def good(client: TestClient, body: dict[str, Any]) -> Any:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    FlyOverAnswer.model_validate_json(answer.content)
    return answer.json()


def changed(**fields: Any) -> dict[str, Any]:
    """The lecture's example with other fields; None takes one away."""
    return {key: value for key, value in {**EXAMPLE_FLY_OVER, **fields}.items() if value is not None}


# The lecture's numbers


def test_the_fly_over_of_the_lecture(client: TestClient) -> None:
    content = good(client, EXAMPLE_FLY_OVER)
    blend = content["blend"]
    assert (blend["distance_before"], blend["distance_after"]) == pytest.approx((2.0, 4.0))
    assert blend["entry"] == pytest.approx([1.632455532034, 7.102633403899], abs=5e-13)
    assert blend["exit"] == pytest.approx([5.0, 9.0])
    assert blend["acceleration"] == pytest.approx([0.579056941504, -0.237170824513], abs=5e-13)
    assert blend["closest_distance"] == pytest.approx(1.097563964535, abs=5e-13)
    assert blend["closest_time"] == pytest.approx(1.494067815, abs=5e-8)
    assert (blend["turn"], content["given"], content["warnings"]) == ("corner", "blend_time", [])
    assert content["rest_to_rest"] is None
    assert content["samples"]["times"] == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert content["samples"]["velocities"][-1] == pytest.approx([2.0, 0.0], abs=1e-14)
    certificate = content["certificate"]
    assert certificate["max_position_error"] < 1e-12
    assert certificate["max_velocity_error"] < 1e-12
    assert certificate["closest_distance_error"] < 1e-4
    text = json.dumps(content["steps"])
    assert "1.632455532" in text
    assert "0.5790569415" in text
    assert "1.097563965" in text


@pytest.mark.parametrize(
    ("fields", "blend_time", "after", "size"),
    [
        ({"distance_before": 3.0}, 6.0, 6.0, 0.417163406036),
        ({"distance_after": 6.0}, 6.0, 6.0, 0.417163406036),
        ({"radius": 6.0}, 6.0, 6.0, 0.417163406036),
        ({"max_acceleration": 0.5}, 5.005960872427, 5.005960872427, 0.5),
    ],
)
def test_the_other_quantities(
    client: TestClient, fields: dict[str, float], blend_time: float, after: float, size: float
) -> None:
    content = good(client, changed(blend_time=None, **fields))
    assert [content["given"]] == list(fields)
    assert content["blend"]["blend_time"] == pytest.approx(blend_time, abs=5e-13)
    assert content["blend"]["distance_after"] == pytest.approx(after, abs=5e-13)
    assert content["blend"]["acceleration_norm"] == pytest.approx(size, abs=5e-13)
    assert "\\Delta T" in content["steps"][1]["latex"][0]


def test_from_rest_to_rest_in_space(client: TestClient) -> None:
    content = good(client, {**IN_SPACE, "samples": 1001})
    whole = content["rest_to_rest"]
    assert whole["duration"] == pytest.approx(4.736067977500, abs=5e-13)
    assert whole["stopping_duration"] == pytest.approx(5.236067977500, abs=5e-13)
    assert whole["time_saved"] == pytest.approx(0.5)
    assert [phase["duration"] for phase in whole["phases"]] == pytest.approx(
        [0.5, 1.396446609407, 0.707106781187, 1.632514586907, 0.5], abs=5e-13
    )
    assert len(content["motion"]["coefficients"]) == 5
    positions = np.array(content["samples"]["positions"])
    assert positions[0] == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert positions[-1] == pytest.approx([1.0, 1.0, 0.5])
    assert content["samples"]["times"][-1] == whole["duration"]
    speeds = np.linalg.norm(content["samples"]["velocities"], axis=1)
    assert speeds.max() <= 0.5 + 1e-12
    steps = np.diff(positions, axis=0) * 1000.0 / whole["duration"]
    assert np.linalg.norm(steps, axis=1).max() <= 0.5 + 1e-9


# Corners that are none


def test_straight_on(client: TestClient) -> None:
    body = changed(corner=[4.0, 4.0], end=[8.0, 8.0], blend_time=None, max_acceleration=1.0)
    content = good(client, body)
    assert content["blend"]["turn"] == "straight"
    assert content["blend"]["closest_distance"] == pytest.approx(0.0, abs=1e-14)
    assert "one line" in content["warnings"][0]
    same = good(client, {**body, "speed_after": 1.0})
    assert same["blend"]["blend_time"] < 1e-12
    along_x = {"start": [0.0, 0.0], "corner": [4.0, 0.0], "end": [8.0, 0.0], "speed_after": 1.0}
    nothing = good(client, {**body, **along_x})
    assert (nothing["blend"]["blend_time"], nothing["motion"], nothing["samples"]) == (0.0, None, None)
    assert nothing["certificate"]["steps"] == 0
    assert "takes no time" in nothing["warnings"][1]
    whole = good(client, {**body, **along_x, "rest_acceleration": 0.5})
    assert whole["rest_to_rest"]["duration"] == pytest.approx(8.0 + 1.0 / 0.5), "the trapezoid of the whole way"


def test_a_reversal(client: TestClient) -> None:
    content = good(client, changed(start=[0.0, 0.0], corner=[8.0, 0.0], end=[-2.0, 0.0], speed_after=1.0))
    assert content["blend"]["turn"] == "reversal"
    assert content["blend"]["angle"] == pytest.approx(math.pi)
    assert content["blend"]["closest_distance"] == pytest.approx(1.0)
    assert content["samples"]["velocities"][2] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert "without reaching B" in content["warnings"][0]


def test_from_rest_and_to_rest(client: TestClient) -> None:
    leaving = good(client, changed(speed_before=0.0))
    assert leaving["blend"]["entry"] == [1.0, 9.0]
    assert "v₁ is 0" in leaving["warnings"][0]
    arriving = good(client, changed(speed_after=0.0))
    assert arriving["blend"]["exit"] == [1.0, 9.0]
    assert "v₂ is 0" in arriving["warnings"][0]


# What is refused

REFUSED = [
    ({"blend_time": None}, "blend_time"),
    ({"distance_before": 1.0}, "distance_before"),
    ({"blend_time": 8.0}, "blend_time"),
    ({"blend_time": None, "distance_before": 3.6}, "distance_before"),
    ({"blend_time": None, "distance_after": 7.1}, "distance_after"),
    ({"blend_time": None, "radius": 7.1}, "radius"),
    ({"blend_time": None, "max_acceleration": 0.3}, "max_acceleration"),
    ({"speed_before": 0.0, "blend_time": None, "distance_before": 1.0}, "distance_before"),
    *(({"blend_time": value}, "blend_time") for value in (0.0, -1.0, 1e300, 1e-300)),
    *(({"speed_before": value}, "speed_before") for value in (-1.0, 1e300, 1e-300, "1")),
    ({"speed_before": 0.0, "speed_after": 0.0}, "speed_after"),
    ({"start": [1.0, 9.0]}, "start"),
    ({"end": [1.0, 9.0]}, "end"),
    ({"start": [1.0, 2.0, 3.0]}, "corner"),
    ({"end": [1.0, 2.0, 3.0]}, "end"),
    *(({"corner": value}, "corner") for value in ([1.0], [1.0] * 4, [1e300, 0.0], "B", [[1.0, 2.0]])),
    ({"rest_acceleration": 0.0}, "rest_acceleration"),
    ({"rest_acceleration": 0.1}, "speed_before"),
    ({"rest_acceleration": 1e6, "speed_before": 1e-5, "speed_after": 1e-5}, "rest_acceleration"),
    ({"rest_acceleration": 0.4, "speed_before": 0.5, "blend_time": 6.0}, "speed_after"),
    ({"rest_acceleration": 1.0, "speed_before": 0.0}, "speed_before"),
    *(({"samples": value}, "samples") for value in (1, 10_001, 10**6, 2.5)),
    ({"unit": "mm"}, "unit"),
]


@pytest.mark.parametrize(("fields", "field"), REFUSED, ids=[str(fields)[:60] for fields, _ in REFUSED])
def test_a_field_that_cannot_be_is_named(client: TestClient, fields: dict[str, Any], field: str) -> None:
    started, by_the_clock = time.process_time(), time.monotonic()
    answer = client.post(PATH, json=changed(**fields))
    assert is_within(time.process_time() - started, 1.0)
    assert time.monotonic() - by_the_clock < 20.0, "it comes from another process, or waits"
    assert answer.status_code == 422, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    problem = answer.json()
    pointers = [problem["pointer"]] if "pointer" in problem else [place["pointer"] for place in problem["errors"]]
    assert pointers[0].startswith(f"#/{field}"), problem


COUPLED = {"start", "blend_time", "max_acceleration", "rest_acceleration"}
"""What a refusal names where numbers that are allowed one by one do not go together."""


def place_of(problem: dict[str, Any]) -> str:
    """The field of the request that a refusal is about."""
    pointer: str = problem["pointer"] if "pointer" in problem else problem["errors"][0]["pointer"]
    return pointer.split("/")[1]


def test_every_number_may_be_as_large_or_small_as_json_has_them(client: TestClient) -> None:
    """Whatever is put in the place of a number: an answer without NaN, or a refusal that says where."""
    for body in (EXAMPLE_FLY_OVER, IN_SPACE):
        for field, value in body.items():
            for number in (1e300, -1e300, 1e-300, 5e-324, -0.0, 1e12, 1e9, 1e6, 1e-9):
                put = [number, *value[1:]] if isinstance(value, list) else number
                answer = client.post(PATH, json={**body, field: put})
                if answer.status_code == 422:
                    # What is allowed alone may not fit the rest, which is said of the field that can be changed.
                    fits_alone = field in {"start", "corner", "end", "max_acceleration"} and abs(number) <= 1e6
                    assert place_of(answer.json()) in ({field, *COUPLED} if fits_alone else {field}), answer.text
                else:
                    assert answer.status_code == 200, answer.text
                    FlyOverAnswer.model_validate_json(answer.content)


@pytest.mark.parametrize("body", [b"", b"[]", b"{", b"null", b'{"blend_time": NaN}', b'{"start": [1e400, 0]}'])
def test_a_call_that_is_none(client: TestClient, body: bytes) -> None:
    answer = client.post(PATH, content=body, headers={"content-type": "application/json"})
    assert answer.status_code in {400, 422}
    assert answer.headers["content-type"] == "application/problem+json"


def test_other_media_types_and_queries_are_refused(client: TestClient) -> None:
    assert client.post(PATH, content=b"A=0", headers={"content-type": "text/plain"}).status_code == 415
    assert client.post(f"{PATH}?blend_time=1", json=EXAMPLE_FLY_OVER).status_code == 422


@pytest.mark.slow
def test_random_corners_have_finite_answers(client: TestClient) -> None:
    """Over the whole range that is allowed, log-uniformly: nothing overflows and every certificate holds."""
    rng, answered = np.random.default_rng(3), 0
    for _ in range(300):
        dimensions = int(rng.integers(2, 4))
        points = rng.normal(size=(3, dimensions)) * 10.0 ** rng.uniform(-9.0, 5.0)
        if rng.random() < 0.3:
            points[2] = points[1] + rng.choice([-1.0, 1.0]) * rng.random() * (points[1] - points[0])
        speeds = np.where(rng.random(2) < 0.1, 0.0, 10.0 ** rng.uniform(-6.0, 4.0, 2))
        body = dict(zip(("start", "corner", "end"), points.tolist(), strict=True))
        body |= {"speed_before": float(speeds[0]), "speed_after": float(speeds[1])}
        given = {
            "blend_time": 10.0 ** rng.uniform(-6.0, 6.0),
            "radius": 10.0 ** rng.uniform(-9.0, 5.0),
            "max_acceleration": 10.0 ** rng.uniform(-6.0, 6.0),
        }
        name = str(rng.choice(list(given)))
        if rng.random() < 0.5:
            body["rest_acceleration"] = 10.0 ** rng.uniform(-6.0, 6.0)
        answer = client.post(PATH, json={**body, name: given[name], "samples": 7})
        if answer.status_code == 422:
            assert place_of(answer.json()) in {name, "speed_before", "speed_after", *COUPLED}, answer.text
        else:
            assert answer.status_code == 200, answer.text
            FlyOverAnswer.model_validate_json(answer.content)
            answered += 1
    assert answered > 50


def test_ten_thousand_samples(client: TestClient) -> None:
    started = time.perf_counter()
    content = good(client, {**IN_SPACE, "samples": 10_000})
    assert is_within(time.perf_counter() - started, 2.0)
    assert len(content["samples"]["positions"]) == 10_000


@pytest.mark.quick(1)
@pytest.mark.parametrize(("media_type", "begins"), [("image/svg+xml", b"<?xml"), ("image/png", b"\x89PNG")])
def test_as_a_picture(client: TestClient, media_type: str, begins: bytes) -> None:
    answer = client.post(PATH, json=EXAMPLE_FLY_OVER, headers={"accept": media_type})
    assert answer.status_code == 200
    assert answer.headers["content-type"] == media_type
    assert answer.content.startswith(begins)
    refused = client.post(PATH, json={**EXAMPLE_FLY_OVER, "blend_time": -1.0}, headers={"accept": media_type})
    assert refused.status_code == 422
