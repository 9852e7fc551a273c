"""Meshes over HTTP: as they are or small, compressed or not, and asked for again only when they have changed."""

import gzip
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.operations.display import stored
from tests.collision.shapes.test_meshes import FACES, binary_stl
from tests.corpus.zips import URDF, zipped
from tests.http.conftest import ready_client
from tests.operations.display.test_small_meshes import coloured, read

GLB = "model/gltf-binary"
STL = binary_stl(FACES)
TEXTURED = coloured("<phong><diffuse><texture texture='t'/></diffuse></phong>")
FILES = {"arm.stl": STL, "broken.stl": b"solid", "textured.dae": TEXTURED}


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[TestClient, Path]]:
    """A client of an application with a robot of a simple, a broken and a textured mesh; and its data folder."""
    data = tmp_path_factory.mktemp("meshes")
    for client in ready_client(data):
        assert upload(client, "POST", FILES).status_code == 201
        yield client, data


def upload(client: TestClient, method: str, files: dict[str, bytes]) -> Any:
    visual = '<visual><geometry><mesh filename="meshes/{}"/></geometry></visual>'
    urdf = URDF.replace("</link>", "".join(map(visual.format, files)) + "</link>", 1)
    content = zipped({"arm.urdf": urdf, **{f"meshes/{name}": file for name, file in files.items()}})
    path, fields = ("/v1/robots", {"name": "arm"}) if method == "POST" else ("/v1/robots/arm", {})
    return client.request(method, path, data=fields, files={"archive": ("arm.zip", content)})


def mesh(client: TestClient, name: str, accept: str = f"{GLB}, */*;q=0.5", **headers: str) -> Any:
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    return client.get(f"/v1/robots/arm/meshes/meshes/{name}", headers={"Accept": accept, **named})


def test_a_mesh_is_small_for_who_names_that_form(arm: tuple[TestClient, Path]) -> None:
    client, data = arm
    answer = mesh(client, "arm.stl")
    assert (answer.status_code, answer.headers["content-type"]) == (200, GLB)
    assert read(answer.content).area == pytest.approx(1 + 1.5 + 3 + 3.5, abs=1e-3)
    assert answer.headers["content-security-policy"].startswith("default-src 'none'")
    assert mesh(client, "arm.stl").content == answer.content
    assert len(list((data / "robots" / ".derived").glob("*.glb.gz"))) >= 1


@pytest.mark.parametrize("accept", ["*/*", "", "model/stl", f"model/stl, {GLB};q=0.5", f"{GLB};q=0", "text/html"])
def test_all_others_get_the_file_itself(arm: tuple[TestClient, Path], accept: str) -> None:
    answer = mesh(arm[0], "arm.stl", accept)
    assert (answer.headers["content-type"], answer.content) == ("model/stl", STL)


@pytest.mark.parametrize(("name", "type_"), [("broken.stl", "model/stl"), ("textured.dae", "model/vnd.collada+xml")])
def test_what_has_no_small_form_is_sent_as_it_is(
    arm: tuple[TestClient, Path], monkeypatch: pytest.MonkeyPatch, name: str, type_: str
) -> None:
    for _ in range(2):  # and found out once
        answer = mesh(arm[0], name)
        assert (answer.status_code, answer.headers["content-type"], answer.content) == (200, type_, FILES[name])
        monkeypatch.setattr(stored, "small_mesh", None)


@pytest.mark.parametrize("accept", ["*/*", GLB])
@pytest.mark.parametrize("encoding", ["gzip", "identity"])
def test_an_unchanged_mesh_is_not_sent_again(arm: tuple[TestClient, Path], accept: str, encoding: str) -> None:
    client, _ = arm
    first = mesh(client, "arm.stl", accept, Accept_Encoding=encoding)
    assert first.headers["vary"] == "Accept, Accept-Encoding"
    assert first.headers["cache-control"] == "private, no-cache"
    assert first.headers.get("content-encoding") == ("gzip" if (accept, encoding) == (GLB, "gzip") else None)
    for tag in (first.headers["etag"], f'"other", W/{first.headers["etag"]}', "*"):
        again = mesh(client, "arm.stl", accept, Accept_Encoding=encoding, If_None_Match=tag)
        assert (again.status_code, again.content) == (304, b"")
        assert {name: again.headers[name] for name in ("etag", "vary", "cache-control")} == {
            name: first.headers[name] for name in ("etag", "vary", "cache-control")
        }
    assert mesh(client, "arm.stl", accept, Accept_Encoding=encoding, If_None_Match='"other"').status_code == 200


def test_each_form_has_a_tag_of_its_own(arm: tuple[TestClient, Path]) -> None:
    forms = [(GLB, "gzip"), (GLB, "identity"), ("*/*", "identity")]
    tags = {mesh(arm[0], "arm.stl", accept, Accept_Encoding=coding).headers["etag"] for accept, coding in forms}
    assert len(tags) == len(forms)


def test_the_head_of_a_mesh_is_that_of_its_answer(arm: tuple[TestClient, Path]) -> None:
    client, _ = arm
    mesh(client, "arm.stl")
    headers = {"Accept": GLB, "Accept-Encoding": "gzip"}
    head = client.head("/v1/robots/arm/meshes/meshes/arm.stl", headers=headers)
    with client.stream("GET", "/v1/robots/arm/meshes/meshes/arm.stl", headers=headers) as answer:
        raw = b"".join(answer.iter_raw())
    assert (head.status_code, head.content) == (200, b"")
    assert int(head.headers["content-length"]) == len(raw)
    assert read(gzip.decompress(raw)).area > 0
    assert head.headers["etag"] == answer.headers["etag"]


def test_a_mesh_that_is_replaced_is_sent_anew(arm: tuple[TestClient, Path]) -> None:
    client, _ = arm
    before = {accept: mesh(client, "arm.stl", accept) for accept in (GLB, "*/*")}
    assert upload(client, "PUT", {**FILES, "arm.stl": binary_stl(2 * FACES)}).status_code == 200
    for accept, first in before.items():
        after = mesh(client, "arm.stl", accept, If_None_Match=first.headers["etag"])
        assert after.status_code == 200
        assert after.content != first.content
    assert upload(client, "PUT", FILES).status_code == 200
