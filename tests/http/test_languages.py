"""Worked solutions of all examples: formulas that read without LaTeX, and German with the same numbers."""

import re
from collections import Counter
from collections.abc import Iterator
from typing import Any, cast

import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoint import Endpoint, RobotEndpoint
from gelenk.contract.endpoints import BY_NAME
from tests.oracles.written import with_points

NUMBER = re.compile(r"\d+(?:\.\d+)?")
IN_FORMULAS = re.compile(r"\\(?:text|mathrm)\{[^}]*\}")


def fields(endpoint: Endpoint[Any, Any]) -> dict[str, Any]:
    return cast(dict[str, Any], cast(Any, endpoint.request).model_fields)


def has_steps(endpoint: Endpoint[Any, Any]) -> bool:
    answer = cast(Any, endpoint.answer)
    return answer is not None and "Step" in answer.model_json_schema().get("$defs", {})


SPEAKING = [name for name, endpoint in BY_NAME.items() if "language" in fields(endpoint) and has_steps(endpoint)]


TWO_LINKS = [{"type": "revolute", "a": a, "alpha": 0.0, "d": 0.0, "theta": 0.0} for a in (1.0, 0.7)]
WRIST = {"position": [0.6, 0.1, 0.3], "rpy": [3.0, 0.2, 0.4]}
ZIGZAG = {"waypoints": [0.0, 0.3, 1.2, 1.5], "times": [0.0, 0.5, 1.5, 2.0]}
SLOW = {"joint_velocity": 0.8, "joint_acceleration": 1.6}
OTHERS: list[tuple[str, str, dict[str, Any]]] = [
    *(("time_law", "", {"law": law, "start": 0.2, "target": 1.4, "duration": 2.0}) for law in ("quintic", "septic")),
    ("time_law", "", {"law": "cubic", "start": [0.2, 1.0], "target": [0.2, 2.0], "duration": 2.0}),
    ("time_law", "", {"law": "4-3-4", **ZIGZAG}),
    ("time_law", "", {"law": "parabolic_blends", "blend_time": 0.2, **ZIGZAG}),
    ("time_law", "", {"law": "trapezoidal", "start": [0.0, 0.0], "target": [2.0, 0.3], "limits": SLOW}),
    ("time_law", "", {"law": "trapezoidal", "start": 0.0, "target": 2.0, "duration": 4.0, "limits": SLOW}),
    ("time_law", "", {"law": "trapezoidal", "start": 0.0, "target": 2.0, "end_velocity": 0.1, "limits": SLOW}),
    *(("spline", "", {**ZIGZAG, "boundary": boundary}) for boundary in ("natural", "not_a_knot", "assigned")),
    ("derive_dh", "", {"dh": {"convention": "standard", "joints": TWO_LINKS}, "dynamics": {"links": [{}, {}]}}),
    ("derive_dh", "", {"dh": {"convention": "modified", "joints": TWO_LINKS}, "symbolic": False}),
    *(("ik", robot, {"targets": [WRIST], "solutions": "all"}) for robot in ("ur5", "puma560", "stanford")),
    ("ik", "planar_2r", {"targets": [{"position": [0.9, 0.8, 0.0], "rpy": [0, 0, 0]}], "task": ["x", "y"]}),
    ("jacobian", "planar_2r", {"joint_positions": [[0.3, 0.0]]}),
    ("mobility", "panda", {"robot": "panda"}),
]
"""Further requests, and the robot that they are about."""


def answered(client: TestClient, name: str, language: str, robot: str = "panda", request: Any = None) -> Any:
    endpoint = BY_NAME[name]
    given = request or endpoint.example
    asked = {**given, "language": language, **({"steps": True} if "steps" in fields(endpoint) else {})}
    path = endpoint.path.format(robot=robot) if isinstance(endpoint, RobotEndpoint) else endpoint.path
    answer = client.post(f"/{path}", json=asked)
    assert answer.status_code == 200, answer.text
    return answer.json()


def steps(content: Any) -> Iterator[dict[str, Any]]:
    """All steps in an answer, at any depth."""
    if isinstance(content, dict):
        if content.keys() >= {"title", "text", "latex", "plain"}:
            yield content
        content = list(content.values())
    if isinstance(content, list):
        for item in content:
            yield from steps(item)


def numbers(step: dict[str, Any]) -> Counter[str]:
    text = re.sub(r"(?<=\d),(?=\d)", ".", step["text"])
    return Counter(NUMBER.findall(" ".join([step["title"], text, *map(with_points, step["latex"])])))


@pytest.mark.quick(12)
@pytest.mark.parametrize(("name", "robot", "request_"), [*((name, "panda", None) for name in SPEAKING), *OTHERS])
def test_a_solution_reads_without_latex_and_in_german(
    client: TestClient, name: str, robot: str, request_: dict[str, Any] | None
) -> None:
    english, german = (list(steps(answered(client, name, language, robot, request_))) for language in ("en", "de"))
    assert english
    assert [len(one["latex"]) for one in english] == [len(one["latex"]) for one in german]
    for one, other in zip(english, german, strict=True):
        assert "\\" not in "".join((*one["plain"], *other["plain"], one["text"], other["text"]))
        assert numbers(one) == numbers(other)
        assert one["text"] != other["text"] or not re.search(r"[A-Za-z]{4}", one["text"]), one["text"]
        assert not re.search(r"\d\.\d", " ".join((other["title"], other["text"], *other["latex"], *other["plain"])))
        formulas = (IN_FORMULAS.sub("", with_points(" ".join(step["latex"]))) for step in (one, other))
        assert next(formulas) == next(formulas)


def test_warnings_speak_too_and_problems_do_not(client: TestClient) -> None:
    asked = {**BY_NAME["pulse_width_modulation"].example, "duty": 1.0, "language": "de"}
    for other in ("average_voltage", "angular_velocity"):
        asked.pop(other, None)
    answer = client.post("/v1/course/pwm", json=asked)
    assert "Am Motor liegt die Versorgung selbst" in answer.json()["warnings"][0]
    refused = client.post("/v1/course/pwm", json={**asked, "duty": 2.0})
    assert "less than or equal to 1" in refused.text
    unknown = client.post("/v1/course/pwm", json={**asked, "language": "fr"})
    assert unknown.status_code == 422
    assert "language" in unknown.text


def test_a_cached_derivation_does_not_speak_the_language_of_the_last_request(client: TestClient) -> None:
    german, english, again = (answered(client, "derive_dh", language) for language in ("de", "en", "de"))
    assert german == again
    assert german["legend"][0]["meaning"].startswith("Länge")
    assert english["legend"][0]["meaning"].startswith("length")
    assert german["determinant"]["why"] != english["determinant"]["why"]
