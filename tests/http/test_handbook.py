"""The built handbook is served as it is, below any root path; where it is not built, a page says how to build it."""

from pathlib import Path

import pytest

from gelenk.http import pages
from tests.http.access.asking import HOST, application, ask

FILES = {
    "index.html": "text/html; charset=utf-8",
    "course/statics.html": "text/html; charset=utf-8",
    "_static/furo.css": "text/css; charset=utf-8",
    "searchindex.js": "text/javascript; charset=utf-8",
    "_images/arm.svg": "image/svg+xml",
    "_images/arm.png": "image/png",
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(pages, "handbook", lambda: tmp_path / "handbook")
    (tmp_path / "secret.html").write_text("secret")
    for name in FILES:
        file = tmp_path / "handbook" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(name)
    return tmp_path / "handbook"


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("root", ["", "/lab/gelenk"])
def test_each_file_is_served_with_its_type_and_kept_only_while_it_is_current(root: str) -> None:
    app = application(root_path=root)
    for name, kind in FILES.items():
        answer = ask(app, f"{root}/handbook/{name}")
        assert (answer.status, answer.body.decode(), answer.header("content-type")) == (200, name, kind)
        assert answer.header("content-security-policy") == pages.HANDBOOK_POLICY
        assert answer.header("cache-control") == "no-cache"
        tag = (answer.header("etag") or "").encode()
        assert ask(app, f"{root}/handbook/{name}", headers=(HOST, (b"if-none-match", tag))).status == 304
    assert ask(app, f"{root}/handbook/").body == b"index.html"


@pytest.mark.usefixtures("folder")
def test_its_address_without_a_slash_leads_to_the_folder_that_its_links_count_from() -> None:
    answer = ask(application(root_path="/lab"), "/lab/handbook")
    assert (answer.status, answer.header("location")) == (307, "handbook/")


@pytest.mark.quick(1)
@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("path", ["nothing.html", "course", "course/", "../secret.html", "course/../../secret.html"])
def test_what_is_not_among_the_pages_is_a_problem(path: str) -> None:
    answer = ask(application(), f"/handbook/{path}")
    assert answer.problem["type"] == "urn:gelenk:not-found"


def test_where_it_is_not_built_the_page_says_how_to_build_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pages, "handbook", lambda: tmp_path / "none")
    app = application()
    answer = ask(app, "/handbook/")
    assert answer.header("content-type") == "text/html; charset=utf-8"
    assert b"./dev handbook" in answer.body
    assert ask(app, "/handbook/index.html").problem["status"] == 404
