"""Descriptions with faults that kinematics does not feel: taken with warnings, and refused where `strict` is asked."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.corpus.urdf import ARM, FORGIVEN as _FORGIVEN
from tests.corpus.zips import zipped
from tests.http.conftest import ready_client

FORGIVEN = {case.name: case.text for case in _FORGIVEN[::12]} | {
    "early line": '\n<?xml version="1.0"?>' + ARM,
    "an axis twice": ARM.replace('<axis xyz="0 0 1"/>', '<axis xyz="0 0 1"/>' * 2),
}


@pytest.fixture
def own(tmp_path: Path) -> Any:
    yield from ready_client(tmp_path)


def as_json(client: TestClient, name: str | None, urdf: str, **fields: Any) -> Any:
    send, path = (client.post, "/v1/robots") if name else (client.put, "/v1/robots/arm")
    return send(path, json={"urdf": urdf, **fields, **({"name": name} if name else {})})


def as_zip(client: TestClient, name: str | None, urdf: str, **fields: Any) -> Any:
    send, path = (client.post, "/v1/robots") if name else (client.put, "/v1/robots/arm")
    form = {key: str(value).lower() for key, value in fields.items()} | ({"name": name} if name else {})
    return send(path, data=form, files={"archive": ("arm.zip", zipped({"arm.urdf": urdf}))})


@pytest.mark.slow
@pytest.mark.parametrize("upload", [as_json, as_zip])
def test_an_upload_is_taken_with_warnings_or_strictly_refused(own: TestClient, upload: Callable[..., Any]) -> None:
    assert upload(own, "arm", ARM, strict=True).status_code == 201
    for urdf in FORGIVEN.values():
        for name in (None, "faulty"):
            refused = upload(own, name, urdf, strict=True)
            assert refused.status_code == 422, refused.text
            assert refused.json()["type"].endswith("invalid-urdf")
        assert own.get("/v1/robots/faulty").status_code == 404
        added, replaced = upload(own, "faulty", urdf), upload(own, None, urdf, strict=False)
        assert (added.status_code, replaced.status_code) == (201, 200), added.text + replaced.text
        assert added.json()["warnings"] == replaced.json()["warnings"] != []
        assert own.get("/v1/robots/faulty").json()["warnings"] == added.json()["warnings"]
        assert own.get("/v1/robots/faulty/urdf").text == urdf
        poses = own.post("/v1/robots/faulty/fk", json={"joint_positions": [[0.4]]})
        assert poses.status_code == 200, poses.text
        assert own.delete("/v1/robots/faulty").status_code == 204


@pytest.mark.quick(5)
@pytest.mark.parametrize("urdf", FORGIVEN.values(), ids=FORGIVEN)
def test_a_table_of_a_faulty_urdf(client: TestClient, urdf: str) -> None:
    answer = client.post("/v1/dh/from-urdf", json={"urdf": urdf})
    assert answer.status_code == 200, answer.text
    assert answer.json()["warnings"]
    assert answer.json()["dh"] == client.post("/v1/dh/from-urdf", json={"urdf": ARM}).json()["dh"]
    refused = client.post("/v1/dh/from-urdf", json={"urdf": urdf, "strict": True})
    assert refused.status_code == 422
    assert refused.json()["type"].endswith("invalid-urdf")


def test_strict_is_yes_or_no(client: TestClient) -> None:
    for body in ({"urdf": ARM, "strict": "true"}, {"urdf": ARM, "strict": 1}):
        assert client.post("/v1/dh/from-urdf", json=body).status_code == 422
    assert as_zip(client, "arm", ARM, strict="perhaps").status_code == 422
