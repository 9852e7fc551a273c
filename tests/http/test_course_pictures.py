"""The course's pictures over HTTP: the list, each of them, and those of the calculators."""

from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.exercises import CoursePictures
from gelenk.plots.course.titles import CALCULATED, TITLES

PICTURES = "/v1/course/pictures"
SVG, PNG = {"Accept": "image/svg+xml"}, {"Accept": "image/png"}
STATICS: dict[str, Any] = {"joint_positions": [[0.3, 0.8]], "wrenches": [[6.0, -8.0, 0.0, 0.0, 0.0, 0.0]]}
COUNTS = {"space": "planar", "links": 4, "pairs": {"revolute": 4}}


@pytest.mark.slow
def test_the_list_names_pictures_that_are_there(client: TestClient) -> None:
    listed = CoursePictures.model_validate_json(client.get(PICTURES).content)
    assert [picture.name for picture in listed.pictures] == sorted({*TITLES, *CALCULATED})
    german = CoursePictures.model_validate_json(client.get(PICTURES, params={"language": "de"}).content)
    assert (
        "Das sphärische Handgelenk" in {picture.name: picture.title for picture in german.pictures}["spherical-wrist"]
    )
    for picture in listed.pictures:
        answer = client.get(f"{PICTURES}/{picture.name}")
        assert answer.status_code == 200
        assert answer.headers["content-type"] == "image/svg+xml"
        assert answer.content.startswith(b"<?xml")


@pytest.mark.slow
def test_format_and_language(client: TestClient) -> None:
    path = f"{PICTURES}/kinematic-spaces"
    assert client.get(path, headers=PNG).content.startswith(b"\x89PNG")
    english, german = (client.get(path, params={"language": code}).content for code in ("en", "de"))
    assert english != german
    assert english == client.get(path).content


def test_an_unknown_picture_is_answered_with_those_there_are(client: TestClient) -> None:
    answer = client.get(f"{PICTURES}/wrist")
    assert answer.status_code == 404
    assert answer.json()["type"] == "urn:gelenk:unknown-picture"
    assert answer.json()["pictures"] == [*TITLES, *CALCULATED]
    assert client.get(f"{PICTURES}/joint-pairs", params={"language": "fr"}).status_code == 422


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["dc_motor", "pulse_width_modulation", "encoder", "count_mobility"])
def test_calculators_draw_their_examples(client: TestClient, name: str) -> None:
    endpoint = next(one for one in BY_NAME.values() if one.id == name)
    path = f"/{endpoint.path}"
    answer = client.post(path, json=endpoint.example, headers=SVG)
    assert answer.status_code == 200, answer.text
    assert answer.content.startswith(b"<?xml")
    assert client.post(path, json=endpoint.example, headers=PNG).content.startswith(b"\x89PNG")
    assert client.post(path, json=endpoint.example).headers["content-type"] == "application/json"


@pytest.mark.parametrize(
    ("path", "body"),
    [
        ("course/encoder", {"type": "absolute", "bits": 4, "readings": ["0110", "0111"]}),
        ("course/encoder", {"type": "incremental", "pulses_per_revolution": 100}),
        ("course/pwm", {"supply_voltage": 24.0, "frequency": 50.0, "average_voltage": -12.0}),
        ("course/mobility", {"robot": "ur5"}),
        ("robots/planar_2r/statics", STATICS),
    ],
)
def test_other_requests_are_drawn_too(client: TestClient, path: str, body: dict[str, Any]) -> None:
    answer = client.post(f"/v1/{path}", json=body, headers=SVG)
    assert answer.status_code == 200, answer.text
    assert answer.content.startswith(b"<?xml")


@pytest.mark.parametrize(
    ("path", "body", "field"),
    [
        ("course/encoder", {"type": "absolute", "bits": 11}, "bits"),
        ("course/encoder", {"type": "absolute", "wanted_resolution": 0.01}, "bits"),
        ("course/mobility", COUNTS, "pairs"),
        ("robots/planar_2r/statics", {**STATICS, "joint_positions": [[0.3, 0.8]] * 2}, "joint_positions"),
        ("robots/planar_2r/statics", {**STATICS, "gravity": True}, "gravity"),
        ("robots/planar_2r/statics", {**STATICS, "reference": "local"}, "reference"),
        ("robots/planar_2r/statics", {**STATICS, "wrenches": [[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]}, "wrenches"),
        ("robots/planar_2r/statics", {**STATICS, "wrenches": [[0.0, 1.0, 0.0, 0.0, 0.0, 1.0]]}, "wrenches"),
        ("robots/planar_2r/statics", {"joint_positions": [[0.3, 0.8]], "subspaces": True}, "wrenches"),
        ("robots/panda/statics", BY_NAME["statics"].example | {"gravity": False, "payload": None}, "Accept"),
    ],
)
def test_what_a_picture_cannot_show_is_refused(client: TestClient, path: str, body: dict[str, Any], field: str) -> None:
    answer = client.post(f"/v1/{path}", json=body, headers=SVG)
    assert answer.status_code == 422, answer.text
    assert answer.json()["field"] == field
    assert client.post(f"/v1/{path}", json=body).status_code == 200
