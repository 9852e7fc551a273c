"""Homework over HTTP: sheets in every form, a table of grades."""

import csv
import io
import re
import shutil
import stat
import zipfile
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import fromstring

import pytest
from starlette.testclient import TestClient

from gelenk.errors import NotPrinted, StorageFailed
from gelenk.exercises.mistakes.catalogue import mistake
from gelenk.language import language
from gelenk.sheets import pdf
from gelenk.sheets.document import booklet_page, sheets_page
from gelenk.sheets.key import key_table
from gelenk.store.course_secret import kept_secret
from tests.http.access.asking import HOST, application, ask, bearer, keys_for
from tests.sheets.examples import SECRET, homework

PATH = "/v1/course/sheets"
IDS = ("actuators.gear", "mobility.linkage")
BODY = {"exercises": list(IDS), "participants": ["Ada", "Ben"], "title": "Sheet 1", "secret": SECRET}


def written(client: TestClient, accept: str = "*/*", **fields: Any) -> Any:
    return client.post(PATH, json={**BODY, **fields}, headers={"Accept": accept})


def test_sheets_are_a_page_unless_something_else_is_wanted(client: TestClient) -> None:
    answer = written(client)
    assert answer.headers["content-type"] == "text/html; charset=utf-8"
    assert answer.headers["cache-control"] == "no-store"
    assert answer.text == sheets_page(homework(*IDS))


def test_the_booklet_and_the_key(client: TestClient) -> None:
    assert written(client, content="solutions").text == booklet_page(homework(*IDS))
    answer = written(client, "text/csv")
    assert answer.headers["content-type"] == "text/csv; charset=utf-8"
    assert answer.content.decode() == key_table(homework(*IDS))


def test_a_bundle_and_questions_for_moodle(client: TestClient) -> None:
    archive = zipfile.ZipFile(io.BytesIO(written(client, "application/zip").content))
    assert {"sheets.html", "booklet.html", "key.csv", "moodle.xml"} <= set(archive.namelist())
    assert fromstring(written(client, "application/xml").content).tag == "quiz"


@pytest.mark.quick(1)
@pytest.mark.skipif(shutil.which("chromium") is None, reason="there is no Chromium: apt-get install chromium")
@pytest.mark.parametrize(("content", "pages"), [("sheets", 2), ("solutions", 4)])
def test_a_pdf(client: TestClient, content: str, pages: int) -> None:
    answer = written(client, "application/pdf", content=content)
    assert answer.status_code == 200, answer.text
    assert answer.content.startswith(b"%PDF")
    assert len(re.findall(rb"/Type /Page\b", answer.content)) == pages


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("program", "reason"),
    [(None, "there is no Chromium"), ("exit 3", "Chromium ended with 3"), ("sleep 60", "more than 1 s")],
)
def test_why_there_is_no_pdf(program: str | None, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place = tmp_path / "chromium"
    place.write_text(f"#!/bin/sh\n{program}\n")
    place.chmod(0o755)
    if program == "sleep 60":
        monkeypatch.setattr(pdf, "_SECONDS", 1)
    monkeypatch.setattr("shutil.which", lambda _: program and str(place))
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with pytest.raises(NotPrinted, match=reason):
        pdf.printed("<p>")
    assert [path.name for path in tmp_path.iterdir()] == ["chromium"]


def test_participants_may_be_counted(client: TestClient) -> None:
    assert written(client, participants=2).text == sheets_page(homework(*IDS, participants=("1", "2")))


def test_the_services_own_secret_stays_the_same(client: TestClient) -> None:
    pages = [written(client, secret=None).text for _ in range(2)]
    assert pages[0] == pages[1] != written(client).text


@pytest.mark.parametrize(
    ("fields", "status", "told"),
    [
        ({"exercises": []}, 422, "exercises"),
        ({"exercises": ["no.such"]}, 404, "no.such"),
        ({"exercises": [IDS[0]] * 2}, 422, "exercises/1"),
        ({"participants": 0}, 422, "participants"),
        ({"participants": 151}, 413, "300"),
        ({"participants": ["Ada", "Ada"]}, 422, "participants/1"),
        ({"participants": ["a\u0000"]}, 422, "participants/0"),
        ({"secret": "short"}, 422, "secret"),
        ({"language": "fr"}, 422, "language"),
        ({"content": "key"}, 422, "content"),
        ({"colour": "red"}, 422, "colour"),
    ],
)
def test_what_is_wrong_is_named(client: TestClient, fields: dict[str, Any], status: int, told: str) -> None:
    answer = written(client, **fields)
    assert answer.status_code == status
    assert told in answer.text
    assert SECRET not in answer.text


def test_answers_are_graded_as_json_and_as_csv(client: TestClient) -> None:
    key = key_table(homework(*IDS))
    answer = client.post(f"{PATH}/grade", json={"csv": key, "secret": SECRET})
    assert answer.headers["content-type"] == "text/csv; header=present; charset=utf-8"
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    assert rows
    assert all(row["points"] == row["max_points"] for row in rows)
    table = f"participant,exercise,field,answer\nAda,{IDS[1]},mobility,\n"
    headers = {"Content-Type": "text/csv; charset=utf-8", "Accept-Language": "de-DE,de;q=0.9"}
    rows = list(csv.DictReader(io.StringIO(client.post(f"{PATH}/grade", content=table, headers=headers).text)))
    assert {row["mistake"] for row in rows} == {"missing"}
    with language("de"):
        assert {row["text"] for row in rows} == {mistake("missing").text} != {"There is no answer here."}


def test_a_table_must_be_text(client: TestClient) -> None:
    headers = {"Content-Type": "text/csv"}
    assert client.post(f"{PATH}/grade", content=b"\xff\xfe", headers=headers).status_code == 422
    assert client.post(f"{PATH}/grade", content=b"a" * (4 * 1024 * 1024 + 1), headers=headers).status_code == 413
    assert client.post(f"{PATH}/grade", content=b"a", headers={"Content-Type": "text/plain"}).status_code == 415


def test_a_secret_is_made_once_and_for_nobody_else(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    secret = kept_secret(folder)
    assert len(secret) == 64
    assert kept_secret(folder) == secret
    assert [path.name for path in folder.iterdir()] == ["course-secret"]
    assert stat.S_IMODE((folder / "course-secret").stat().st_mode) == 0o600
    (tmp_path / "file").touch()
    with pytest.raises(StorageFailed):
        kept_secret(tmp_path / "file")


@pytest.mark.slow
def test_the_operators_secret_counts() -> None:
    with TestClient(application(course_secret=SECRET), base_url="http://127.0.0.1:8000") as client:
        assert written(client, secret=None).text == sheets_page(homework(*IDS))


def test_only_teachers_get_sheets() -> None:
    entries, keys = keys_for("read+write+admin", "teach")
    app = application(api_keys=entries)
    for path in (PATH, f"{PATH}/grade"):
        assert ask(app, path, "POST", (HOST, bearer(keys["read+write+admin"]))).status == 403
