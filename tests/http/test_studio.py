"""The studio's page and files as they are served: policy, caching, and nothing but the bundle."""

import re

import pytest
from starlette.testclient import TestClient

from gelenk.http.pages import STUDIO, STUDIO_POLICY


def test_the_page_and_all_that_it_loads_come_from_here(client: TestClient) -> None:
    page = client.get("/")
    assert page.headers["content-type"].startswith("text/html")
    links = re.findall(r'(?:src|href)="([^"]+)"', page.text)
    assert {"studio/studio.js", "studio/studio.css", "studio/icon.svg", "docs"} <= set(links)
    for link in links:
        assert not link.startswith("/")  # relative: any path prefix will do
        assert client.get("/" + link).status_code == 200, link
    style = client.get("/studio/studio.css").text
    fonts = re.findall(r'url\("?\./([^)"]+)"?\)', style)
    assert len(fonts) > 10
    for font in fonts:
        assert client.get(f"/studio/{font}").status_code == 200, font


@pytest.mark.parametrize("path", ["/", "/studio/studio.js", "/studio/studio.css", "/studio/LICENSES.txt"])
def test_the_policy_allows_nothing_inline_and_no_other_host(client: TestClient, path: str) -> None:
    headers = client.get(path).headers
    assert headers["content-security-policy"] == STUDIO_POLICY
    assert headers["x-content-type-options"] == "nosniff"
    assert "unsafe" not in STUDIO_POLICY
    assert "http" not in STUDIO_POLICY
    assert "*" not in STUDIO_POLICY


def test_nothing_in_the_page_is_inline(client: TestClient) -> None:
    text = client.get("/").text
    assert not re.search(r"<script(?![^>]*\ssrc=)|<style|\sstyle=|\son[a-z]+=", text)


def test_a_browser_asks_again_and_gets_no_second_copy(client: TestClient) -> None:
    for path in ("/", "/studio/studio.js"):
        first = client.get(path)
        assert first.headers["cache-control"] == "no-cache"
        again = client.get(path, headers={"If-None-Match": first.headers["etag"]})
        assert (again.status_code, again.content) == (304, b"")


@pytest.mark.parametrize(
    "path",
    ["../package.json", "%2e%2e/package.json", "..%2fsrc/main.ts", "src/main.ts", "nothing.js", "fonts", "", "%00"],
)
def test_nothing_else_is_served(client: TestClient, path: str) -> None:
    answer = client.get(f"/studio/{path}")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"


def test_the_bundle_names_its_licences() -> None:
    text = (STUDIO / "LICENSES.txt").read_text()
    for package in ("three", "urdf-loader", "katex"):
        assert re.search(rf"^{package} [\d.]+ \(", text, re.MULTILINE)
